"""How long the batch system still lets this job run."""

import math
import os
import re
import subprocess
import time


def job_end() -> float:
    """Return when the SLURM job ends, in seconds since the epoch; infinity outside SLURM or without a limit."""
    if stated := os.environ.get("SLURM_JOB_END_TIME"):
        return float(stated)
    job = os.environ.get("SLURM_JOB_ID")
    return time.time() + remaining(_ask_queue(job)) if job else math.inf


def remaining(text: str) -> float:
    """Return the seconds in SLURM's [days-][[hours:]minutes:]seconds; infinity for anything else, such as UNLIMITED."""
    match = re.fullmatch(r"(?:(\d+)-)?(?:(?:(\d+):)?(\d+):)?(\d+)", text)
    if match is None:
        return math.inf
    days, hours, minutes, seconds = (int(part or 0) for part in match.groups())
    return ((days * 24 + hours) * 60 + minutes) * 60 + seconds


def _ask_queue(job: str) -> str:
    command = ["squeue", "--noheader", "--jobs", job, "--format", "%L"]
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=30, check=False).stdout.strip()
    except (OSError, subprocess.TimeoutExpired):
        return ""
