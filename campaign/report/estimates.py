"""The numbers of the answer with their intervals, a function for each: for words, tables and figures alike."""

from campaign.results.results import Results
from campaign.statistics import proportions
from campaign.statistics.intervals import Interval, mean_interval, quantile_interval, std_interval
from campaign.statistics.total import total_interval, total_mean

FAR = 0.95
"""The share of slides that stop before the distance named in the answer."""


def slide_probability(results: Results) -> Interval:
    """Return the probability that the slope slides."""
    return proportions.slide_probability(results.outcomes, results.confidence)


def mean_runout(results: Results) -> Interval:
    """Return the mean run-out of the slides in m, with sampling error alone.

    It is at least so much where more than a few slides were cut short.
    """
    mean = mean_interval(results.slide_runouts, results.confidence)
    return mean._replace(is_least=not results.outcomes.bound_the_mean)


def total_runout(results: Results) -> Interval:
    """Return the mean run-out of the slides in m, with sampling and, where that is known, mesh error.

    It has no upper bound where more than a few slides were cut short.
    """
    return total_mean(mean_runout(results), results.discretisation, results.outcomes.bound_the_mean)


def std_runout(results: Results) -> Interval:
    """Return the standard deviation of the run-out of the slides in m."""
    return std_interval(results.slide_runouts, results.confidence)


def quantile_runout(results: Results, share: float) -> Interval:
    """Return the distance in m within which a share of the slides stops; those cut short may come any farther.

    It is at least so much where that would change it, and has no upper bound where nothing is known of one.
    """
    return quantile_interval(results.slide_runouts, share, results.confidence, results.outcomes.is_cut_short)


def total_quantile(results: Results, share: float) -> Interval:
    """Return the same with sampling and, where that is known, mesh error; a bound may be NaN for itself."""
    return total_interval(quantile_runout(results, share), results.discretisation)


def exceedance(results: Results, distance: float) -> Interval:
    """Return the probability of a run-out beyond a distance in m; without a slide the run-out is zero."""
    return proportions.exceedance(results.outcomes, distance, results.confidence)


def exceedance_given_sliding(results: Results, distance: float) -> Interval:
    """Return the probability that a slide runs beyond a distance in m."""
    return proportions.exceedance_given_sliding(results.outcomes, distance, results.confidence)
