"""Probabilities from counts, each with its interval, and what is left open by realizations that cannot be counted."""

import math
from functools import lru_cache

from scipy import special

from campaign.statistics.intervals import Interval, unknown
from campaign.statistics.outcomes import Outcomes


@lru_cache(maxsize=4096)
def exact_interval(successes: int, n: int, confidence: float) -> Interval:
    """Proportion with the interval of Clopper and Pearson, which holds at least as often as it says for every truth.

    With a = (1 - confidence) / 2 the bounds are the proportions at which so many successes or more, or so few or fewer,
    have the probability a. Of n realizations without a success the upper bound is 1 - a^(1/n): at 95 % confidence
    8.8 % after 40, 7.1 % after 50.

    Returns
    -------
    Interval
        All NaN for n = 0.

    References
    ----------
    C. J. Clopper and E. S. Pearson (1934), Biometrika 26, 404-413.
    """
    if n == 0:
        return unknown(math.nan, 0)
    tail = (1 - confidence) / 2
    lower = special.betaincinv(successes, n - successes + 1, tail) if successes else 0.0
    upper = special.betaincinv(successes + 1, n - successes, 1 - tail) if successes < n else 1.0
    return Interval(successes / n, float(lower), float(upper), n)


def results_to_bound(chance: float, confidence: float) -> int:
    """Return how many results without a success bound a proportion by `chance`: the same bound, solved for n."""
    return math.ceil(math.log((1.0 - confidence) / 2.0) / math.log(1.0 - chance))


def slide_probability(outcomes: Outcomes, confidence: float) -> Interval:
    """Probability that the slope slides, with its interval (Clopper and Pearson)."""
    return exact_interval(outcomes.slides, outcomes.usable, confidence)


def exceedance(outcomes: Outcomes, distance: float, confidence: float) -> Interval:
    """Probability of a run-out beyond a distance [m], with its interval (Clopper and Pearson); 0 m without a slide.

    A slide that was cut short before the distance may have gone beyond it: for the estimate and the lower bound none of
    these would have, for the upper bound all.
    """
    return _share_beyond(outcomes, distance, outcomes.usable, confidence)


def exceedance_given_sliding(outcomes: Outcomes, distance: float, confidence: float) -> Interval:
    """Do the same as `exceedance` for a slope of which it is known that it slides."""
    return _share_beyond(outcomes, distance, outcomes.slides, confidence)


def _share_beyond(outcomes: Outcomes, distance: float, n: int, confidence: float) -> Interval:
    if math.isnan(distance):
        return unknown(math.nan, n)
    beyond, undecided = outcomes.beyond(distance), outcomes.undecided(distance)
    least, most = (exact_interval(count, n, confidence) for count in (beyond, beyond + undecided))
    return least._replace(upper=most.upper, is_least=undecided > 0)


def failure_bounds(exceeding: int, valid: int, failed: int) -> tuple[float, float]:
    """Lowest and highest exceedance share when nothing is assumed about the failed realizations.

    Failure may go with long run-out, so leaving failed realizations out may bias the share. None of them exceeding
    gives the lower bound, all of them the upper one. The bounds hold the bias alone; sampling error comes on top.

    Parameters
    ----------
    exceeding, valid, failed : int
        Realizations above the threshold, with a usable result (including the exceeding ones), and without one.

    Returns
    -------
    lowest, highest : float
        Both NaN when there are no realizations.

    References
    ----------
    J. L. Horowitz and C. F. Manski (1995), Econometrica 63, 281-302.
    """
    n = valid + failed
    if n == 0:
        return math.nan, math.nan
    return exceeding / n, (exceeding + failed) / n
