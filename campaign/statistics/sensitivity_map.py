"""Where in the ground strength governs the run-out: regression of run-outs on maps of the random properties.

The run-out is taken as linear in the logarithm of every property in every box, and the coefficients of all of them are
found together by ridge regression on standardised logarithms. Neighbouring boxes have much the same soil, so what is
told of a box is told of its surroundings as well; coefficients are drawn towards zero, and never are of the wrong
order. A coefficient is called clear by the rule of Benjamini and Hochberg (1995), Journal of the Royal Statistical
Society B 57, 289-300: of all clear ones a share of at most 1 - confidence is expected to be clear by chance.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import special

from campaign.scene.inputs import MORE
from campaign.statistics.intervals import Interval, Sample, normal_quantile
from campaign.statistics.ridge import Matrix, Ridge, ridge

FEWEST = 50
"""Slides, of fewer there is no map."""


class SensitivityMap(NamedTuple):
    """What 10 % more of a property somewhere changes, all else unchanged.

    Attributes
    ----------
    change, error : arrays (property, row, column)
        Of the run-out in m, and its standard error by sampling; NaN where there is no ground, or the
        property is not random.
    is_clear : bool array (property, row, column)
        Whether the change can be told from none.
    everywhere : tuple of Interval
        The change in m by 10 % more of the property in all boxes: the sum over the boxes.
    explained : float
        Share of the variance of the run-out that the maps foretell of realizations left out.
    """

    change: Matrix
    error: Matrix
    is_clear: NDArray[np.bool_]
    everywhere: tuple[Interval, ...]
    explained: float


def sensitivity_map(field_map: Matrix, runouts: Sample, confidence: float) -> SensitivityMap:
    """Regress run-outs on the maps of the properties.

    Parameters
    ----------
    field_map : array (n, property, row, column)
        Means of the logarithm of the properties; NaN where there is no ground, or the property is not random.
    runouts : array (n,)
        In m.
    confidence : float
        Of `everywhere`, and 1 - the false discovery rate of `is_clear`.
    """
    is_random = np.asarray(np.isfinite(field_map).all(axis=0))
    logarithms = field_map[:, is_random]
    scatter = logarithms.std(axis=0, ddof=1)
    fit = ridge(logarithms / scatter, runouts)
    step = math.log1p(MORE) / scatter
    change, error = step * fit.coefficients, step * np.sqrt(fit.variance * np.sum(fit.operator**2, axis=1))
    chance = 2 * special.ndtr(-np.abs(change) / error)

    def on_map(values: Sample, missing: float) -> Matrix:
        filled = np.full(is_random.shape, missing)
        filled[is_random] = values
        return filled

    is_clear = on_map(_false_discovery_rate(chance), 1.0) <= 1 - confidence
    everywhere = (_sum(fit, each, confidence) for each in _of_each(step, is_random))
    return SensitivityMap(on_map(change, np.nan), on_map(error, np.nan), is_clear, tuple(everywhere), fit.explained)


def _false_discovery_rate(chance: Sample) -> Sample:
    from scipy.stats import false_discovery_control  # takes half a second to load, which not every rank should pay

    return np.asarray(false_discovery_control(chance))


def _of_each(step: Sample, is_random: NDArray[np.bool_]) -> Matrix:
    """Return the steps of one property at a time, the others zero, (property, m)."""
    properties = np.arange(len(is_random))
    return np.where(properties[:, None] == np.nonzero(is_random)[0], step, 0.0)


def _sum(fit: Ridge, step: Sample, confidence: float) -> Interval:
    total = float(step @ fit.coefficients)
    error = math.sqrt(fit.variance) * float(np.linalg.norm(step @ fit.operator))
    half_width = normal_quantile(confidence) * error
    return Interval(total, total - half_width, total + half_width, fit.operator.shape[1])
