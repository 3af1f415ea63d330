"""Who holds a lock, and whether that process still lives."""

import json
import os
import secrets
import socket
from pathlib import Path
from typing import NamedTuple

from campaign.storage.provenance import machine


class Holder(NamedTuple):
    """A process that holds a lock.

    Attributes
    ----------
    host, job
        Its host's name, and its job under SLURM, for people.
    kernel
        Whose process numbers it is among: the boot of a machine and the namespace, as two containers may have one
        host name. Locks of older versions have the host's name here.
    pid, born
        Its number, and what tells it from a later process of that number.
    token
        Which of the locks of a process this is.
    """

    host: str
    job: str
    kernel: str
    pid: int
    born: str
    token: str

    @property
    def is_here(self) -> bool:
        """Whether its number is one of those that this process sees."""
        return self.kernel in (_kernel(), socket.gethostname())

    @property
    def is_running(self) -> bool:
        """Whether it lives, if it is here."""
        return _born(self.pid) == self.born != ""

    @property
    def name(self) -> str:
        """It in words, in brackets."""
        job = f", SLURM job {self.job}" if self.job else ""
        return f" (process {self.pid} on {self.host}{job})"

    def to_json(self) -> str:
        """Return what its lock holds."""
        return json.dumps(self._asdict())


def this_process() -> Holder:
    """Return this process with a new token."""
    pid, job = os.getpid(), machine()["slurm_job"]
    return Holder(socket.gethostname(), job, _kernel(), pid, _born(pid), secrets.token_hex(8))


def holder_of(path: Path) -> Holder | None:
    """Return who holds the lock in a file; None when there is none, or nobody's name in it."""
    try:
        told = json.loads(path.read_text())
        host, pid, kernel = str(told["host"]), int(told["pid"]), told.get("kernel", told["host"])
        return Holder(host, str(told["job"]), str(kernel), pid, str(told["born"]), str(told.get("token", "")))
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def _kernel() -> str:
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
        return f"{boot} {os.readlink('/proc/self/ns/pid')}"
    except OSError:
        return socket.gethostname()


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
