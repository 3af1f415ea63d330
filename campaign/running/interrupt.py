"""Why a realization is left unfinished."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from campaign.running.stop_request import StopRequest

LAST_CALL = 20.0
"""Seconds before the end of the job at which a realization is abandoned, to leave time for writing the results."""


@dataclass
class Interrupt:
    """The reasons to leave a realization unfinished; asked by the time loop a few times a second.

    Parameters
    ----------
    stop
        Signals received.
    job_end
        Seconds since the epoch.
    timeout
        Wall-clock time that a realization may take [s].
    poll
        Called each time, for what has to be done in between.
    breaks_off
        Whether the first request to stop is enough to leave.
    """

    stop: StopRequest
    job_end: float
    timeout: float
    poll: Callable[[], None]
    breaks_off: bool = False
    begin: float = 0.0

    def restart(self) -> None:
        """Start the clock of a new realization."""
        self.begin = time.monotonic()

    @property
    def elapsed(self) -> float:
        """Wall-clock time since the start of the realization [s]."""
        return time.monotonic() - self.begin

    @property
    def abandons(self) -> str:
        """Why the realization is to be left and begun again another day, "" if it is not."""
        if self.stop.now or (self.breaks_off and self.stop.drain):
            return "asked to stop"
        return "the job's time is nearly over" if time.time() > self.job_end - LAST_CALL else ""

    def __call__(self) -> bool:
        """Whether to leave the realization."""
        self.poll()
        return bool(self.abandons) or self.elapsed > self.timeout
