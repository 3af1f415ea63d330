"""Elastic bodies that are stable or not: how much energy the scheme itself gives them.

A free block and a fixed bar, as in the verification ladder, but with any basis and any Courant number.
"""

import warnings

import numpy as np
from driver import B_SPLINE, LINEAR, SCHEMES, UGIMP, elastic_soil, grid_without_walls, lattice
from vibrating_bar import FREQUENCY, PERIOD, PERIODS, fixed_free_bar, vibrate
from vibrating_bar import MODULUS as BAR_MODULUS
from vibrating_bar import SPEED as BAR_SPEED

from solver import observables
from solver.domain import half_length_in_cells
from solver.elastic import p_wave_speed
from solver.operations import INTERNAL_WORK
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

BASES = {"linear": LINEAR, "gimp": UGIMP, "bspline": B_SPLINE}
SIDE, DENSITY, STRAIN = 12.0, 1.0, 0.01  # cells of 1 m
SOIL = elastic_soil(100.0, 0.35)
SPEED = p_wave_speed(SOIL.bulk_modulus, SOIL.shear_modulus, DENSITY)
OFFSETS = [(0.0, 0.0), (0.1, 0.1), (0.24, 0.24), (0.26, 0.26)]  # in cells; the last puts a row 1 % beyond a node


def energy_gained(body, grid, soil, scheme, dt, steps):
    """March in place; return the energy that the scheme created, over what the body brought (inf if it broke off)."""
    work, brought = allocate_workspace(body.x.size), observables.kinetic_energy(body)
    with np.errstate(all="ignore"):
        taken = advance(body, grid, work, (soil,), scheme, 0.0, 0.0, dt, steps)
        energy = observables.kinetic_energy(body) + work.ledger[INTERNAL_WORK]
    gained = energy / brought - 1.0
    return gained if taken == steps and np.isfinite(gained) else np.inf


def free_block(side, offset=(0.0, 0.0), particles_per_cell=4):
    """Return a block far from the ends of its grid."""
    spacing = particles_per_cell**-0.5
    x, y = lattice(side, side, spacing)
    return allocate_particles(x + 3.0 + offset[0], y + 3.0 + offset[1], spacing**2, DENSITY)


def flying_block(basis, scheme, courant, particles_per_cell=4):
    """Return the energy a breathing block gains while it flies over four cells, over that of its vibration."""
    block = free_block(SIDE, particles_per_cell=particles_per_cell)
    for place, velocity in ((block.x, block.velocity_x), (block.y, block.velocity_y)):
        velocity[:] = STRAIN * SPEED * np.sin(np.pi * ((place - 3.0) / SIDE - 0.5))
    vibration = observables.kinetic_energy(block)
    for velocity in (block.velocity_x, block.velocity_y):
        velocity += 0.05 * SPEED
    grid = grid_without_walls(SIDE + 10.0, SIDE + 10.0, 1.0, half_length_in_cells(basis, particles_per_cell))
    steps = int(np.ceil(80.0 / courant))
    total = observables.kinetic_energy(block)
    return energy_gained(block, grid, SOIL, SCHEMES[scheme], 80.0 / SPEED / steps, steps) * total / vibration


def still_block(basis, scheme, courant, offset=(0.0, 0.0), steps=2000, particles_per_cell=4):
    """Return the energy gained by a block that trembles so little that no particle changes its place."""
    block, rng = free_block(6.0, offset, particles_per_cell), np.random.default_rng(1)
    block.velocity_x[:], block.velocity_y[:] = 1e-9 * SPEED * rng.standard_normal((2, block.x.size))
    grid = grid_without_walls(12.0, 12.0, 1.0, half_length_in_cells(basis, particles_per_cell))
    return energy_gained(block, grid, SOIL, SCHEMES[scheme], courant / SPEED, steps)


def crossing_bar(basis, scheme, courant, amplitude=1.2):
    """Return the energy gained in five periods by a bar whose end swings by ``amplitude`` cells."""
    bar, grid, mode = fixed_free_bar(1.0, BASES[basis])
    steps = int(np.ceil(PERIODS * PERIOD * BAR_SPEED / courant))
    dt = PERIODS * PERIOD / steps
    bar.velocity_x[:] = amplitude * FREQUENCY * mode
    return energy_gained(bar, grid, elastic_soil(BAR_MODULUS, 0.0), SCHEMES[scheme], dt, steps)


def displacement_error(basis, cells):
    """Return the rms error of the crossing bar's displacements over its amplitude, at Courant 0.3 with MUSL."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a bar that no longer swings has no period
        return vibrate(cells, 1.2, courant=0.3, half_length=BASES[basis])[0]
