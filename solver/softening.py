"""Strength that degrades with plastic strain.

Exponential, sine and cosine are polynomials because the C library has no function of lanes;
``tests/solver/test_softening.py`` holds them to 1e-11 against the library.
"""

from typing import NamedTuple

import numpy as np

from solver._jit import inlined, kernel

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


@inlined
def exp_decay(x):
    """Return ``exp(-x)`` for ``x >= 0``: Taylor series of ``exp(-x / 256)``, squared eight times."""
    y = min(x, _LARGEST_EXPONENT) * (-1 / 2**_SQUARINGS)
    tail = 1 / 120 + y * (1 / 720 + y * (1 / 5040 + y * (1 / 40320)))
    e = 1 + y * (1 + y * (1 / 2 + y * (1 / 6 + y * (1 / 24 + y * tail))))
    for _ in range(_SQUARINGS):
        e *= e
    return e


@inlined
def sine(x):
    """Return ``sin(x)`` for ``0 <= x <= pi / 2`` by its Taylor series."""
    z = x * x
    tail = 1 / 362880 + z * (-1 / 39916800 + z * (1 / 6227020800 - z * (1 / 1307674368000)))
    return x * (1 + z * (-1 / 6 + z * (1 / 120 + z * (-1 / 5040 + z * tail))))


@inlined
def cosine(x):
    """Return ``cos(x)`` for ``0 <= x <= pi / 2`` by its Taylor series."""
    z = x * x
    tail = 1 / 479001600 + z * (-1 / 87178291200 + z * (1 / 20922789888000))
    return 1 + z * (-1 / 2 + z * (1 / 24 + z * (-1 / 720 + z * (1 / 40320 + z * (-1 / 3628800 + z * tail)))))


@inlined
def remaining_share(plastic_strain, softening):
    """Return the share of the drop from peak to residual that is left: ``exp(-rate eps)`` or ``1 - rate eps >= 0``."""
    x = softening.rate * plastic_strain
    exponential = exp_decay(x)
    linear = max(0.0, 1.0 - x)
    return linear if softening.is_linear else exponential


def remaining_shares(plastic_strain, softening):
    """Return the share that is left at each plastic strain, (n,)."""
    shares = np.empty_like(plastic_strain)
    _fill_shares(shares, plastic_strain, softening)
    return shares


@kernel
def _fill_shares(shares, plastic_strain, softening):
    for p in range(plastic_strain.size):
        shares[p] = remaining_share(plastic_strain[p], softening)


@inlined
def softened(peak, residual, share):
    """Return what is left of a strength when ``share`` of its drop from peak to residual is left."""
    return residual + (peak - residual) * share


@inlined
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
