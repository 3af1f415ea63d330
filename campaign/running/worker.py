"""What every rank does with an id: simulate it alone, keep its record, say how it went."""

from dataclasses import dataclass

from campaign.record import Record, Status, summarize
from campaign.running.interrupt import Interrupt
from campaign.running.machine_fault import MachineFaultError, machine_faults, reason_of
from campaign.running.stop_request import BrokenOff
from campaign.running.watch import timer
from campaign.seeds import BASELINE
from campaign.simulation.contract import Interrupted, PreparedGround, without_result
from campaign.statistics.tally import Fault, RankReport
from campaign.storage.attempts import Attempts
from campaign.storage.provenance import machine
from campaign.storage.record_store import RecordStore
from campaign.storage.soundness import is_sound
from campaign.terminal import say

STDERR = 2
"""The number of a process's stream of errors, whatever Python or a notebook makes of it."""

PATIENCE = 2
"""Faults of the machine in a row after which a rank takes no more work."""


@dataclass
class Worker:
    """Turns ids into records; what goes wrong in a realization by itself is a status in the data."""

    ground: PreparedGround
    store: RecordStore
    attempts: Attempts
    rank: int
    interrupt: Interrupt
    _faults: int = 0  # of the machine, in a row
    _unfit: str = ""

    def rehearse(self) -> None:
        """Compile what a realization needs, and run the start of one to see whether this machine can."""
        self.interrupt.restart()
        asked = iter([False])
        try:
            with self.interrupt.stop.breaking_off(), machine_faults(), timer(self.interrupt.timeout, STDERR):
                self.ground.simulate(BASELINE, lambda: self.interrupt() or next(asked, True))
        except MachineFaultError as fault:
            self._unfit, self._faults = f"it fails before its first realization: {fault}", PATIENCE
        except (BrokenOff, Exception):  # what the scene causes is a status, in its turn
            return

    def run(self, realization: int) -> RankReport:
        """Simulate one realization and keep its record."""
        if self._unfit:
            return self._fault(realization, self._unfit)
        self.interrupt.restart()
        try:
            with self.attempts.of(self.rank, realization) as trace, timer(self.interrupt.timeout, trace):
                record = self._simulate(realization)
            if record is None:
                return RankReport(None, self.interrupt.abandons)
            self.store.write(record)
        except MachineFaultError as fault:
            return self._fault(realization, f"realization {realization} ended in {fault}")
        except OSError as error:
            return RankReport(None, f"realization {realization} cannot be kept in {self.store.records} ({error})")
        self._faults = 0
        return RankReport(summarize(record), "asked to stop" if self.interrupt.stop.drain else "")

    def _fault(self, realization: int, reason: str) -> RankReport:
        self._faults += 1
        who = f"rank {self.rank} on {machine()['host']}"
        retires = self._faults >= PATIENCE
        if retires:
            say(f"No more work for {who}: {reason}.")
        return RankReport(None, "", Fault(realization, f"{who}: {reason}", retires))

    def _simulate(self, realization: int) -> Record | None:
        """Return the record, or None when the realization is abandoned."""
        try:
            with machine_faults():
                record = self.ground.simulate(realization, self.interrupt)
            if is_sound(summarize(record)):
                return record
            return self._without_result(realization, Status.diverged, "its run-out is not a number")
        except Interrupted:
            if self.interrupt.abandons:
                return None
            reason = f"took longer than the realization_timeout of {self.interrupt.timeout:g} s"
            return self._without_result(realization, Status.timeout, reason)
        except MachineFaultError:
            raise
        except Exception as error:
            return self._without_result(realization, Status.crashed, reason_of(error))

    def _without_result(self, realization: int, status: Status, reason: str) -> Record:
        return without_result(self.ground, realization, status, reason, self.interrupt.elapsed)
