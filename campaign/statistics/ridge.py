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
        Of what the fit leaves, in the squared unit of the outcome.
    freedom : float
        Degrees of freedom of `variance`.
    explained : float
        Share of the variance of the outcome that the fit foretells of values left out; negative where the mean of the
        others foretells more.
    """

    coefficients: Sample
    operator: Matrix
    variance: float
    freedom: float
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
    shares = [_explained(u, s**2 / (s**2 + penalty), target) for penalty in penalties]
    best = len(shares) - 1 - int(np.argmax(shares[::-1]))  # of equal ones the largest
    gain = s / (s**2 + penalties[best])
    kept, operator = s * gain, (vt.T * gain) @ u.T
    left = target - u @ (kept * (u.T @ target))
    freedom = len(outcome) - 1 - float(np.sum(2 * kept - kept**2))
    return Ridge(operator @ target, operator, float(left @ left) / freedom, freedom, shares[best])


def explained_by(predictors: Matrix, outcome: Sample) -> float:
    """Return the share of the variance that linear regression without a penalty foretells of values left out."""
    u = np.linalg.svd(predictors - predictors.mean(axis=0), full_matrices=False)[0]
    return _explained(u, np.ones(u.shape[1]), outcome - outcome.mean())


def _explained(u: Matrix, kept: Sample, target: Sample) -> float:
    """Return 1 - sum of squares missed over that about the mean of the others; `target` has mean zero."""
    n = len(target)
    leverage = u**2 @ kept + 1 / n
    missed = (target - u @ (kept * (u.T @ target))) / (1 - leverage)
    return float(1 - np.sum(missed**2) / np.sum((target * n / (n - 1)) ** 2))
