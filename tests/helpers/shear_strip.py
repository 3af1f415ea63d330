"""A strip of ground, periodic along its length, sheared between a fixed base and a driven top.

A row of nodes moves as one, and a particle that leaves at a side comes back at the other, so the strip is
one-dimensional: the shear stress is the same at all heights and falls with the strength of the weakest.
"""

import numpy as np
from driver import lattice, wrap_around
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
from solver.grid import PADDING, SMALLEST_MASS
from solver.operations import INTERNAL_WORK, solve_momentum
from solver.particles import allocate_particles
from solver.sorting import fill_tiles, read_tiles, sort_if_due
from solver.spread import spread_all
from solver.step import accelerate, allocate_workspace
from solver.tiles import SORTS, after_sorts

HEIGHT, RIM, COARSE_CELL, WIDTH_IN_CELLS = 10.0, 1.0, 0.5, 2  # m, m, m: rigid blocks at both ends are the walls
RESIDUAL = 10e3  # Pa
SLIP, SAMPLES = 1.0, 66  # m, of the top at the end; looks on the way


# Loops instead of expressions of arrays, which take Numba a minute to compile here.


@sweep
def share_in_rows(sums, mass):
    """Give the nodes of a row their share by mass of its horizontal sum, and nothing vertical."""
    for j in range(mass.shape[0]):
        row_sum = row_mass = 0.0
        for i in range(mass.shape[1]):
            row_sum += sums[j, 0, i]
            row_mass += mass[j, i]
        per_mass = row_sum / row_mass if row_mass > SMALLEST_MASS else 0.0
        for i in range(mass.shape[1]):
            sums[j, 0, i] = per_mass * mass[j, i]
            sums[j, 1, i] = 0.0


@sweep
def move_as_rows(velocity, mass):
    """Give the nodes of a row with mass the horizontal velocity of the row, and no vertical one."""
    for j in range(mass.shape[0]):
        for i in range(mass.shape[1]):
            velocity[j, 0, i] *= mass[j, i]
    share_in_rows(velocity, mass)
    for j in range(mass.shape[0]):
        for i in range(mass.shape[1]):
            velocity[j, 0, i] /= max(mass[j, i], SMALLEST_MASS)


@sweep
def hold(vectors, base, top, value):
    """Hold the rows up to ``base`` at rest and those from ``top`` at ``value``."""
    for j in range(vectors.shape[0]):
        if j <= base or j >= top:
            for i in range(vectors.shape[2]):
                vectors[j, 0, i] = value if j >= top else 0.0
                vectors[j, 1, i] = 0.0


def shear(particles, grid, work, laws, scheme, base, top, drive, dt, steps):
    """Drive the nodes from row ``top`` up at ``drive`` m/s, hold those up to row ``base``; return the work in J/m."""
    work.ledger[INTERNAL_WORK] = 0.0
    tiles = fill_tiles(particles, grid, work.tiles)
    _shear(tiles, grid, work, laws, scheme, base, top, drive, dt, steps)
    read_tiles(after_sorts(tiles), particles)
    return work.ledger[INTERNAL_WORK]


@kernel
def _shear(tiles, grid, work, laws, scheme, base, top, drive, dt, steps):
    width = grid.width
    tiles.counts[SORTS] = 0
    spread_all(tiles, grid, scheme)
    for _ in range(steps):
        tiles = sort_if_due(tiles, grid)
        share_in_rows(grid.momentum, grid.mass)
        share_in_rows(grid.force, grid.mass)
        solve_momentum(grid, 0.0, scheme.damping, dt)
        hold(grid.acceleration, base, top, 0.0)
        hold(grid.velocity, base, top, drive)
        accelerate(tiles, grid, work, scheme, 0.0, dt)
        move_as_rows(grid.remapped, grid.mass)
        hold(grid.remapped, base, top, drive)
        wrap_around(tiles, width)
        deform(tiles, grid, work.ledger, laws, scheme, 0.0, dt)


def compliance():
    """Return the elastic part of the displacement over the stress, in m/Pa."""
    return HEIGHT / shear_modulus(YOUNG_MODULUS, POISSON_RATIO)


def strip(cell):
    """Return the particles of a strip with a weak layer in the middle, already in even shear."""
    width = WIDTH_IN_CELLS * cell
    spacing = 0.5 * cell
    x, y = lattice(width, HEIGHT + 2.0 * RIM, spacing)
    particles = allocate_particles(x, y, spacing**2, DENSITY)
    is_weak = abs(particles.y - RIM - 0.5 * HEIGHT) < 0.5 * WEAK_WIDTH
    particles.cohesion_residual[:] = RESIDUAL
    particles.cohesion[:] = np.where(is_weak, WEAK_SHARE, 1.0) * PEAK
    particles.velocity_x[:] = DRIVE / HEIGHT * np.clip(particles.y - RIM, 0.0, HEIGHT)
    return particles


def shear_force(cell, rate, internal_length):
    """Return displacement of the top in m and mean shear stress in Pa, from the work of the stresses (SAMPLES,)."""
    soil, scheme = soil_on_cells(cell, rate, internal_length), damped_scheme(internal_length)
    grid = smoothing_grid(WIDTH_IN_CELLS * cell, HEIGHT + 2.0 * RIM, cell, internal_length)
    particles = strip(cell)
    work = allocate_workspace(particles.x.size)
    base = round(RIM / cell) + PADDING
    top = base + round(HEIGHT / cell)
    displacement, works = in_samples(
        lambda dt, steps: shear(particles, grid, work, (soil,), scheme, base, top, DRIVE, dt, steps),
        soil,
        cell,
        SLIP,
        SAMPLES,
    )
    return displacement, works / (SLIP / SAMPLES * grid.width)
