"""Lognormal soil properties, and what their correlation asks of the Gaussian fields behind them."""

from dataclasses import dataclass
from math import erfc, exp, expm1, log, log1p, sqrt

import numpy as np

from campaign.fields.correlation import Array


@dataclass(frozen=True)
class Lognormal:
    """Lognormal distribution: X = exp(mu + sigma Z), sigma^2 = ln(1 + COV^2), mu = ln(mean) - sigma^2 / 2; eq. (5)."""

    mean: float
    cov: float

    @property
    def sigma(self) -> float:
        """Standard deviation of ln X."""
        return sqrt(log1p(self.cov**2))

    @property
    def log_mean(self) -> float:
        """Mean of ln X."""
        return log(self.mean) - self.sigma**2 / 2

    def mean_given(self, gaussian: Array, variance: Array) -> Array:
        """Return the mean where the Gaussian field has this mean and variance; that of the distribution for 0 and 1."""
        return np.asarray(self.mean * np.exp(self.sigma * gaussian - 0.5 * self.sigma**2 * (1.0 - variance)))

    @property
    def steepness(self) -> float:
        """Ratio sigma / COV, which is 1 without variation."""
        return self.sigma / self.cov if self.cov else 1.0

    def __call__(self, gaussian: Array) -> Array:
        """Turn standard Gaussian values into values of this distribution."""
        if not self.cov:
            return np.full_like(gaussian, self.mean)
        return np.asarray(np.exp(self.log_mean + self.sigma * gaussian))


def share_below(first: Lognormal, second: Lognormal, correlation: float = 0.0) -> float:
    """Return the probability that the first of two values is below the second, `correlation` that of their Gaussians.

    Phi((mu_2 - mu_1) / S), S^2 = sigma_1^2 + sigma_2^2 - 2 rho sigma_1 sigma_2.
    """
    gap, scatter = second.log_mean - first.log_mean, scatter_of_ratio(first, second, correlation)
    return 0.5 * erfc(-gap / (sqrt(2.0) * scatter)) if scatter else float(gap > 0.0)


def scatter_of_ratio(first: Lognormal, second: Lognormal, correlation: float = 0.0) -> float:
    """Return the standard deviation of the logarithm of the ratio of two values."""
    variance = first.sigma**2 + second.sigma**2 - 2.0 * correlation * first.sigma * second.sigma
    return sqrt(max(variance, 0.0))


def attainable_correlations(first: Lognormal, second: Lognormal) -> tuple[float, float]:
    """Return the least and the largest correlation of two lognormal fields, at which the Gaussian ones have -1 and 1.

    (exp(-sigma_1 sigma_2) - 1) / (COV_1 COV_2) and (exp(sigma_1 sigma_2) - 1) / (COV_1 COV_2), or the limits of these
    where a variation is 0.
    """
    product, scale = first.cov * second.cov, first.sigma * second.sigma
    if not product:
        return -first.steepness * second.steepness, first.steepness * second.steepness
    return (exp(-scale) - 1.0) / product, expm1(scale) / product


def gaussian_cross_correlation(rho: float, first: Lognormal, second: Lognormal) -> float:
    """Return the correlation of two Gaussian fields whose lognormal images have the correlation `rho`.

    rho_G = ln(1 + rho COV_1 COV_2) / (sigma_1 sigma_2); Fenton and Griffiths (2008), Risk Assessment in Geotechnical
    Engineering, section 6.4. It is within -1 and 1 if `rho` is within `attainable_correlations`.
    """
    if not first.cov * second.cov:
        return rho / (first.steepness * second.steepness)
    return log1p(rho * first.cov * second.cov) / (first.sigma * second.sigma)
