"""The realizations of one scene and their directory: those of a campaign, or those of a run beside it."""

import contextlib
from collections.abc import Callable
from pathlib import Path

from campaign.files import clear_temporaries
from campaign.record import RealizationSummary, Status
from campaign.scene import Scene
from campaign.simulation.contract import PreparedGround, shapes, without_result
from campaign.statistics.tally import Tally, tally_of
from campaign.storage.attempts import Attempts
from campaign.storage.record_store import RecordStore
from campaign.terminal import say


class Level:
    """The records of `scene`'s realizations, kept in `directory`; those that ended in one of `retry` are run again."""

    def __init__(self, scene: Scene, directory: Path, retry: frozenset[Status] = frozenset()) -> None:
        self.scene = scene
        self.directory = directory
        self.retry = retry
        self.store = RecordStore(directory, scene.digest())
        self._attempts = Attempts(directory)

    def open(self) -> list[str]:
        """Make ready for work, clearing up after a kill; returns sentences worth a look."""
        self.store.create()
        self._attempts.create()
        for place in (self.directory, self._attempts.directory):
            clear_temporaries(place)
        notes = self.store.recover()
        self._tidy()
        return notes

    def fit(self, ground: PreparedGround) -> None:
        """Set records of another ground aside, and give realizations up that took the process down too often."""
        for sentence in self.store.check_shapes(shapes(ground)):
            say(sentence)
        finished = self.store.finished()
        for realization, reason in self._attempts.given_up().items():
            if realization not in finished:
                say(f"Realization {realization} is recorded as crashed: it {reason}.")
                self.store.write(without_result(ground, realization, Status.crashed, reason))

    def tally(self) -> Tally:
        """Return the account of what earlier starts have finished or given up, without what is to be run again."""
        tally = tally_of(self.scene)
        for realization, summary in self.store.summaries()[0].items():
            if self._is_run_again(summary):
                self.store.loose.forget(realization)
            else:
                tally.add(summary)
        return tally

    def tidier(self, tally: Tally) -> Callable[[], None]:
        """Return what packs the records now and then while `tally` grows, so that a kill leaves few loose ones."""
        packed_at = tally.done

        def tidy() -> None:
            nonlocal packed_at
            if tally.done >= packed_at + self.store.packs.SIZE:
                packed_at = tally.done
                self._tidy()

        return tidy

    def _is_run_again(self, summary: RealizationSummary) -> bool:
        """Whether an earlier result is not to stand: the user says so, or there is more time than it has taken."""
        has_time = summary.wall_time < self.scene.campaign.realization_timeout
        return summary.status in self.retry or (summary.status is Status.timeout and has_time)

    def _tidy(self) -> None:
        """Pack what can be packed; where there is no room for it, the loose records do as well."""
        with contextlib.suppress(OSError):
            self.store.pack()
