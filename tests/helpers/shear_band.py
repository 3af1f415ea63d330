"""What the sheared strip and the sheared ring share: soil, drive, and the closed form of their softening.

Both are elastic but for a band that is 5 % weaker and slips. With the elastic part in series, of compliance ``k``, the
stress ``tau`` at displacement ``U`` solves

    tau = c_r + (0.95 c - c_r) exp(-eta u / (sqrt(3) l)),   u = U - k tau

in the quasi-static limit; tensor shear ``gamma / 2`` of pure plastic shear is ``eps_p = gamma / sqrt(3)``.
"""

import math

import numpy as np
from driver import UGIMP, grid_without_walls

from solver.elastic import p_wave_speed
from solver.internal_length import rate_on_cells, smoothing_weights
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.method import Method
from solver.scheme import scheme_of
from solver.softening import Softening

PEAK, WEAK_SHARE, WEAK_WIDTH = 20e3, 0.95, 1.0  # Pa, 1, m
YOUNG_MODULUS, POISSON_RATIO, DENSITY = 2e6, 0.35, 2000.0
DRIVE = 0.05  # m/s
COURANT, DAMPING = 0.6, 0.7
METHOD = Method(locking="cell-average")


def soil_on_cells(cell, rate, internal_length):
    """Return the soil, with the rate that its softening has on cells of ``cell`` m."""
    softening = Softening(rate_on_cells(rate, cell, UGIMP, internal_length), is_linear=False)
    return mohr_coulomb(Constants(YOUNG_MODULUS, POISSON_RATIO, 0.0, softening))


def damped_scheme(internal_length):
    """Return the damped scheme; plastic strain is averaged if there is an internal length (m)."""
    return scheme_of(METHOD, DAMPING, averages_plastic_strain=internal_length > 0.0)


def smoothing_grid(width, height, cell, internal_length):
    """Return a grid without walls that averages plastic strain over the internal length."""
    return grid_without_walls(width, height, cell, smoothing=smoothing_weights(internal_length, cell, UGIMP))


def in_samples(shear, soil, cell, slip, samples):
    """Shear to ``slip`` m by calls of ``shear(dt, steps)``; return displacement (m) and work of each (samples,)."""
    wave_speed = p_wave_speed(soil.bulk_modulus, soil.shear_modulus, DENSITY)
    steps = math.ceil(slip / DRIVE / (COURANT * cell / wave_speed) / samples)
    dt = slip / DRIVE / samples / steps
    works = [shear(dt, steps) for _ in range(samples)]
    return slip * (np.arange(samples) + 0.5) / samples, np.array(works)


def closed_form(displacement, compliance, rate, thickness, residual):
    """Return the stress at each displacement, with a band of ``thickness`` m, by bisection on the slip."""
    low, high = np.zeros_like(displacement), displacement.copy()
    for _ in range(60):
        slip = 0.5 * (low + high)
        softened = np.exp(-rate * slip / (np.sqrt(3.0) * thickness))
        stress = residual + (WEAK_SHARE * PEAK - residual) * softened
        is_too_little = displacement - slip > compliance * stress
        low, high = np.where(is_too_little, slip, low), np.where(is_too_little, high, slip)
    return stress
