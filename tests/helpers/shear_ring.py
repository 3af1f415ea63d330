"""A ring of ground, held inside and turned outside, sheared along a circle: the ring shear test without its box.

Torque is the same through every circle, so the shear stress falls with ``1 / r^2``. Peak strength falls alike, but for
a ring around ``RADIUS`` that is 5 % weaker and slips. The band crosses the grid at all angles and has no ends.
"""

import math

import numpy as np
from driver import lattice
from shear_band import (
    DENSITY,
    DRIVE,
    PEAK,
    POISSON_RATIO,
    WEAK_SHARE,
    WEAK_WIDTH,
    YOUNG_MODULUS,
    damped_scheme,
    in_samples,
    smoothing_grid,
    soil_on_cells,
)

from solver._jit import kernel, sweep
from solver.deformation import deform
from solver.elastic import shear_modulus
from solver.operations import INTERNAL_WORK, solve_momentum
from solver.particles import allocate_particles
from solver.sorting import fill_tiles, read_tiles, sort_if_due
from solver.spread import spread_all
from solver.step import accelerate, allocate_workspace
from solver.tiles import SORTS, after_sorts

RADIUS, HELD, DRIVEN, RIM, SIZE = 6.0, 4.0, 8.0, 2.0, 22.0  # m: of the band, the rigid parts, the rims, the grid
SLIP, SAMPLES = 0.8, 40  # m at RADIUS, where the drive is DRIVE, looks on the way


@sweep
def prescribe(vectors, is_prescribed, values):
    """Give some nodes their values; a loop, since Numba compiles assignments of slices for seconds."""
    for j in range(vectors.shape[0]):
        for i in range(vectors.shape[2]):
            if is_prescribed[j, i]:
                vectors[j, 0, i] = values[j, 0, i]
                vectors[j, 1, i] = values[j, 1, i]


def turn(particles, grid, work, laws, scheme, is_prescribed, velocity, dt, steps):
    """Move some nodes at ``velocity`` (rows, 2, columns), in m/s; return the work of the stresses in J/m."""
    work.ledger[INTERNAL_WORK] = 0.0
    tiles = fill_tiles(particles, grid, work.tiles)
    _turn(tiles, grid, work, laws, scheme, is_prescribed, velocity, dt, steps)
    read_tiles(after_sorts(tiles), particles)
    return work.ledger[INTERNAL_WORK]


@kernel
def _turn(tiles, grid, work, laws, scheme, is_prescribed, velocity, dt, steps):
    at_rest = np.zeros_like(velocity)
    tiles.counts[SORTS] = 0
    spread_all(tiles, grid, scheme)
    for _ in range(steps):
        tiles = sort_if_due(tiles, grid)
        solve_momentum(grid, 0.0, scheme.damping, dt)
        prescribe(grid.acceleration, is_prescribed, at_rest)
        prescribe(grid.velocity, is_prescribed, velocity)
        accelerate(tiles, grid, work, scheme, 0.0, dt)
        prescribe(grid.remapped, is_prescribed, velocity)
        deform(tiles, grid, work.ledger, laws, scheme, 0.0, dt)


def compliance():
    """Return the elastic part of the displacement at ``RADIUS`` over the stress there, in m/Pa."""
    return RADIUS**3 * (HELD**-2 - DRIVEN**-2) / (2.0 * shear_modulus(YOUNG_MODULUS, POISSON_RATIO))


def ring(cell):
    """Return the particles of the ring, turning as in even elastic shear."""
    spacing = 0.5 * cell
    x, y = lattice(SIZE, SIZE, spacing)
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
    """Return which nodes are held or driven (rows, columns), and their velocities (rows, 2, columns)."""
    row, column = np.indices(grid.mass.shape)
    x = grid.origin + column * grid.cell_size - 0.5 * SIZE
    y = grid.origin + row * grid.cell_size - 0.5 * SIZE
    radius = np.hypot(x, y)
    is_driven = radius > DRIVEN
    velocity = DRIVE / RADIUS * np.stack([-y, x], axis=1) * is_driven[:, None, :]
    return (radius < HELD) | is_driven, velocity


def shear_force(cell, rate, internal_length):
    """Return displacement in m and mean shear stress in Pa at ``RADIUS``, from the work of the stresses (SAMPLES,)."""
    soil, scheme = soil_on_cells(cell, rate, internal_length), damped_scheme(internal_length)
    grid = smoothing_grid(SIZE, SIZE, cell, internal_length)
    particles = ring(cell)
    work = allocate_workspace(particles.x.size)
    nodes = walls(grid)
    displacement, works = in_samples(
        lambda dt, steps: turn(particles, grid, work, (soil,), scheme, *nodes, dt, steps), soil, cell, SLIP, SAMPLES
    )
    return displacement, works / (SLIP / SAMPLES * 2.0 * math.pi * RADIUS)
