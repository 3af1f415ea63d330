"""The mean of a costly model from few runs of it and many of cheaper ones, on the same realizations.

Models 0, 1, ..., M are ordered from the one that is asked for to the cheapest. Model m has run the first n_m
realizations, n_0 <= n_1 <= ... <= n_M, so that whatever a model has run, all cheaper ones have run too. With mean_m the
mean over the first n_m realizations,

    mu_M = mean_M(Y_M),    mu_m = mean_m(Y_m) + b_m (mu_{m+1} - mean_m(Y_{m+1})),

where b_m is the slope of the regression of Y_m on Y_{m+1} over those realizations. That is the maximum likelihood
estimator of normal samples with such a pattern of missing values in which each model adds to what the next one tells
(Anderson 1957), hence the best linear unbiased one where the slopes are known. With b = 1 it is multilevel Monte Carlo
(Giles 2015), with the slopes of a chain multifidelity Monte Carlo (Peherstorfer, Willcox and Gunzburger 2016). More
general patterns, of runs of a cheap model alone where a costlier one has run, save at most what those cheap runs cost.

References
----------
T. W. Anderson (1957), Journal of the American Statistical Association 52, 200-203. M. B. Giles (2015), Acta Numerica
24, 259-328. B. Peherstorfer, K. Willcox, M. Gunzburger (2016), SIAM Journal on Scientific Computing 38, A3163-A3194.
D. Schaden and E. Ullmann (2020), SIAM/ASA Journal on Uncertainty Quantification 8, 601-635.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from campaign.statistics.intervals import Interval, Sample, student_quantile

FEWEST = 4
"""Runs of a model from which on its regression leaves something to judge it by."""


class NestedMean(NamedTuple):
    """An estimated mean of model 0.

    Attributes
    ----------
    estimate, variance : float
        The latter of the estimate, in the squared unit.
    degrees : float
        Of freedom of the variance, after Welch and Satterthwaite.
    scatter : tuple of float
        What the runs of each model leave of the variance, times their number: the variance of the estimate is about
        the sum of scatter over number of runs.
    n : int
        Runs of model 0.
    """

    estimate: float
    variance: float
    degrees: float
    scatter: tuple[float, ...]
    n: int

    def interval(self, confidence: float) -> Interval:
        """Return the estimate with Student's t interval."""
        half_width = student_quantile(confidence, self.degrees) * math.sqrt(self.variance)
        return Interval(self.estimate, self.estimate - half_width, self.estimate + half_width, self.n)


class _Part(NamedTuple):
    """The share of one model in the variance of the estimate."""

    variance: float
    degrees: int
    scatter: float

    def passed_on(self, slope: float) -> "_Part":
        return _Part(slope**2 * self.variance, self.degrees, slope**2 * self.scatter)


def nested_mean(columns: Sequence[Sample], cheapest: Sample | None = None) -> NestedMean:
    """Estimate the mean of the first model.

    Parameters
    ----------
    columns : arrays (n_0,), (n_1,), ..., (n_M,)
        Values of each model at realizations 0, 1, ..., in one unit.
    cheapest : array (n_M,), optional
        Values of the same mean as the cheapest model's and of less scatter, as `controlled` returns them.

    Raises
    ------
    ValueError
        If a model has run fewer than `FEWEST` realizations or more than a cheaper one.
    """
    counts = [len(column) for column in columns]
    if counts[0] < FEWEST or counts != sorted(counts):
        raise ValueError(f"Runs of {counts} are not nested samples of at least {FEWEST}.")
    base = columns[-1] if cheapest is None else cheapest
    estimate, parts = float(np.mean(base)), [_part_of(base)]
    for values, cheaper in reversed([*pairwise(columns)]):
        estimate, own, slope = _corrected(values, cheaper[: len(values)], estimate)
        parts = [own, *(part.passed_on(slope) for part in parts)]
    variance = math.fsum(part.variance for part in parts)
    return NestedMean(
        estimate, variance, _degrees(parts, variance), tuple(part.scatter for part in parts), len(columns[0])
    )


def _part_of(values: Sample) -> _Part:
    scatter = float(np.var(values, ddof=1))
    return _Part(scatter / len(values), len(values) - 1, scatter)


def _corrected(values: Sample, cheaper: Sample, mean_of_cheaper: float) -> tuple[float, _Part, float]:
    """Return the mean, what the values themselves leave of its variance, and the slope of the regression."""
    n, mean, mean_there = len(values), float(np.mean(values)), float(np.mean(cheaper))
    deviations = cheaper - mean_there
    squares = float(deviations @ deviations)
    if squares == 0.0:
        return mean, _part_of(values), 0.0
    slope = float(deviations @ values) / squares
    residuals = values - mean - slope * deviations
    scatter, away = float(residuals @ residuals) / (n - 2), mean_of_cheaper - mean_there
    own = _Part(scatter * (1 / n + away**2 / squares), n - 2, scatter)
    return mean + slope * away, own, slope


def _degrees(parts: Sequence[_Part], variance: float) -> float:
    if variance == 0.0:
        return float(parts[0].degrees)
    return variance**2 / math.fsum(part.variance**2 / part.degrees for part in parts)
