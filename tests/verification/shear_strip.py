"""A strip of ground, periodic along its length, sheared between a fixed base and a driven top.

A row of nodes moves as one, and a particle that leaves at a side comes back at the other, so the strip is
one-dimensional: the shear stress is the same at all heights and falls with the strength of the weakest.
"""

import math

import numpy as np

from solver._jit import kernel, law
from solver.elastic import p_wave_speed, shear_modulus
from solver.grid import PADDING, SMALLEST_MASS, allocate_grid
from solver.internal_length import smoothing_weights
from solver.model import make_soil
from solver.operations import INTERNAL_WORK, solve_momentum
from solver.particles import allocate_particles
from solver.step import LOCKING, STRESS_UPDATES, Scheme, accelerate, allocate_workspace, begin, deform

HEIGHT, RIM, COARSE_CELL, WIDTH_IN_CELLS = 10.0, 1.0, 0.5, 2  # m, m, m: rigid blocks at both ends are the walls
PEAK, RESIDUAL = 20e3, 10e3  # Pa
WEAK_SHARE, WEAK_LAYER = 0.95, 1.0  # of the peak strength; m
YOUNG_MODULUS, POISSON_RATIO, DENSITY = 2e6, 0.35, 2000.0
DRIVE = 0.05  # m/s; a strain of DRIVE over the speed of shear waves is a tenth of the strain at yield
SLIP, SAMPLES = 1.0, 66  # m, of the top at the end; looks on the way
DAMPING, COURANT = 0.7, 0.6
MUSL = Scheme(STRESS_UPDATES["musl"], 1.0, DAMPING, LOCKING["cell-average"])


@law
def share_in_rows(sums, mass, columns):
    """Give the nodes of a row their share by mass of its horizontal sum, and nothing vertical."""
    for start in range(0, mass.size, columns):
        row = slice(start, start + columns)
        total = mass[row].sum()
        per_mass = sums[row, 0].sum() / total if total > SMALLEST_MASS else 0.0
        sums[row, 0] = per_mass * mass[row]
        sums[row, 1] = 0.0


@law
def hold(vectors, grid, base, top, value):
    """Hold the rows up to ``base`` at rest and those from ``top`` at ``value``."""
    vectors[: (base + 1) * grid.columns] = 0.0
    vectors[top * grid.columns :, 0] = value
    vectors[top * grid.columns :, 1] = 0.0


@kernel
def shear(particles, grid, work, soil, scheme, base, top, drive, dt, steps):
    """Drive the nodes from row ``top`` up at ``drive`` m/s, hold those up to row ``base``; return the work in J/m."""
    work.ledger[INTERNAL_WORK] = 0.0
    width = grid.width
    begin(particles, grid, work, scheme)
    for _ in range(steps):
        share_in_rows(grid.momentum, grid.mass, grid.columns)
        share_in_rows(grid.force, grid.mass, grid.columns)
        solve_momentum(grid, 0.0, scheme.damping, dt)
        hold(grid.acceleration, grid, base, top, 0.0)
        hold(grid.velocity, grid, base, top, drive)
        accelerate(particles, grid, work, scheme, 0.0, dt)
        grid.remapped[:, 0] *= grid.mass
        share_in_rows(grid.remapped, grid.mass, grid.columns)
        grid.remapped[:, 0] /= np.maximum(grid.mass, SMALLEST_MASS)
        hold(grid.remapped, grid, base, top, drive)
        work.moved_x[:] = work.moved_x % width
        deform(particles, grid, work, soil, scheme, 0.0, dt)
    return work.ledger[INTERNAL_WORK]


def shear_modulus_of_strip():
    """Return ``G`` in Pa."""
    return shear_modulus(YOUNG_MODULUS, POISSON_RATIO)


def strip(cell):
    """Return the particles of a strip with a weak layer in the middle, already in even shear."""
    width = WIDTH_IN_CELLS * cell
    spacing = 0.5 * cell
    x, y = np.meshgrid(np.arange(0.5 * spacing, width, spacing), np.arange(0.5 * spacing, HEIGHT + 2.0 * RIM, spacing))
    particles = allocate_particles(x.ravel(), y.ravel(), spacing**2, DENSITY)
    is_weak = abs(particles.y - RIM - 0.5 * HEIGHT) < 0.5 * WEAK_LAYER
    particles.cohesion[:] = np.where(is_weak, WEAK_SHARE, 1.0) * PEAK
    particles.velocity_x[:] = DRIVE / HEIGHT * np.clip(particles.y - RIM, 0.0, HEIGHT)
    return particles


def shear_force(cell, rate, internal_length):
    """Return displacement of the top in m and mean shear stress in Pa, from the work of the stresses (SAMPLES,)."""
    soil = make_soil(YOUNG_MODULUS, POISSON_RATIO, 0.0, RESIDUAL, 0.0, rate, False, internal_length)
    smoothing = smoothing_weights(internal_length, cell, 0.25)
    grid = allocate_grid(WIDTH_IN_CELLS * cell, HEIGHT + 2.0 * RIM, cell, 0.25, smoothing)
    grid.free_x[:] = grid.free_y[:] = 1.0
    particles = strip(cell)
    work = allocate_workspace(particles.x.size)
    wave_speed = p_wave_speed(soil.bulk_modulus, soil.shear_modulus, DENSITY)
    steps = math.ceil(SLIP / DRIVE / (COURANT * cell / wave_speed) / SAMPLES)
    dt = SLIP / DRIVE / SAMPLES / steps
    base = round(RIM / cell) + PADDING
    top = base + round(HEIGHT / cell)
    works = [shear(particles, grid, work, soil, MUSL, base, top, DRIVE, dt, steps) for _ in range(SAMPLES)]
    displacement = SLIP * (np.arange(SAMPLES) + 0.5) / SAMPLES
    return displacement, np.array(works) / (SLIP / SAMPLES * grid.width)
