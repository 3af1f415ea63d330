"""Strength that degrades with plastic strain.

Exponential, sine and cosine are polynomials because the C library has no function of lanes;
``tests/solver/test_softening.py`` holds them to 1e-11 against the library.
"""

from typing import NamedTuple

import numpy as np

from solver._jit import kernel, point

_LARGEST_EXPONENT = 32.0  # exp(-32) = 1e-14: fully residual
_SQUARINGS = 8


class Softening(NamedTuple):
    """How strength falls from peak to residual."""

    rate: float  # per unit plastic strain
    is_linear: bool  # or else exponential


NO_SOFTENING = Softening(0.0, False)


class Strength(NamedTuple):
    """Strength of one point."""

    cohesion: float  # Pa, peak
    friction_angle: float  # rad, peak
    cohesion_residual: float  # Pa
    friction_angle_residual: float  # rad


@point
def exp_decay(x):
    """Return ``exp(-x)`` for ``x >= 0``: Taylor series of ``exp(-x / 256)``, squared eight times."""
    y = -min(x, _LARGEST_EXPONENT) / 2**_SQUARINGS
    e = 1 + y * (1 + y / 2 * (1 + y / 3 * (1 + y / 4 * (1 + y / 5 * (1 + y / 6 * (1 + y / 7 * (1 + y / 8)))))))
    for _ in range(_SQUARINGS):
        e *= e
    return e


@point
def sine(x):
    """Return ``sin(x)`` for ``0 <= x <= pi / 2`` by its Taylor series."""
    z = x * x
    return x * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156 * (1 - z / 210)))))))


@point
def cosine(x):
    """Return ``cos(x)`` for ``0 <= x <= pi / 2`` by its Taylor series."""
    z = x * x
    tail = 1 - z / 132 * (1 - z / 182 * (1 - z / 240))
    return 1 - z / 2 * (1 - z / 12 * (1 - z / 30 * (1 - z / 56 * (1 - z / 90 * tail))))


@point
def remaining_share(plastic_strain, softening):
    """Return the share of the drop from peak to residual that is left: ``exp(-rate eps)`` or ``1 - rate eps >= 0``."""
    x = softening.rate * plastic_strain
    exponential = exp_decay(x)
    linear = max(0.0, 1.0 - x)
    return linear if softening.is_linear else exponential


@kernel
def remaining_shares(plastic_strain, softening):
    """Return the share that is left at each plastic strain, (n,)."""
    shares = np.empty_like(plastic_strain)
    for p in range(plastic_strain.size):
        shares[p] = remaining_share(plastic_strain[p], softening)
    return shares


@point
def softened(peak, residual, share):
    """Return what is left of a strength when ``share`` of its drop from peak to residual is left."""
    return residual + (peak - residual) * share


@point
def softened_strength(plastic_strain, strength, softening):
    """Return ``(c cos(phi), sin(phi))`` after softening of both from peak towards residual.

    Parameters
    ----------
    plastic_strain : float
        Accumulated equivalent deviatoric plastic strain.
    strength : Strength
    softening : Softening
    """
    share = remaining_share(plastic_strain, softening)
    c = softened(strength.cohesion, strength.cohesion_residual, share)
    phi = softened(strength.friction_angle, strength.friction_angle_residual, share)
    return c * cosine(phi), sine(phi)
