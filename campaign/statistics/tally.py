"""The account of a campaign: which realizations are finished, and whether they suffice.

Decisions are made on contiguous prefixes of ids (all k < m finished) at the rule's checkpoints, so that the number of
realizations in the result depends neither on ranks nor on the order in which they finish.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from campaign.record import FAILED, USABLE, Record, Status
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.statistics.convergence import History, Rule, history, is_regular


class Outcome(NamedTuple):
    """What rank 0 must know of a finished realization."""

    realization: int
    status: Status
    final_runout: float
    wall_time: float


class Report(NamedTuple):
    """A rank's word to rank 0: what it has finished, and why it must stop ("" if it need not)."""

    outcome: Outcome | None
    problem: str = ""


def outcome_of(record: Record) -> Outcome:
    """Return the part of a record that the stopping rule needs."""
    runout, wall_time = record.values["final_runout"], record.values["wall_time"]
    return Outcome(record.realization, record.status, float(runout), float(wall_time))


class Tally:
    """Finished realizations of a campaign of at most `maximum`, judged by `rule`."""

    def __init__(self, maximum: int, rule: Rule, max_failed_fraction: float) -> None:
        self.maximum = maximum
        self.rule = rule
        self.max_failed_fraction = max_failed_fraction
        self.outcomes: dict[int, Outcome] = {}
        self.prefix = 0
        self.size: int | None = None
        """Number of realizations in the result, once that is settled."""
        self.too_many_failed = False

    def add(self, outcome: Outcome) -> None:
        """Take a realization into the account; ids beyond the maximum, of an earlier and larger campaign, stay out."""
        if outcome.realization >= self.maximum:
            return
        self.outcomes[outcome.realization] = outcome
        while self.size is None and BASELINE in self.outcomes and self.prefix in self.outcomes:
            self.prefix += 1
            self._judge()

    def _judge(self) -> None:
        at_end = self.prefix == self.maximum
        if not (is_regular(self.prefix, self.rule) or at_end):
            return
        self.too_many_failed = self.failed_in_prefix > self.max_failed_fraction * self.prefix
        if at_end or self.too_many_failed or self.history().converged_at is not None:
            self.size = self.prefix

    @property
    def done(self) -> int:
        """Finished realizations, whether or not they are in the result."""
        return len(self.outcomes) - (BASELINE in self.outcomes)

    @property
    def threshold(self) -> float:
        """Run-out of the baseline [m]; NaN when it is not there or failed."""
        baseline = self.outcomes.get(BASELINE)
        return baseline.final_runout if baseline is not None and baseline.status not in FAILED else math.nan

    @property
    def failed(self) -> int:
        """Failures among all finished realizations."""
        return sum(outcome.status in FAILED for k, outcome in self.outcomes.items() if k != BASELINE)

    @property
    def failed_in_prefix(self) -> int:
        """Failures in the prefix."""
        return sum(self.outcomes[k].status in FAILED for k in range(self.prefix))

    def by_status(self) -> Mapping[Status, int]:
        """Return how many realizations of the prefix ended in each way."""
        ends = [self.outcomes[k].status for k in range(self.prefix)]
        return {status: ends.count(status) for status in Status}

    def runouts(self) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Return the final run-out of the realizations in the prefix [m], NaN where it is not usable."""
        prefix = [self.outcomes[k] for k in range(self.prefix)]
        return np.array([each.final_runout if each.status in USABLE else math.nan for each in prefix], dtype=float)

    def history(self) -> History:
        """Return the estimates at the checkpoints of the prefix."""
        values = self.runouts()
        return history(values, ~np.isnan(values), self.rule, self.threshold)

    def checkpoints(self) -> int:
        """Return how many checkpoints the prefix has passed."""
        return max(0, (self.prefix - self.rule.minimum) // self.rule.block + 1)


def tally_of(scene: Scene) -> Tally:
    """Return the empty account of a scene's campaign."""
    wanted = scene.campaign
    rule = Rule(wanted.mean_tolerance, wanted.variance_tolerance, wanted.confidence, wanted.minimum, wanted.block)
    return Tally(wanted.realizations, rule, wanted.max_failed_fraction)
