"""A ring of ground, held inside and turned outside, sheared along a circle: the ring shear test without its box.

Torque is the same through every circle, so the shear stress falls with ``1 / r^2``. Peak strength falls alike, but for
a ring around ``RADIUS`` that is 5 % weaker and slips. The band crosses the grid at all angles and has no ends.
"""

import math

import numpy as np

from solver._jit import kernel
from solver.elastic import p_wave_speed, shear_modulus
from solver.grid import allocate_grid
from solver.model import make_soil
from solver.nonlocal_softening import coarse_rate_factor, smoothing_weights
from solver.operations import INTERNAL_WORK, solve_momentum
from solver.particles import allocate_particles
from solver.step import LOCKING, STRESS_UPDATES, Scheme, accelerate, allocate_workspace, begin, deform

RADIUS, HELD, DRIVEN, RIM, SIZE = 6.0, 4.0, 8.0, 2.0, 22.0  # m: of the band, the rigid parts, the rims, the grid
PEAK, WEAK_SHARE, WEAK_WIDTH = 20e3, 0.95, 1.0  # Pa at RADIUS, 1, m; softening goes to nothing
YOUNG_MODULUS, POISSON_RATIO, DENSITY = 2e6, 0.35, 2000.0
DRIVE, SLIP, SAMPLES = 0.05, 0.8, 40  # m/s and m at RADIUS, looks on the way
COURANT, HALF_LENGTH = 0.6, 0.25
MUSL = Scheme(STRESS_UPDATES["musl"], 1.0, 0.7, LOCKING["cell-average"])


@kernel
def turn(particles, grid, work, soil, is_held, is_driven, velocity, dt, steps):
    """Hold some nodes and drive others at ``velocity`` (n, 2); return the work of the stresses in J/m."""
    work.ledger[INTERNAL_WORK] = 0.0
    begin(particles, grid, work, MUSL)
    for _ in range(steps):
        solve_momentum(grid, 0.0, MUSL.damping, dt)
        for i in range(grid.mass.size):
            if is_held[i] or is_driven[i]:
                grid.acceleration[i] = 0.0
                grid.velocity[i] = velocity[i]
        accelerate(particles, grid, work, MUSL, 0.0, dt)
        for i in range(grid.mass.size):
            if is_held[i] or is_driven[i]:
                grid.remapped[i] = velocity[i]
        deform(particles, grid, work, soil, MUSL, 0.0, dt)
    return work.ledger[INTERNAL_WORK]


def compliance():
    """Return the elastic part of the displacement at ``RADIUS`` over the stress there, in m/Pa."""
    return RADIUS**3 * (HELD**-2 - DRIVEN**-2) / (2.0 * shear_modulus(YOUNG_MODULUS, POISSON_RATIO))


def ring(cell):
    """Return the particles of the ring, turning as in even elastic shear."""
    spacing = 0.5 * cell
    x, y = np.meshgrid(*[np.arange(0.5 * spacing, SIZE, spacing)] * 2)
    radius = np.hypot(x - 0.5 * SIZE, y - 0.5 * SIZE)
    is_ring = (radius > HELD - RIM) & (radius < DRIVEN + RIM)
    particles, radius = allocate_particles(x[is_ring], y[is_ring], spacing**2, DENSITY), radius[is_ring]
    is_weak = abs(radius - RADIUS) < 0.5 * WEAK_WIDTH
    particles.cohesion[:] = np.where(is_weak, WEAK_SHARE, 1.0) * PEAK * (RADIUS / radius) ** 2
    turned = (HELD**-2 - np.clip(radius, HELD, DRIVEN) ** -2) / (HELD**-2 - DRIVEN**-2)
    particles.velocity_x[:] = -DRIVE / RADIUS * turned * (particles.y - 0.5 * SIZE)
    particles.velocity_y[:] = DRIVE / RADIUS * turned * (particles.x - 0.5 * SIZE)
    return particles


def walls(grid):
    """Return which nodes are held, which are driven, and their velocities (n, 2)."""
    row, column = np.divmod(np.arange(grid.mass.size), grid.columns)
    x = grid.origin + column * grid.cell_size - 0.5 * SIZE
    y = grid.origin + row * grid.cell_size - 0.5 * SIZE
    radius = np.hypot(x, y)
    is_driven = radius > DRIVEN
    velocity = DRIVE / RADIUS * np.stack([-y, x], axis=1) * is_driven[:, None]
    return radius < HELD, is_driven, velocity


def shear_force(cell, rate, internal_length):
    """Return displacement in m and mean shear stress in Pa at ``RADIUS``, from the work of the stresses (SAMPLES,)."""
    rate_on_cells = rate * coarse_rate_factor(internal_length, cell, HALF_LENGTH)
    soil = make_soil(YOUNG_MODULUS, POISSON_RATIO, 0.0, 0.0, 0.0, rate_on_cells, False, internal_length)
    grid = allocate_grid(SIZE, SIZE, cell, HALF_LENGTH, smoothing_weights(internal_length, cell, HALF_LENGTH))
    grid.free_x[:] = grid.free_y[:] = 1.0
    particles = ring(cell)
    work = allocate_workspace(particles.x.size)
    wave_speed = p_wave_speed(soil.bulk_modulus, soil.shear_modulus, DENSITY)
    steps = math.ceil(SLIP / DRIVE / (COURANT * cell / wave_speed) / SAMPLES)
    dt = SLIP / DRIVE / SAMPLES / steps
    works = [turn(particles, grid, work, soil, *walls(grid), dt, steps) for _ in range(SAMPLES)]
    displacement = SLIP * (np.arange(SAMPLES) + 0.5) / SAMPLES
    return displacement, np.array(works) / (SLIP / SAMPLES * 2.0 * math.pi * RADIUS)
