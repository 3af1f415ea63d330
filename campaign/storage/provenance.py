"""Which program made a result: hashes of the sources, versions, machine."""

import os
import platform
import socket
import subprocess
from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from campaign.scene import Scene
from campaign.storage.formats import FORMAT, READER, program_version
from campaign.storage.source_hash import package_hash, realization_hash
from campaign.terminal import counted

PACKAGE = Path(__file__).parents[1]

LIBRARIES = ("numpy", "scipy", "numba", "llvmlite", "h5py", "netCDF4", "xarray", "mpi4py")


OF_EACH_START = ("realization_sha256", "solver_sha256", "campaign_sha256", "git", "cpu")
"""What the dataset tells of all starts, beside the versions of libraries."""


def source_hashes() -> dict[str, str]:
    """Return the SHA-256 of what decides a realization, and of each package."""
    return {
        "realization_sha256": realization_hash(),
        **{f"{package}_sha256": package_hash(package) for package in ("solver", "campaign")},
    }


def library_versions() -> dict[str, str]:
    """Return the versions of Python and of the libraries that take part."""
    return {"python": platform.python_version()} | {name: _version(name) for name in LIBRARIES}


def machine() -> dict[str, str]:
    """Return where this process runs; none of it may influence a result."""
    return {
        "host": os.environ.get("SLURMD_NODENAME", socket.gethostname()),
        "cpu": _cpu(),
        "slurm_job": os.environ.get("SLURM_JOB_ID", ""),
    }


def git_describe() -> str:
    """Return the state of the source tree if the packages run from a git checkout, else ""."""
    command = ["git", "-C", str(PACKAGE), "describe", "--always", "--dirty"]
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=10, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return result.stdout.strip() if result.returncode == 0 and (PACKAGE.parent / ".git").exists() else ""


def attributes(scene: Scene, manifest: Mapping[str, Any], verdict: str) -> dict[str, str | int | float]:
    """Return the dataset's global attributes about its making; `manifest` as kept in the results directory.

    What differs between starts is told for each, with semicolons between.
    """
    starts = manifest["starts"]
    versions = {name: [*dict.fromkeys(_versions_in(starts, name))] for name in starts[-1]["versions"]}
    rule = scene.campaign
    return {
        "title": scene.title,
        "format": FORMAT,
        "format_reader": READER,
        "source": f"runout-campaign {program_version()}",
        "history": "; ".join(
            f"{start['at']} on {counted(start['ranks'], 'rank')} of {start['host']}" for start in starts
        ),
        "seed": str(rule.seed),
        "front": scene.slide.front,
        "stopping_rule": (
            f"half-width of the probability of a slide within {rule.slide_probability_tolerance:g}, and, unless slides "
            f"are rare, of the mean run-out within {rule.mean_tolerance:g} and of its variance within "
            f"{rule.variance_tolerance:g} of the estimate, at {rule.confidence:g} confidence, at two checkpoints in a "
            f"row; checkpoints at {rule.minimum} realizations and every {rule.block} after; at most "
            f"{rule.realizations}; without a slide, as soon as that shows that slides are rare"
        ),
        "verdict": verdict,
        "scene": scene.text,
        "scene_overrides": "\n".join(scene.overrides),
        "scene_sha256": scene.digest(),
        "solver_drift": str(len({start["realization_sha256"] for start in starts}) > 1).lower(),
        "library_drift": " ".join(name for name, numbers in versions.items() if len(numbers) > 1),
        **{name: _each(start[name] for start in starts) for name in OF_EACH_START},
        "slurm_jobs": " ".join(sorted({start["slurm_job"] for start in starts} - {""})),
        **{f"{name}_version": _each(numbers) for name, numbers in versions.items()},
    }


def _versions_in(starts: Iterable[Mapping[str, Any]], library: str) -> Iterator[str]:
    return (start["versions"][library] for start in starts if library in start["versions"])


def _each(values: Iterable[str]) -> str:
    return "; ".join(dict.fromkeys(values))


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor())
