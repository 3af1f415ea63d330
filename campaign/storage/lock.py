"""One campaign at a time in a directory, without ever standing in the way after a kill.

The lock is a file with its holder's name, which appears whole in one step (a hard link, which is safe on network file
systems, where `flock` cannot be relied on). Its time of modification is a heartbeat: whether it changes counts, and not
what any clock says.
"""

import contextlib
import os
import threading
import time
from pathlib import Path

from campaign.errors import RefusalError
from campaign.files import temporary_name
from campaign.storage.holder import Holder, holder_of, this_process
from campaign.storage.layout import LOCK

HEARTBEAT = 20.0
"""Seconds between two signs of life."""

SILENCE = 120.0
"""Seconds without one after which the holder is taken for dead: six heartbeats, for slow network file systems."""

PATIENCE = 10.0
"""Seconds to wait for a live holder on this host: ranks outlive a killed mpirun by a second or two."""


class DirectoryLock:
    """The right to hand out realizations into `directory`."""

    def __init__(self, directory: Path) -> None:
        self.path = directory / LOCK
        self._me = this_process()
        self._released = threading.Event()

    def acquire(self) -> str:
        """Take the lock; returns a sentence when it was taken over from a dead holder, else "".

        A live holder here is given `PATIENCE` to go; one elsewhere, whose processes cannot be looked at, is taken for
        dead when its heartbeat does not move for as long as `SILENCE`.

        Raises
        ------
        RefusalError
            When another process is at work in the directory.
        """
        note, begin = "", time.monotonic()
        first = seen = self._sign()
        changed = begin
        while not _create(self.path, self._me):
            sign, now = self._sign(), time.monotonic()
            if sign != seen:
                seen, changed = sign, now
            holder = sign[0]
            if _is_dead(holder, now - changed):
                if self._remove(holder, now - changed):
                    name = holder.name if holder else ""
                    note = f"An earlier campaign here ended without a word{name}; this one takes over."
            elif now - begin > PATIENCE and holder and (holder.is_here or seen != first):
                raise RefusalError(
                    f"Another campaign is at work in {self.path.parent}{holder.name}. Wait for it, stop it, "
                    f"give another --out, or, if you know that it is gone, remove {self.path}."
                )
            time.sleep(0.05)
        threading.Thread(target=self._keep_beating, name="heartbeat", daemon=True).start()
        return note

    def release(self) -> None:
        """Give the directory free, unless another campaign has it meanwhile."""
        self._released.set()
        if self.is_ours():
            self.path.unlink(missing_ok=True)

    def is_ours(self) -> bool:
        """Whether the lock is still where it was made, and this one."""
        return holder_of(self.path) == self._me

    def is_held(self) -> bool:
        """Whether a living campaign is at work in the directory, as far as one look tells."""
        holder = holder_of(self.path)
        if holder is None:
            return False
        return holder.is_running if holder.is_here else self._now() - self._beat() < SILENCE

    def _keep_beating(self) -> None:
        while not self._released.wait(HEARTBEAT):
            if self.is_ours():
                with contextlib.suppress(OSError):
                    os.utime(self.path)

    def _remove(self, dead: Holder | None, silent: float) -> bool:
        """Remove a dead holder's lock; of several who try, one does, and none removes a lock made since.

        Only who holds the right to remove may, and looks again before. Should it be killed between, its right is dead
        as a lock is, `SILENCE` later than the lock.
        """
        right = self.path.with_name(f".{LOCK}.removal")
        if not _create(right, self._me):
            if _is_dead(holder_of(right), silent - SILENCE):
                right.unlink(missing_ok=True)
            return False
        try:
            is_same = holder_of(self.path) == dead
            if is_same:
                self.path.unlink(missing_ok=True)
            return is_same
        finally:
            right.unlink(missing_ok=True)

    def _sign(self) -> tuple[Holder | None, float]:
        """Return what changes as long as a holder lives, or when the holder does."""
        return holder_of(self.path), self._beat()

    def _beat(self) -> float:
        try:
            return self.path.stat().st_mtime
        except OSError:
            return 0.0

    def _now(self) -> float:
        """Return the time on the clock that heartbeats show, which is the file server's."""
        temporary = temporary_name(self.path)
        try:
            temporary.touch()
            return temporary.stat().st_mtime
        except OSError:
            return time.time()
        finally:
            with contextlib.suppress(OSError):
                temporary.unlink()


def _is_dead(holder: Holder | None, silent: float) -> bool:
    """Whether a holder is to be taken for dead after seconds without a sign of life; one without a name soon."""
    if holder is None:
        return silent > PATIENCE
    return not holder.is_running if holder.is_here else silent > SILENCE


def _create(path: Path, holder: Holder) -> bool:
    """Make a lock in one step; returns whether there was none."""
    if path.exists():
        return False
    temporary = temporary_name(path.with_name(f"{path.name}-{holder.token}"))
    temporary.write_text(holder.to_json())
    try:
        os.link(temporary, path)
    except FileExistsError:
        return temporary.stat().st_nlink == 2  # a network file system may have lost the answer
    except OSError:  # a file system without hard links
        return _create_without_links(path, holder)
    finally:
        temporary.unlink()
    return True


def _create_without_links(path: Path, holder: Holder) -> bool:
    try:
        with path.open("x") as file:
            file.write(holder.to_json())
    except FileExistsError:
        return False
    return True
