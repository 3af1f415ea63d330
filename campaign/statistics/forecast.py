"""How many realizations a campaign will need, if its estimates stay as they are."""

import math

from campaign.statistics.intervals import normal_quantile
from campaign.statistics.stopping import LOOKS_IN_A_ROW, RARE, Checkpoint, StoppingRule


def predicted_stop(latest: Checkpoint, rule: StoppingRule) -> float:
    """Return the number of realizations at which the rule would stop if all estimates stayed as they are.

    Returns
    -------
    float
        NaN where too little is known, infinity where the mean run-out is zero.
    """
    outcomes = latest.outcomes
    if outcomes.usable == 0:
        return math.nan
    per_result = outcomes.realizations / outcomes.usable
    if outcomes.slides == 0:
        blocks = math.ceil(_without_slides(rule) * per_result / rule.block)
        return float(max(blocks * rule.block, outcomes.realizations))
    runout = _for_runout_or_rarity(latest, rule)
    if not math.isfinite(runout):
        return runout
    needed = max(_for_slide_probability(latest, rule), runout, rule.minimum) * per_result
    blocks = math.ceil((needed - rule.minimum) / rule.block) + LOOKS_IN_A_ROW - 1
    return float(max(rule.minimum + blocks * rule.block, outcomes.realizations))


def _without_slides(rule: StoppingRule) -> float:
    """Return the results without a slide from which on the upper bound, 1 - a^(1/n), is as low as the rule asks."""
    highest = min(RARE, 2 * rule.slide_probability_tolerance)
    return math.log((1 - rule.confidence) / 2) / math.log1p(-highest)


def _for_slide_probability(latest: Checkpoint, rule: StoppingRule) -> float:
    """Return the results needed for the probability of sliding p.

    The half-width of its interval is about z sqrt(p (1 - p) / n) + 1 / (2 n), which for large n gives
    n = z^2 p (1 - p) / tolerance^2 + 1 / tolerance.
    """
    p, tolerance, z = latest.slide_probability.estimate, rule.slide_probability_tolerance, _z(rule)
    return z**2 * p * (1 - p) / tolerance**2 + 1 / tolerance


def _for_runout_or_rarity(latest: Checkpoint, rule: StoppingRule) -> float:
    """Return the results after which the run-out is known, or slides are known to be rare, whichever comes first."""
    runout, rarity = _for_runout(latest, rule), _for_rarity(latest, rule)
    return min((each for each in (runout, rarity) if not math.isnan(each)), default=math.nan)


def _for_runout(latest: Checkpoint, rule: StoppingRule) -> float:
    """Return the results needed for mean and variance of the run-out.

    The half-widths are those of `mean_interval` and `variance_interval` for large n, solved for n:
    (z s / (tolerance mean))^2 and 1 + z^2 (kurtosis - 1) / asinh(tolerance)^2 slides.
    """
    if not latest.variance.is_known:
        return math.nan
    if latest.mean.estimate == 0:
        return math.inf
    z = _z(rule)
    for_mean = z**2 * latest.variance.estimate / (rule.mean_tolerance * latest.mean.estimate) ** 2
    for_variance = 1 + z**2 * (latest.kurtosis - 1) / math.asinh(rule.variance_tolerance) ** 2
    return max(for_mean, for_variance, rule.minimum) / latest.slide_probability.estimate


def _for_rarity(latest: Checkpoint, rule: StoppingRule) -> float:
    """Return the results after which p has the upper bound u = `RARE`: n = z^2 u (1 - u) / (u - p)^2; NaN if never."""
    p = latest.slide_probability.estimate
    return _z(rule) ** 2 * RARE * (1 - RARE) / (RARE - p) ** 2 if p < RARE else math.nan


def _z(rule: StoppingRule) -> float:
    return normal_quantile(rule.confidence)
