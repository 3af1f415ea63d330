"""The account of a campaign: which realizations are finished, and whether they suffice.

Decisions are made on contiguous prefixes of ids (all k < m finished) at the rule's checkpoints, so that the number of
realizations in the result depends neither on ranks nor on the order in which they finish.
"""

import math
from typing import NamedTuple

import numpy as np

from campaign.record import FAILED, USABLE, RealizationSummary
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.statistics.convergence import (
    LOOKS_IN_A_ROW,
    Checkpoint,
    ConvergenceHistory,
    StoppingRule,
    is_regular,
    look,
    tabulate,
)
from campaign.statistics.intervals import mean_interval


class RankReport(NamedTuple):
    """A rank's word to rank 0: what it has finished, and why it must stop ("" if it need not)."""

    finished: RealizationSummary | None
    problem: str = ""


class Tally:
    """Finished realizations of a campaign of at most `maximum`, judged by `rule`.

    Each realization is counted once, when it is added. Only a checkpoint looks at all of them, and once; what it need
    not know for its decision is computed when somebody asks.

    Attributes
    ----------
    summaries : dict
        Of the finished realizations, by id.
    prefix : int
        All realizations below it are finished, and so is the baseline.
    size : int or None
        Number of realizations in the result, once that is settled.
    failed, failed_in_prefix : int
        Failures among all finished realizations, and among those in the prefix.
    longest : float
        Wall-clock time of the slowest realization [s], the baseline included.
    """

    def __init__(self, maximum: int, rule: StoppingRule, max_failed_fraction: float) -> None:
        self.maximum = maximum
        self.rule = rule
        self.max_failed_fraction = max_failed_fraction
        self.summaries: dict[int, RealizationSummary] = {}
        self.prefix = 0
        self.size: int | None = None
        self.too_many_failed = False
        self.failed = 0
        self.failed_in_prefix = 0
        self.longest = 0.0
        self._usable = np.empty(maximum)
        self._n_usable = 0
        self._checkpoints: list[tuple[int, int]] = []
        self._looks: dict[int, Checkpoint] = {}
        self._satisfied_in_a_row = 0

    def add(self, summary: RealizationSummary) -> None:
        """Take a realization into the account, unless it is there already.

        Ids beyond the maximum, of an earlier and larger campaign, stay out.
        """
        if summary.realization >= self.maximum or summary.realization in self.summaries:
            return
        self.summaries[summary.realization] = summary
        self.failed += summary.status in FAILED and summary.realization != BASELINE
        self.longest = max(self.longest, summary.wall_time)  # which ignores NaN
        while self.size is None and BASELINE in self.summaries and self.prefix in self.summaries:
            self._count(self.summaries[self.prefix])
            self._judge()

    def _count(self, summary: RealizationSummary) -> None:
        """Take the next realization into the prefix."""
        if summary.status in USABLE and not math.isnan(summary.final_runout):
            self._usable[self._n_usable] = summary.final_runout
            self._n_usable += 1
        self.failed_in_prefix += summary.status in FAILED
        self.prefix += 1

    def _judge(self) -> None:
        at_end = self.prefix == self.maximum
        if is_regular(self.prefix, self.rule):
            self._checkpoints.append((self.prefix, self._n_usable))
            self._satisfied_in_a_row = self._satisfied_in_a_row + 1 if self._satisfies() else 0
        elif not at_end:
            return
        self.too_many_failed = self.failed_in_prefix > self.max_failed_fraction * self.prefix
        if at_end or self.too_many_failed or self._satisfied_in_a_row >= LOOKS_IN_A_ROW:
            self.size = self.prefix

    def _satisfies(self) -> bool:
        """Whether this checkpoint satisfies the rule; the mean is asked first, because it costs little."""
        mean = mean_interval(self._usable[: self._n_usable], self.rule.confidence)
        return mean.precision <= self.rule.mean_tolerance and self.latest().satisfies(self.rule)

    def _look(self, realizations: int, usable: int) -> Checkpoint:
        """Return the estimates from a prefix with so many usable run-outs; computed once."""
        if realizations not in self._looks:
            runouts = self._usable[:usable]
            self._looks[realizations] = look(runouts, realizations, self.rule.confidence, self.threshold)
        return self._looks[realizations]

    @property
    def done(self) -> int:
        """Finished realizations, whether or not they are in the result."""
        return len(self.summaries) - (BASELINE in self.summaries)

    @property
    def threshold(self) -> float:
        """Run-out of the baseline [m]; NaN when it is not there or failed."""
        baseline = self.summaries.get(BASELINE)
        return baseline.final_runout if baseline is not None and baseline.status not in FAILED else math.nan

    def latest(self) -> Checkpoint:
        """Return the estimates from the whole prefix."""
        return self._look(self.prefix, self._n_usable)

    def history(self) -> ConvergenceHistory:
        """Return the estimates at the checkpoints of the prefix, and at its end."""
        end = (self.prefix, self._n_usable)
        places = self._checkpoints if end in self._checkpoints[-1:] else [*self._checkpoints, end]
        return tabulate([self._look(*place) for place in places], self.rule)

    def checkpoints(self) -> int:
        """Return how many checkpoints the prefix has passed."""
        return max(0, (self.prefix - self.rule.minimum) // self.rule.block + 1)


def tally_of(scene: Scene) -> Tally:
    """Return the empty account of a scene's campaign."""
    wanted = scene.campaign
    rule = StoppingRule(
        wanted.mean_tolerance, wanted.variance_tolerance, wanted.confidence, wanted.minimum, wanted.block
    )
    return Tally(wanted.realizations, rule, wanted.max_failed_fraction)
