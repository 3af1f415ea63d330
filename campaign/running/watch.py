"""A realization that never comes back is noticed: its time limit is kept by its own time loop, which may hang."""

import time
from collections.abc import Callable
from contextlib import suppress

from campaign.exit_codes import ExitCode

GRACE = 300.0
"""Seconds beyond its time limit that a realization is given to notice it, and to write its record."""


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
        Told the realization that hangs, and what it did.
    clock
        In seconds.
    """

    def __init__(
        self, timeout: float, hold_against: Callable[[int, str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._patience = 1.1 * timeout + GRACE
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
                    self._hold_against(realization, f"no answer within {self._patience:.0f} s")
                raise HungError(
                    f"Rank {rank} does not come back from realization {realization}, begun {now - begin:.0f} s ago, "
                    "so all ranks are ended. Give the same command again to continue: a realization that hangs twice "
                    "is recorded as crashed."
                )
