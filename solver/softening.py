"""Strength that degrades with plastic strain.

The exponential and the sine are polynomials because a call into the C library would keep LLVM from vectorising the
constitutive update; ``tests/solver/test_softening.py`` holds them to 1e-11 against the library.
"""

import math

from solver._jit import law

_LARGEST_EXPONENT = 32.0  # exp(-32) = 1e-14: fully residual
_SQUARINGS = 8


@law
def exp_decay(x):
    """Return ``exp(-x)`` for ``x >= 0``: Taylor series of ``exp(-x / 256)``, squared eight times."""
    y = -min(x, _LARGEST_EXPONENT) / 2**_SQUARINGS
    e = 1 + y * (1 + y / 2 * (1 + y / 3 * (1 + y / 4 * (1 + y / 5 * (1 + y / 6 * (1 + y / 7 * (1 + y / 8)))))))
    for _ in range(_SQUARINGS):
        e *= e
    return e


@law
def sine(x):
    """Return ``sin(x)`` for ``0 <= x <= pi / 2`` by its Taylor series."""
    z = x * x
    return x * (1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110 * (1 - z / 156 * (1 - z / 210)))))))


@law
def remaining_share(plastic_strain, rate, is_linear):
    """Return the share of the drop from peak to residual that is left: ``exp(-rate eps)`` or ``1 - rate eps >= 0``."""
    x = rate * plastic_strain
    exponential = exp_decay(x)
    linear = max(0.0, 1.0 - x)
    return linear if is_linear else exponential


@law
def softened_strength(plastic_strain, cohesion, friction_angle, soil):
    """Return ``(c cos(phi), sin(phi))`` after softening of both from peak towards residual.

    Parameters
    ----------
    plastic_strain : float
        Accumulated equivalent deviatoric plastic strain.
    cohesion, friction_angle : float
        Peak values in Pa and rad.
    soil : Soil
        See ``mohr_coulomb``.
    """
    share = remaining_share(plastic_strain, soil.softening_rate, soil.softening_is_linear)
    c = soil.cohesion_residual + (cohesion - soil.cohesion_residual) * share
    phi = soil.friction_residual + (friction_angle - soil.friction_residual) * share
    sin_phi = sine(phi)
    return c * math.sqrt(1.0 - sin_phi * sin_phi), sin_phi
