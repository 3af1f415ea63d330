"""What the machine has."""

import os
from pathlib import Path

CGROUPS = Path("/sys/fs/cgroup")


def memory() -> float:
    """Return the memory [bytes] that this process may use: that of the machine, or less if a control group says so."""
    physical = float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    return min([physical, *control_group_limits(Path("/proc/self/cgroup"), CGROUPS)])


def control_group_limits(membership: Path, root: Path) -> list[float]:
    """Return the limits [bytes] of a process's control group and of those around it, of either version.

    Parameters
    ----------
    membership
        The file that says in which groups the process is.
    root
        Where control groups are mounted.
    """
    try:
        groups = [line.split(":", 2)[1:] for line in membership.read_text().splitlines()]
    except OSError:
        return []
    files = [root / "memory.max"]
    for controllers, path in groups:
        own = root / controllers / path.lstrip("/")
        files += [group / name for group in (own, *own.parents) for name in ("memory.max", "memory.limit_in_bytes")]
    return [limit for file in dict.fromkeys(files) if file.is_relative_to(root) for limit in _limit(file)]


def _limit(file: Path) -> list[float]:
    try:
        text = file.read_text().strip()
    except OSError:
        return []
    return [float(text)] if text.isdigit() else []
