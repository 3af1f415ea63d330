"""One campaign at a time in a directory, without ever standing in the way after a kill.

The lock is a file with its holder's name and a heartbeat (its modification time), because `flock` cannot be relied on
across the nodes of a cluster.
"""

import contextlib
import json
import os
import socket
import threading
import time
from pathlib import Path
from typing import TypedDict

from campaign.errors import RefusalError
from campaign.files import temporary_name
from campaign.storage.layout import LOCK

HEARTBEAT = 20.0
"""Seconds between two signs of life."""

SILENCE = 120.0
"""Seconds without one after which the holder is taken for dead: six heartbeats, for slow network file systems."""

PATIENCE = 10.0
"""Seconds to wait for a live holder on this host: ranks outlive a killed mpirun by a second or two."""


class Holder(TypedDict):
    """Who holds a lock."""

    host: str
    pid: int
    born: str
    job: str


class DirectoryLock:
    """The right to hand out realizations into `directory`."""

    def __init__(self, directory: Path) -> None:
        self.path = directory / LOCK
        self._released = threading.Event()

    def acquire(self) -> str:
        """Take the lock; returns a sentence when it was taken over from a dead holder, else "".

        A live holder on this host is given `PATIENCE` to go; one on another host, whose processes cannot be looked at,
        is taken for dead when its heartbeat does not move for as long as `SILENCE`, whatever its clock shows.

        Raises
        ------
        RefusalError
            When another process is at work in the directory.
        """
        note, start, first_beat = "", time.monotonic(), self._beat()
        while not self._create():
            holder, waited = self._holder(), time.monotonic() - start
            if self._is_dead(holder, waited):
                note = f"An earlier campaign here ended without a word{_name(holder)}; this one takes over."
                self._remove()
            elif waited > PATIENCE and (_is_here(holder) or self._beat() != first_beat):
                raise RefusalError(
                    f"Another campaign is at work in {self.path.parent}{_name(holder)}. Wait for it, stop it, "
                    f"give another --out, or, if you know that it is gone, remove {self.path}."
                )
            time.sleep(0.05)
        threading.Thread(target=self._keep_beating, name="heartbeat", daemon=True).start()
        return note

    def release(self) -> None:
        """Give the directory free."""
        self._released.set()
        self.path.unlink(missing_ok=True)

    def is_held(self) -> bool:
        """Whether a living campaign is at work in the directory."""
        holder = self._holder()
        if holder is None:
            return False
        return _is_running(holder) if _is_here(holder) else time.time() - self._beat() < SILENCE

    def _keep_beating(self) -> None:
        while not self._released.wait(HEARTBEAT):
            with contextlib.suppress(OSError):
                os.utime(self.path)

    def _is_dead(self, holder: Holder | None, waited: float) -> bool:
        if holder is None or not _is_here(holder):
            return max(waited, time.time() - self._beat()) > (PATIENCE if holder is None else SILENCE)
        return not _is_running(holder)

    def _remove(self) -> None:
        """Remove a dead holder's lock; of several who try, one renames it, and none a lock made since."""
        grave = temporary_name(self.path)
        with contextlib.suppress(FileNotFoundError):
            self.path.rename(grave)
            grave.unlink()

    def _create(self) -> bool:
        try:
            descriptor = os.open(self.path, os.O_CREAT | os.O_EXCL | os.O_WRONLY)
        except FileExistsError:
            return False
        with os.fdopen(descriptor, "w") as file:
            json.dump(_self(), file)
        return True

    def _holder(self) -> Holder | None:
        """Return the holder, or None when there is none or its name was never written."""
        try:
            holder: Holder = json.loads(self.path.read_text())
        except (OSError, ValueError):
            return None
        return holder

    def _beat(self) -> float:
        try:
            return self.path.stat().st_mtime
        except OSError:
            return 0.0


def _self() -> Holder:
    pid = os.getpid()
    return {"host": socket.gethostname(), "pid": pid, "born": _born(pid), "job": os.environ.get("SLURM_JOB_ID", "")}


def _is_here(holder: Holder | None) -> bool:
    return holder is not None and holder["host"] == socket.gethostname()


def _is_running(holder: Holder) -> bool:
    return _born(holder["pid"]) == holder["born"] != ""


def _born(pid: int) -> str:
    """Return what tells a process from a later one with its number: its start in clock ticks; "" when dead or a zombie.

    Where there is no /proc the number itself must do.
    """
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return "" if Path("/proc/self/stat").exists() else _running(pid)
    return "" if fields[0] in "ZX" else fields[19]


def _running(pid: int) -> str:
    try:
        os.kill(pid, 0)
    except OSError:
        return ""
    return "running"


def _name(holder: Holder | None) -> str:
    if holder is None:
        return ""
    job = f", SLURM job {holder['job']}" if holder["job"] else ""
    return f" (process {holder['pid']} on {holder['host']}{job})"
