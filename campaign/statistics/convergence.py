"""The stopping rule: stop when the mean and the variance of the run-out are known well enough.

The rule looks at the realizations in the order of their ids, at fixed checkpoints, and never at the clock: a long slide
takes long to compute, so "what has finished by now" is a biased sample. The answer is the same for any number of ranks.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from campaign.statistics.intervals import (
    Interval,
    Sample,
    kurtosis,
    mean_interval,
    normal_quantile,
    proportion_interval,
    unknown,
    variance_interval,
)

# One look may satisfy the rule by luck; two in a row seldom do.
LOOKS_IN_A_ROW = 2


@dataclass(frozen=True)
class StoppingRule:
    """When to stop: both half-widths within their tolerances at two checkpoints in a row.

    Parameters
    ----------
    mean_tolerance, variance_tolerance : float
        Half-widths of the confidence intervals, relative to the mean and to the variance.
    confidence : float
        Of each interval, at each look. It is not adjusted for repeated looks: from `minimum` = 100 on they cost normal
        run-outs no coverage, and skewed ones about one percentage point of the variance's. At 95 %, the two intervals
        hold together in about 90 % of the campaigns.
    minimum, block : int
        Checkpoints are at `minimum`, `minimum + block`, ... realizations. One with fewer than `minimum` usable
        realizations never satisfies the rule.
    """

    mean_tolerance: float
    variance_tolerance: float
    confidence: float
    minimum: int
    block: int


@dataclass(frozen=True)
class Checkpoint:
    """What the first `realizations` realizations say; the intervals rest on the usable ones among them."""

    realizations: int
    mean: Interval
    variance: Interval
    exceedance: Interval
    kurtosis: float

    @property
    def n(self) -> int:
        """Number of usable realizations."""
        return self.mean.n

    def is_within(self, rule: StoppingRule) -> bool:
        """Whether both tolerances are met; NaN, "not enough yet", meets none."""
        return self.mean.precision <= rule.mean_tolerance and self.variance.precision <= rule.variance_tolerance

    def satisfies(self, rule: StoppingRule) -> bool:
        """Whether this checkpoint counts as one of the looks in a row that stop a campaign."""
        return self.n >= rule.minimum and is_regular(self.realizations, rule) and self.is_within(rule)


@dataclass(frozen=True)
class ConvergenceHistory:
    """Estimates at every checkpoint, up to the one where the rule was satisfied, and the verdict.

    Attributes
    ----------
    realizations, n : int arrays (checkpoint,)
        Realizations looked at, and the usable ones among them.
    mean, variance, exceedance : arrays (checkpoint,)
        Of the usable run-outs [m], [m2], and the share of them above the threshold.
    mean_ci, variance_ci, exceedance_ci : arrays (checkpoint, 2)
        Lower and upper bounds. NaN: not enough yet.
    predicted_n : array (checkpoint,)
        Realizations at which the rule would stop if mean, variance and kurtosis stayed as they are.
    converged_at : int or None
        The number of realizations the rule asked for; realizations from this id on are not part of the result.
    verdict : str
        A sentence.
    """

    realizations: NDArray[np.int64]
    n: NDArray[np.int64]
    mean: Sample
    mean_ci: Sample
    variance: Sample
    variance_ci: Sample
    exceedance: Sample
    exceedance_ci: Sample
    predicted_n: Sample
    converged_at: int | None
    verdict: str


def convergence_history(
    values: Sample, usable: NDArray[np.bool_], rule: StoppingRule, threshold: float
) -> ConvergenceHistory:
    """Apply the stopping rule to the contiguous prefix of finished realizations.

    Parameters
    ----------
    values : array (realization,)
        Final run-out of realization 0, 1, 2, ... [m], without gaps in the ids.
    usable : bool array (realization,)
        Whether the run-out counts. False where nothing slid or the realization failed, whatever its value.
    rule : StoppingRule
    threshold : float
        Run-out whose exceedance is estimated [m]; NaN if there is none.

    Returns
    -------
    ConvergenceHistory
        At least one row. Where the last realization is not at a checkpoint it has a row of its own, which reports but
        never satisfies the rule: it would make the verdict depend on when one looked.
    """
    looks: list[Checkpoint] = []
    for count in checkpoints(len(values), rule):
        looks.append(look(values[:count][usable[:count]], count, rule.confidence, threshold))
        if is_converged(looks, rule):
            break
    return tabulate(looks, rule)


def checkpoints(count: int, rule: StoppingRule) -> list[int]:
    """Numbers of realizations at which the rule looks, and `count` itself."""
    regular = list(range(rule.minimum, count + 1, rule.block))
    return regular if regular and regular[-1] == count else [*regular, count]


def is_regular(count: int, rule: StoppingRule) -> bool:
    """Whether the rule looks at this number of realizations however many have finished."""
    return count >= rule.minimum and (count - rule.minimum) % rule.block == 0


def look(runouts: Sample, realizations: int, confidence: float, threshold: float) -> Checkpoint:
    """Estimate everything at one checkpoint."""
    n = len(runouts)
    exceeding, tail = int(np.count_nonzero(runouts > threshold)), kurtosis(runouts)
    return Checkpoint(
        realizations=realizations,
        mean=mean_interval(runouts, confidence),
        variance=variance_interval(runouts, confidence, tail),
        exceedance=unknown(math.nan, n) if math.isnan(threshold) else proportion_interval(exceeding, n, confidence),
        kurtosis=tail,
    )


def is_converged(looks: list[Checkpoint], rule: StoppingRule) -> bool:
    """Whether the latest looks in a row satisfy the rule."""
    latest = looks[-LOOKS_IN_A_ROW:]
    return len(latest) == LOOKS_IN_A_ROW and all(each.satisfies(rule) for each in latest)


def predicted_stop(latest: Checkpoint, rule: StoppingRule) -> float:
    """Realizations at which the rule would stop if mean, variance, kurtosis and usable share stayed as they are.

    The half-widths are those of `mean_interval` and `variance_interval` for large n, solved for n:
    (z s / (tolerance mean))^2 and 1 + z^2 (kurtosis - 1) / asinh(tolerance)^2.

    Returns
    -------
    float
        NaN where the variance is not known yet, infinity where the mean is zero.
    """
    if not latest.variance.is_known:
        return math.nan
    if latest.mean.estimate == 0:
        return math.inf
    z = normal_quantile(rule.confidence)
    for_mean = z**2 * latest.variance.estimate / (rule.mean_tolerance * latest.mean.estimate) ** 2
    for_variance = 1 + z**2 * (latest.kurtosis - 1) / math.asinh(rule.variance_tolerance) ** 2
    realizations = max(for_mean, for_variance, rule.minimum) * latest.realizations / latest.n
    blocks = math.ceil((realizations - rule.minimum) / rule.block) + LOOKS_IN_A_ROW - 1
    return float(max(rule.minimum + blocks * rule.block, latest.realizations))


def tabulate(looks: list[Checkpoint], rule: StoppingRule) -> ConvergenceHistory:
    """Turn checkpoints into arrays over checkpoints."""
    converged_at = looks[-1].realizations if is_converged(looks, rule) else None
    return ConvergenceHistory(
        realizations=np.array([each.realizations for each in looks]),
        n=np.array([each.n for each in looks]),
        mean=np.array([each.mean.estimate for each in looks]),
        mean_ci=np.array([(each.mean.lower, each.mean.upper) for each in looks]),
        variance=np.array([each.variance.estimate for each in looks]),
        variance_ci=np.array([(each.variance.lower, each.variance.upper) for each in looks]),
        exceedance=np.array([each.exceedance.estimate for each in looks]),
        exceedance_ci=np.array([(each.exceedance.lower, each.exceedance.upper) for each in looks]),
        predicted_n=np.array([predicted_stop(each, rule) for each in looks]),
        converged_at=converged_at,
        verdict=stopping_verdict(looks[-1], rule, converged_at is not None),
    )


def stopping_verdict(latest: Checkpoint, rule: StoppingRule, converged: bool) -> str:
    """Say in a sentence whether the rule is satisfied, and if not, what is missing."""
    count = f"{latest.realizations} realizations"
    if converged:
        mean, variance = percent(latest.mean.precision), percent(latest.variance.precision)
        known = f"the mean is known to {mean}, the variance to {variance}"
        return f"converged at {count}: {known}, at {percent(rule.confidence)} confidence"
    if latest.n < rule.minimum:
        return f"not enough yet: {latest.n} usable run-outs in {count}, at least {rule.minimum} were asked"
    if not latest.variance.is_known:
        return f"not converged after {count}: the {latest.n} usable run-outs give no interval for the variance"
    return f"not converged after {count}: {shortfall(latest, rule)}"


def shortfall(latest: Checkpoint, rule: StoppingRule) -> str:
    """Name the tolerances that are not met."""
    asked = {
        "mean": (latest.mean.precision, rule.mean_tolerance),
        "variance": (latest.variance.precision, rule.variance_tolerance),
    }
    missed = [
        f"the {name} is known to {percent(precision)}, {percent(tolerance)} was asked"
        for name, (precision, tolerance) in asked.items()
        if precision > tolerance
    ]
    return "; ".join(missed) or f"both tolerances are met, but not yet at {LOOKS_IN_A_ROW} checkpoints in a row"


def percent(share: float) -> str:
    """Write a share in per cent, with three digits or all before the decimal point."""
    return f"{100 * share:.3g} %" if share < 1 else f"{100 * share:.0f} %"
