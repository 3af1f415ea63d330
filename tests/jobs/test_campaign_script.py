"""The job script of a campaign, with stand-ins for SLURM, the launcher and `campaign`."""

import os
import signal
import subprocess
from pathlib import Path

import pytest

from campaign.running.standing import _state
from campaign.storage.attempts import Attempts

SCRIPT = Path(__file__).parents[2] / "jobs" / "campaign.sbatch"

COMMANDS = {
    "srun": 'shift; exec "$@"',
    "scontrol": 'echo "scontrol $*"',
    "sbatch": 'echo "sbatch $*"',
    "campaign": """
case $1 in
    status) echo "$STATE"; exit "$WRITTEN" ;;
    run) echo begun; $MEANWHILE; exit "$TOLD" ;;
esac""",
}


@pytest.fixture
def job(tmp_path):
    """Starts the script for a launcher that ends in one code after a campaign that wrote down another."""
    (tmp_path / "campaign" / "bin").mkdir(parents=True)
    (tmp_path / "campaign" / "bin" / "activate").touch()
    commands = tmp_path / "commands"
    commands.mkdir()
    for name, text in COMMANDS.items():
        (commands / name).write_text(f"#!/bin/bash\n{text}\n")
        (commands / name).chmod(0o755)
    path = {"HOME": str(tmp_path), "PATH": f"{commands}:{os.environ['PATH']}"}
    slurm = {"SLURM_JOB_ID": "7", "SLURM_NTASKS": "2", "SLURM_JOB_NODELIST": "n1"}

    def start(told, written, meanwhile="true", state=""):
        choices = {"TOLD": str(told), "WRITTEN": str(written), "MEANWHILE": meanwhile, "STATE": state}
        return subprocess.Popen(["bash", SCRIPT], env=path | slurm | choices, stdout=subprocess.PIPE, text=True)

    return start


@pytest.mark.parametrize(
    ("told", "written", "code", "requeues"),
    [
        (0, 0, 0, False),
        (0, 75, 75, True),  # a rank has vanished
        (75, 75, 75, True),
        (3, 3, 3, False),
        (143, 0, 0, False),  # the launcher fell over its own end
        (137, 75, 137, False),  # no memory: it would happen again
        (2, 0, 2, False),  # refused in the directory of a campaign that is done
        (70, 75, 70, False),
    ],
)
def test_what_the_campaign_wrote_down_counts(job, told, written, code, requeues):
    process = job(told, written)
    output, _ = process.communicate(timeout=20)
    assert process.returncode == code
    assert ("scontrol requeue 7" in output) == requeues


def test_a_realization_that_takes_down_a_rank_is_followed_by_another_job(job, tmp_path):
    """It is so twice at most. srun kills all ranks when one of them ends them, and says 137."""
    attempts = Attempts(tmp_path)
    attempts.create()
    attempts.note(1, 3, "no answer within 5 s")
    state = _state(tmp_path, {"end": None})
    assert state == "ended when realization 3 took down a rank; give the same command again to continue"
    process = job(137, 75, state=state)
    output, _ = process.communicate(timeout=20)
    assert process.returncode == 75
    assert "scontrol requeue" not in output
    assert "sbatch --dependency=afterany:7" in output


def test_a_launcher_that_dies_of_the_signal_is_named_and_the_job_comes_back(job):
    process = job(0, 75, meanwhile="exec sleep 20")
    assert "Job 7" in process.stdout.readline()
    assert process.stdout.readline() == "begun\n"
    os.kill(process.pid, signal.SIGUSR1)
    output, _ = process.communicate(timeout=20)
    assert "The launcher died of the signal USR1" in output
    assert "scontrol requeue 7" in output
    assert process.returncode == 75
