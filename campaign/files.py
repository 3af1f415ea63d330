"""Files that are either wholly there or not there at all, whatever kills the process or the machine."""

import os
import re
import socket
from pathlib import Path


def write_atomically(path: Path, data: bytes) -> None:
    """Write `data` to `path` so that a reader sees the old file or the new one, never a part.

    Raises
    ------
    OSError
        When the directory cannot be written or the disk is full; the old file is then untouched.
    """
    temporary = temporary_name(path)
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    _sync(path.parent)


def publish(temporary: Path, path: Path) -> None:
    """Make the finished file `temporary` durable and give it its name `path` in one step."""
    _sync(temporary)
    temporary.replace(path)
    _sync(path.parent)


def set_aside(path: Path) -> Path:
    """Give a damaged file a name under which nobody reads it; returns that."""
    aside = path.with_name(f"{path.name}.damaged")
    path.replace(aside)
    return aside


def temporary_name(path: Path) -> Path:
    """Return a hidden name beside `path` that no other process uses."""
    return path.with_name(f".{path.name}.{socket.gethostname()}.{os.getpid()}")


def clear_temporaries(directory: Path) -> None:
    """Remove what a killed process was writing into a directory, on this host or another one."""
    for name in file_names(directory):
        written = re.fullmatch(r"\..+\..+\.(\d+)", name)  # by `temporary_name`
        if written and not _is_being_written(name, written[1]):
            (directory / name).unlink(missing_ok=True)


def _is_being_written(name: str, pid: str) -> bool:
    return name.endswith(f".{socket.gethostname()}.{pid}") and Path("/proc", pid).exists()


def file_names(directory: Path) -> list[str]:
    """Return what the files in a directory are called, sorted; none where there is no directory."""
    try:
        with os.scandir(directory) as entries:
            return sorted(entry.name for entry in entries if entry.is_file())
    except FileNotFoundError:
        return []


def _sync(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
