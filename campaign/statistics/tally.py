"""The account of a campaign: which realizations are finished, and whether they suffice.

Decisions are made on contiguous prefixes of ids (all k < m finished) at the rule's checkpoints, so that the number of
realizations in the result depends neither on ranks nor on the order in which they finish.
"""

import math
from typing import NamedTuple

from campaign.record import FAILED, Front, RealizationSummary
from campaign.scene import Scene
from campaign.scene.layers import random_properties
from campaign.scene.sections import Campaign
from campaign.seeds import BASELINE
from campaign.statistics.convergence import ConvergenceHistory, history_of, is_look
from campaign.statistics.outcomes import Account
from campaign.statistics.stopping import Checkpoint, StoppingRule, is_converged, may_look


class Fault(NamedTuple):
    """A realization that its rank could not compute, for a reason that is not the realization's.

    Attributes
    ----------
    realization
        Its id; nothing is recorded.
    reason
        What happened, and on which rank.
    retires
        Whether the rank takes no more work.
    """

    realization: int
    reason: str
    retires: bool


class RankReport(NamedTuple):
    """A rank's word to rank 0: what it has finished, why all must stop ("" if they need not), what it could not do."""

    finished: RealizationSummary | None
    problem: str = ""
    fault: Fault | None = None


class Tally:
    """Finished realizations of a campaign of at most `maximum`, judged by `rule` on the run-out of `front`.

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
    failed : int
        Failures among all finished realizations.
    longest : float
        Wall-clock time of the slowest realization [s], the baseline included.
    """

    def __init__(self, maximum: int, rule: StoppingRule, max_failed_fraction: float, front: Front) -> None:
        self.maximum = maximum
        self.rule = rule
        self.max_failed_fraction = max_failed_fraction
        self.front: Front = front
        self.summaries: dict[int, RealizationSummary] = {}
        self.prefix = 0
        self.size: int | None = None
        self.too_many_failed = False
        self.failed = 0
        self.longest = 0.0
        self._account = Account(maximum, front)
        self._looks: list[Checkpoint] = []
        self._latest: Checkpoint | None = None

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
            self._account.add(self.summaries[self.prefix])
            self.prefix += 1
            self._judge()
        if self.maximum == 0 and BASELINE in self.summaries:
            self.size = 0

    def _judge(self) -> None:
        at_end = self.prefix == self.maximum
        if not (at_end or may_look(self.prefix, self.rule)):
            return
        latest = self.latest()
        if is_look(latest, self.rule):
            self._looks.append(latest)
        elif not at_end:
            return
        self.too_many_failed = self.failed_in_prefix > self.max_failed_fraction * self.prefix
        if at_end or self.too_many_failed or is_converged(self._looks, self.rule):
            self.size = self.prefix

    @property
    def done(self) -> int:
        """Finished realizations, whether or not they are in the result."""
        return len(self.summaries) - (BASELINE in self.summaries)

    @property
    def failed_in_prefix(self) -> int:
        """Failures among the realizations of the prefix."""
        return self._account.failed

    @property
    def threshold(self) -> float:
        """Run-out of the baseline [m]; NaN when it is not there or failed."""
        baseline = self.summaries.get(BASELINE)
        return math.nan if baseline is None else baseline.runout(self.front)

    def latest(self) -> Checkpoint:
        """Return the estimates from the whole prefix; the same object as long as that is the same."""
        if self._latest is None or self._latest.realizations != self.prefix:
            self._latest = Checkpoint(self._account.outcomes(), self.rule.confidence, self.threshold)
        return self._latest

    def history(self) -> ConvergenceHistory:
        """Return the estimates at the checkpoints of the prefix, and at its end."""
        return history_of(self._looks, self.latest(), self.rule)

    def checkpoints(self) -> int:
        """Return how many checkpoints the prefix has passed."""
        return max(0, (self.prefix - self.rule.minimum) // self.rule.block + 1)


def tally_of(scene: Scene) -> Tally:
    """Return the empty account of a scene's campaign."""
    return tally_for(scene.campaign, scene.slide.front, nothing_varies=not random_properties(scene))


def tally_for(wanted: Campaign, front: Front, nothing_varies: bool = False) -> Tally:
    """Return the empty account of a campaign that is judged on the run-out of `front`."""
    rule = StoppingRule(
        wanted.mean_tolerance,
        wanted.variance_tolerance,
        wanted.confidence,
        wanted.minimum,
        wanted.block,
        wanted.slide_probability_tolerance,
        nothing_varies,
    )
    return Tally(wanted.realizations, rule, wanted.max_failed_fraction, front)
