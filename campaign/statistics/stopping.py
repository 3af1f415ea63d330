"""The stopping rule: stop when the answer is known well enough.

The rule looks at the realizations in the order of their ids, at fixed checkpoints, and never at the clock: a long slide
takes long to compute, so "what has finished by now" is a biased sample. The answer is the same for any number of ranks.
"""

from dataclasses import dataclass
from functools import cached_property

from campaign.scene.sections import Campaign
from campaign.statistics import proportions
from campaign.statistics.intervals import Interval, kurtosis, mean_interval, variance_interval
from campaign.statistics.outcomes import Outcomes
from campaign.terminal import counted

LOOKS_IN_A_ROW = 2
"""One look may satisfy the rule by luck; two in a row seldom do."""

RARE = 0.1
"""A slope whose probability of sliding is certainly at most this is not asked for the run-out of its slides.

At this probability a hundred slides take a thousand realizations. Whoever needs them gives a scene that slides more
often.
"""


@dataclass(frozen=True)
class StoppingRule:
    """When to stop: all half-widths within their tolerances at two checkpoints in a row.

    Parameters
    ----------
    mean_tolerance, variance_tolerance : float
        Half-widths for the run-out of the slides, relative to mean and variance. They are not asked where slides are
        `RARE`.
    confidence : float
        Of each interval, at each look. It is not adjusted for repeated looks: from `minimum` = 100 on they cost normal
        run-outs no coverage, and skewed ones about one percentage point of the variance's. At 95 %, the intervals of
        mean and variance hold together in about 90 % of the campaigns.
    minimum, block : int
        Checkpoints are at `minimum`, `minimum + block`, ... realizations. One with fewer than `minimum` results, or
        where slides are not rare with fewer than `minimum` slides, never satisfies the rule.
    slide_probability_tolerance : float
        Half-width of the confidence interval of the probability of sliding, absolute.
    nothing_varies : bool
        Whether nothing is random, so that all run-outs are the same and have no variance to be known.
    """

    mean_tolerance: float
    variance_tolerance: float
    confidence: float
    minimum: int
    block: int
    slide_probability_tolerance: float
    nothing_varies: bool = False


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """What the first realizations say; an estimate is computed when somebody asks for it.

    Parameters
    ----------
    outcomes : Outcomes
    confidence : float
        Of the intervals.
    threshold : float
        Run-out whose exceedance is estimated [m]; NaN if there is none.
    """

    outcomes: Outcomes
    confidence: float
    threshold: float

    @cached_property
    def slide_probability(self) -> Interval:
        """Probability that the slope slides."""
        return proportions.slide_probability(self.outcomes, self.confidence)

    @cached_property
    def mean(self) -> Interval:
        """Mean run-out of the slides [m]."""
        return mean_interval(self.outcomes.runouts, self.confidence)

    @cached_property
    def kurtosis(self) -> float:
        """Kurtosis of the run-out of the slides."""
        return kurtosis(self.outcomes.runouts)

    @cached_property
    def variance(self) -> Interval:
        """Variance of the run-out of the slides [m2]."""
        return variance_interval(self.outcomes.runouts, self.confidence, self.kurtosis)

    @cached_property
    def exceedance(self) -> Interval:
        """Probability of a run-out beyond the threshold."""
        return proportions.exceedance(self.outcomes, self.threshold, self.confidence)

    @cached_property
    def exceedance_given_sliding(self) -> Interval:
        """The same for a slope that slides."""
        return proportions.exceedance_given_sliding(self.outcomes, self.threshold, self.confidence)

    @property
    def realizations(self) -> int:
        """Number of realizations looked at."""
        return self.outcomes.realizations

    @property
    def slides_are_rare(self) -> bool:
        """Whether the probability of sliding is certainly at most `RARE`."""
        return self.slide_probability.upper <= RARE

    def knows_slide_probability(self, rule: StoppingRule) -> bool:
        """Whether the probability of sliding is within its tolerance; NaN, "not enough yet", is not."""
        return self.slide_probability.half_width <= rule.slide_probability_tolerance

    def knows_runout(self, rule: StoppingRule) -> bool:
        """Whether mean and variance of the run-out are within their tolerances; the mean is asked first, for speed."""
        return self.outcomes.slides >= rule.minimum and (
            rule.nothing_varies
            or (self.mean.precision <= rule.mean_tolerance and self.variance.precision <= rule.variance_tolerance)
        )

    def satisfies(self, rule: StoppingRule) -> bool:
        """Whether this checkpoint counts as one of the looks in a row that stop a campaign."""
        return (
            is_regular(self.realizations, rule)
            and self.outcomes.usable >= rule.minimum
            and self.knows_slide_probability(rule)
            and (self.slides_are_rare or self.knows_runout(rule))
        )

    def shows_stability(self, rule: StoppingRule) -> bool:
        """Whether nothing has slid, in enough realizations to say that slides are rare: then a single look suffices.

        Without a slide the bound depends on the number of results alone, so that no look before this one could have
        satisfied the rule by luck, and `minimum`, which mean and variance need, is not asked.
        """
        return (
            self.outcomes.slides == 0
            and self.realizations % rule.block == 0
            and self.knows_slide_probability(rule)
            and self.slides_are_rare
        )


def too_few(asked: Campaign) -> str:
    """Say in a sentence that no campaign of so few realizations can converge by its slides, "" if it can.

    With an accuracy the rule is not asked.
    """
    needed = asked.minimum + (LOOKS_IN_A_ROW - 1) * asked.block
    if asked.accuracy is not None or asked.realizations >= needed:
        return ""
    return (
        f"At most {counted(asked.realizations, 'realization')} cannot converge where the slope slides: "
        f"campaign.minimum = {asked.minimum} and campaign.block = {asked.block} ask for {needed:,} or more."
    )


def is_regular(count: int, rule: StoppingRule) -> bool:
    """Whether the rule looks at this number of realizations however many have finished."""
    return count >= rule.minimum and (count - rule.minimum) % rule.block == 0


def may_look(count: int, rule: StoppingRule) -> bool:
    """Whether this number of realizations is one that the rule looks at, whatever became of them."""
    return is_regular(count, rule) or count % rule.block == 0


def is_converged(looks: list[Checkpoint], rule: StoppingRule) -> bool:
    """Whether the latest looks satisfy the rule."""
    latest = looks[-LOOKS_IN_A_ROW:]
    if latest and latest[-1].shows_stability(rule):
        return True
    return len(latest) == LOOKS_IN_A_ROW and all(each.satisfies(rule) for each in latest)
