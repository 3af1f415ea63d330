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


MATERN_3_2, MATERN_5_2 = 2.1461932206205825, 2.9046299750299145
SPHERICAL, COSINE = 0.4522457419079461, 0.7171847972168741
"""Factors of the lag by which these correlations are 1/e at a lag of 1; solutions of their formulas."""


def matern_3_2(u: Array, v: Array) -> Array:
    """Matérn correlation of smoothness 3/2, (1 + t) exp(-t), t = a sqrt(u^2 + v^2): once differentiable."""
    t = MATERN_3_2 * np.hypot(u, v)
    return np.asarray((1.0 + t) * np.exp(-t))


def matern_5_2(u: Array, v: Array) -> Array:
    """Matérn correlation of smoothness 5/2, (1 + t + t^2 / 3) exp(-t), t = a sqrt(u^2 + v^2): twice differentiable."""
    t = MATERN_5_2 * np.hypot(u, v)
    return np.asarray((1.0 + t + t**2 / 3.0) * np.exp(-t))


def spherical(u: Array, v: Array) -> Array:
    """Spherical correlation 1 - 3 t / 2 + t^3 / 2, t = a sqrt(u^2 + v^2), and 0 from t = 1 on."""
    t = np.minimum(SPHERICAL * np.hypot(u, v), 1.0)
    return np.asarray(1.0 - 1.5 * t + 0.5 * t**3)


def cosine_exponential(u: Array, v: Array) -> Array:
    """Correlation exp(-t) cos(t), t = a sqrt(u^2 + v^2), of soil in beds: strong ground lies above weak.

    In the plane exp(-t) cos(b t) is positive definite up to b = 1 (Yaglom 1987), so that this is the strongest one.
    """
    t = COSINE * np.hypot(u, v)
    return np.asarray(np.exp(-t) * np.cos(t))


class Kernel(NamedTuple):
    """A correlation function of the lags u, v in autocorrelation distances."""

    formula: Callable[[Array, Array], Array]
    fluctuation_per_distance: float  # scale of fluctuation over autocorrelation distance, along one axis
    is_separable: bool  # whether it is a function of u times a function of v


KERNELS = {
    "exponential": Kernel(exponential, 2.0, is_separable=False),
    "separable-exponential": Kernel(separable_exponential, 2.0, is_separable=True),
    "squared-exponential": Kernel(squared_exponential, sqrt(pi), is_separable=True),
    "matern-3/2": Kernel(matern_3_2, 4.0 / MATERN_3_2, is_separable=False),
    "matern-5/2": Kernel(matern_5_2, 16.0 / 3.0 / MATERN_5_2, is_separable=False),
    "spherical": Kernel(spherical, 0.75 / SPHERICAL, is_separable=False),
    "cosine-exponential": Kernel(cosine_exponential, 1.0 / COSINE, is_separable=False),
}
"""The correlations that a scene can name; all are positive definite in the plane, along any axes."""


def autocorrelation_distance(scale_of_fluctuation: float, kind: str) -> float:
    """Convert a scale of fluctuation to an autocorrelation distance.

    The scale of fluctuation theta is the integral of the correlation over a whole line along one axis. With the
    autocorrelation distance L it is 2 L for both exponentials and sqrt(pi) L for the squared exponential. With t = a r,
    of the others it is 4 / a (Matérn 3/2), 16 / (3 a) (5/2), 3 / (4 a) (spherical) and 1 / a (cosine-exponential).

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
