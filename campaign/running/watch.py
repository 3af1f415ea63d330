"""A realization that never comes back is noticed: its time limit is kept by its own time loop, which may hang.

Rank 0 watches, and says who hangs. Each rank has a timer besides, which needs no Python to end its process so that the
campaign can go on: rank 0 may hang itself and keep its own threads from running, or a rank may hang before its first
realization.
"""

import faulthandler
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TextIO

from campaign.exit_codes import ExitCode
from campaign.running.last_resort import ending

GRACE = 300.0
"""Seconds beyond its time limit that a realization is given to notice it, and to write its record."""

LAST_WORDS = 1.0
"""Seconds between the trace of a rank that hangs and its end."""


def patience(timeout: float) -> float:
    """Return how long a realization may take to come back [s] when its time limit is `timeout` [s]."""
    return 1.1 * timeout + GRACE


@contextmanager
def timer(timeout: float, trace: TextIO | int) -> Iterator[None]:
    """End this process when it does not leave the context and rank 0 has not seen to that; `trace` tells where it was.

    Parameters
    ----------
    timeout
        Of a realization [s].
    trace
        A file of the system, or its number.
    """
    limit = 2 * patience(timeout)
    with ending(ExitCode.RESUMABLE, limit + LAST_WORDS) as is_set:
        faulthandler.dump_traceback_later(limit, exit=not is_set, file=trace)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()


class HungError(BaseException):
    """A rank does not come back from a realization; the message says which, and what follows.

    It may be raised from within the time loop of another realization, whose fault it is not.
    """

    exit_code = ExitCode.RESUMABLE


class Watch:
    """Which rank has begun which realization, and when.

    Parameters
    ----------
    timeout
        Seconds that a realization may take.
    hold_against
        Told the rank that hangs, in which realization, and what it did.
    clock
        In seconds.
    """

    def __init__(
        self, timeout: float, hold_against: Callable[[int, int, str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._patience = patience(timeout)
        self._hold_against = hold_against
        self._clock = clock
        self._begun: dict[int, tuple[int, float]] = {}

    def begins(self, rank: int, realization: int | None) -> None:
        """Take down what a rank does from now on; None is nothing."""
        self._begun.pop(rank, None)
        if realization is not None:
            self._begun[rank] = realization, self._clock()

    def look(self) -> None:
        """Raise HungError when a rank is overdue, which is held against its realization."""
        now = self._clock()
        for rank, (realization, begin) in list(self._begun.items()):
            if now - begin > self._patience:
                with suppress(OSError):  # it ends all the same
                    self._hold_against(rank, realization, f"no answer within {self._patience:.0f} s")
                raise HungError(
                    f"Rank {rank} does not come back from realization {realization}, begun {now - begin:.0f} s ago, "
                    "so all ranks are ended. Give the same command again to continue: a realization that hangs twice "
                    "is recorded as crashed."
                )
