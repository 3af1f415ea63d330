"""Autocorrelation of a soil property: which formula, how far, and in which direction.

A new correlation is its formula and a row in `KERNELS`. Scenes are checked by this table, so it needs NumPy alone.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def exponential(u: Array, v: Array) -> Array:
    """Markov correlation exp(-sqrt(u^2 + v^2)) of the lags u, v in autocorrelation distances; eq. (1) of Ma et al."""
    return np.asarray(np.exp(-np.hypot(u, v)))


def separable_exponential(u: Array, v: Array) -> Array:
    """Product of two Markov correlations, exp(-|u| - |v|), of the lags u, v in autocorrelation distances."""
    return np.asarray(np.exp(-np.abs(u) - np.abs(v)))


def squared_exponential(u: Array, v: Array) -> Array:
    """Gaussian correlation exp(-u^2 - v^2) of the lags u, v in autocorrelation distances."""
    return np.asarray(np.exp(-np.square(u) - np.square(v)))


class Kernel(NamedTuple):
    """A correlation function of the lags u, v in autocorrelation distances."""

    formula: Callable[[Array, Array], Array]
    fluctuation_per_distance: float  # scale of fluctuation over autocorrelation distance, along one axis
    is_separable: bool  # whether it is a function of u times a function of v


KERNELS = {
    "exponential": Kernel(exponential, 2.0, is_separable=False),
    "separable-exponential": Kernel(separable_exponential, 2.0, is_separable=True),
    "squared-exponential": Kernel(squared_exponential, sqrt(pi), is_separable=True),
}
"""The correlations that a scene can name."""


def autocorrelation_distance(scale_of_fluctuation: float, kind: str) -> float:
    """Convert a scale of fluctuation to an autocorrelation distance.

    The scale of fluctuation theta is the integral of the correlation over a whole line along one axis. With the
    autocorrelation distance L it is 2 L for both exponentials and sqrt(pi) L for the squared exponential.

    Parameters
    ----------
    scale_of_fluctuation : float
        Scale of fluctuation theta [m].
    kind : str
        Name of the correlation, a key of `KERNELS`.

    Returns
    -------
    float
        Autocorrelation distance L [m], at which the correlation along the axis is 1/e.

    Notes
    -----
    Vanmarcke (1983), Random Fields: Analysis and Synthesis, section 5.1.
    """
    return scale_of_fluctuation / KERNELS[kind].fluctuation_per_distance


@dataclass(frozen=True)
class Correlation:
    """Stationary anisotropic correlation in the plane of the section.

    With the lags turned into the axes of the soil fabric, u = (dx cos a + dy sin a) / L1 and
    v = (dy cos a - dx sin a) / L2, the correlation is a formula of `KERNELS` in u and v.

    Parameters
    ----------
    kind : str
        Name of the formula, a key of `KERNELS`.
    horizontal, vertical : float
        Autocorrelation distances L1 and L2 [m] along the fabric, and across it.
    angle : float
        Inclination a of the fabric [rad], counter-clockwise from the x axis.
    """

    kind: str
    horizontal: float
    vertical: float
    angle: float = 0.0

    def __call__(self, dx: ArrayLike, dy: ArrayLike) -> Array:
        """Evaluate the correlation at the lags `dx`, `dy` [m], which are broadcast against each other."""
        x, y = np.asarray(dx, dtype=float), np.asarray(dy, dtype=float)
        u = (x * cos(self.angle) + y * sin(self.angle)) / self.horizontal
        v = (y * cos(self.angle) - x * sin(self.angle)) / self.vertical
        return KERNELS[self.kind].formula(u, v)

    @property
    def is_separable(self) -> bool:
        """Whether the correlation is a function of dx times a function of dy."""
        return KERNELS[self.kind].is_separable and self.angle % pi == 0.0

    @property
    def reach(self) -> tuple[float, float]:
        """Half extents [m] along x and y of the ellipse of the two autocorrelation distances."""
        c, s = cos(self.angle), sin(self.angle)
        return hypot(self.horizontal * c, self.vertical * s), hypot(self.horizontal * s, self.vertical * c)
