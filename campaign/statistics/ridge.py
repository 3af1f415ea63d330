"""Linear regression on more predictors than a sample supports: ridge, judged by leaving out one value at a time.

With the singular values s of the centred predictors and a penalty p, the direction of each is kept by the share
s^2 / (s^2 + p). Fit without value i misses it by e_i / (1 - h_i), where e is the residual of the whole fit and h the
leverage, so that n fits cost no more than one (Golub, Heath and Wahba 1979, Technometrics 21, 215-223).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.statistics.intervals import Sample

Matrix = NDArray[np.float64]

PENALTIES = np.geomspace(1e-4, 1e4, 65)
"""Tried, from hardly any to all but no coefficient, in units of the mean squared singular value."""


class Ridge(NamedTuple):
    """A fit to n outcomes by m predictors.

    Attributes
    ----------
    coefficients : array (m,)
        Outcome per unit of each predictor.
    operator : array (m, n)
        Makes the coefficients of the outcomes.
    variance : float
        Mean square by which the fit misses values left out, in the squared unit of the outcome. It is more than the
        variance of the noise, and unlike that of the residuals it does not vanish where the fit meets every value.
    explained : float
        Share of the variance of the outcome that the fit foretells of values left out; negative where the mean of the
        others foretells more.
    """

    coefficients: Sample
    operator: Matrix
    variance: float
    explained: float


def ridge(predictors: Matrix, outcome: Sample) -> Ridge:
    """Fit with the penalty that foretells values left out best.

    Parameters
    ----------
    predictors : array (n, m)
    outcome : array (n,)
    """
    u, s, vt = np.linalg.svd(predictors - predictors.mean(axis=0), full_matrices=False)
    target = outcome - outcome.mean()
    penalties = PENALTIES * np.mean(s**2)
    missed = _missed(u, s[:, None] ** 2 / (s[:, None] ** 2 + penalties), target)
    best = len(missed) - 1 - int(np.argmin(missed[::-1]))  # of equal ones the largest
    operator = (vt.T * (s / (s**2 + penalties[best]))) @ u.T
    return Ridge(operator @ target, operator, float(missed[best]), _explained(missed[best], target))


def explained_by(predictors: Matrix, outcome: Sample) -> float:
    """Return the share of the variance that linear regression without a penalty foretells of values left out."""
    u = np.linalg.svd(predictors - predictors.mean(axis=0), full_matrices=False)[0]
    target = outcome - outcome.mean()
    return _explained(_missed(u, np.ones((u.shape[1], 1)), target)[0], target)


def _missed(u: Matrix, kept: Matrix, target: Sample) -> Sample:
    """Return the mean squares by which values left out are missed; `target` has mean zero.

    Each column of `kept` holds the shares that a penalty keeps of the directions, columns of `u`.
    """
    leverage = u**2 @ kept + 1 / len(target)
    residuals = target[:, None] - u @ (kept * (u.T @ target)[:, None])
    return np.asarray(np.mean((residuals / (1 - leverage)) ** 2, axis=0))


def _explained(missed: float, target: Sample) -> float:
    """Compare with what the mean of the others misses."""
    n = len(target)
    return float(1 - missed / np.mean((target * n / (n - 1)) ** 2))
