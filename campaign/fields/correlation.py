"""Autocorrelation of a soil property: which formula, how far, and in which direction."""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, hypot, pi, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Kernel = Callable[[Array, Array], Array]


def exponential(u: Array, v: Array) -> Array:
    """Markov correlation exp(-sqrt(u^2 + v^2)) of the lags u, v in autocorrelation distances; eq. (1) of Ma et al."""
    return np.asarray(np.exp(-np.hypot(u, v)))


def separable_exponential(u: Array, v: Array) -> Array:
    """Product of two Markov correlations, exp(-|u| - |v|), of the lags u, v in autocorrelation distances."""
    return np.asarray(np.exp(-np.abs(u) - np.abs(v)))


def squared_exponential(u: Array, v: Array) -> Array:
    """Gaussian correlation exp(-u^2 - v^2) of the lags u, v in autocorrelation distances."""
    return np.asarray(np.exp(-np.square(u) - np.square(v)))


KERNELS: dict[str, Kernel] = {
    "exponential": exponential,
    "separable-exponential": separable_exponential,
    "squared-exponential": squared_exponential,
}

FLUCTUATION_PER_DISTANCE = {
    "exponential": 2.0,
    "separable-exponential": 2.0,
    "squared-exponential": sqrt(pi),
}


def autocorrelation_distance(scale_of_fluctuation: float, kind: str) -> float:
    """Convert a scale of fluctuation to an autocorrelation distance.

    The scale of fluctuation is the integral of the correlation over a whole line along one axis:

    - exponential and separable-exponential: theta = 2 L, per axis,
    - squared-exponential: theta = sqrt(pi) L.

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
    return scale_of_fluctuation / FLUCTUATION_PER_DISTANCE[kind]


@dataclass(frozen=True)
class Correlation:
    """Stationary anisotropic correlation in the plane of the section.

    With the lags turned into the axes of the soil fabric, u = (dx cos a + dy sin a) / L1 and
    v = (dy cos a - dx sin a) / L2, the correlation is one of

    - exponential: exp(-sqrt(u^2 + v^2)),
    - separable-exponential: exp(-|u| - |v|),
    - squared-exponential: exp(-u^2 - v^2).

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
        return KERNELS[self.kind](u, v)

    @property
    def is_separable(self) -> bool:
        """Whether the correlation is a function of dx times a function of dy."""
        return self.kind != "exponential" and self.angle % pi == 0.0

    @property
    def reach(self) -> tuple[float, float]:
        """Half extents [m] along x and y of the ellipse of the two autocorrelation distances."""
        c, s = cos(self.angle), sin(self.angle)
        return hypot(self.horizontal * c, self.vertical * s), hypot(self.horizontal * s, self.vertical * c)
