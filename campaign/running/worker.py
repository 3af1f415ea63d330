"""What every rank does with an id: simulate it alone, keep its record, say how it went."""

import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass

from campaign.record import Record, Status, summarize
from campaign.running.stop_request import StopRequest
from campaign.simulation.contract import Interrupted, PreparedGround, without_result
from campaign.statistics.tally import RankReport
from campaign.storage.attempts import Attempts
from campaign.storage.record_store import RecordStore
from campaign.storage.soundness import is_sound

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
    """

    stop: StopRequest
    job_end: float
    timeout: float
    poll: Callable[[], None]
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
        if self.stop.now:
            return "asked to stop"
        return "the job's time is nearly over" if time.time() > self.job_end - LAST_CALL else ""

    def __call__(self) -> bool:
        """Whether to leave the realization."""
        self.poll()
        return bool(self.abandons) or self.elapsed > self.timeout


@dataclass(frozen=True)
class Worker:
    """Turns ids into records; what goes wrong in a realization is a status in the data."""

    ground: PreparedGround
    store: RecordStore
    attempts: Attempts
    rank: int
    interrupt: Interrupt

    def run(self, realization: int) -> RankReport:
        """Simulate one realization and keep its record."""
        self.interrupt.restart()
        try:
            with self.attempts.of(self.rank, realization):
                record = self._simulate(realization)
            if record is None:
                return RankReport(None, self.interrupt.abandons)
            self.store.write(record)
        except OSError as error:
            return RankReport(None, f"realization {realization} cannot be kept in {self.store.records} ({error})")
        return RankReport(summarize(record), "asked to stop" if self.interrupt.stop.drain else "")

    def _simulate(self, realization: int) -> Record | None:
        """Return the record, or None when the realization is abandoned."""
        try:
            record = self.ground.simulate(realization, self.interrupt)
            if is_sound(summarize(record)):
                return record
            return self._without_result(realization, Status.diverged, "its run-out is not a number")
        except Interrupted:
            if self.interrupt.abandons:
                return None
            reason = f"took longer than the realization_timeout of {self.interrupt.timeout:g} s"
            return self._without_result(realization, Status.timeout, reason)
        except Exception as error:
            return self._without_result(realization, Status.crashed, _reason(error))

    def _without_result(self, realization: int, status: Status, reason: str) -> Record:
        return without_result(self.ground, realization, status, reason, self.interrupt.elapsed)


def _reason(error: Exception) -> str:
    """Return the last line of the traceback and the place it comes from."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{traceback.format_exception_only(error)[-1].strip()} ({place.name}, line {place.lineno})"
