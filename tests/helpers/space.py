"""Failures of the space discretisation: numerical fracture, and softening that depends on the mesh."""

import numpy as np
from bodies import BASES
from driver import MUSL, elastic_soil, grid_without_walls, lattice, node_indices

from campaign.simulation.detachment import detached_volume
from solver.basis import allocate_stencil, evaluate_stencil
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.particles import allocate_particles, copy_particles
from solver.softening import Softening
from solver.step import advance, allocate_workspace
from solver.surface import Surface

STRETCHES = np.arange(1.0, 7.0, 0.01)


def share_of_cut_bonds(basis, stretch, particles=400):
    """Return how many neighbours of a row, two a cell before it was stretched, have no node in common."""
    x = 1.0 + 0.5 * stretch * np.arange(particles)
    grid = grid_without_walls(x[-1] + 2.0, 4.0, 1.0, BASES[basis])
    stencil = allocate_stencil(particles)
    evaluate_stencil(stencil, x, np.full(particles, 2.0), grid)
    first = stencil.node % grid.columns
    touched = stencil.sx > 1e-5
    low = first + touched.argmax(axis=0)
    high = first + 2 - touched[::-1].argmax(axis=0)
    return np.mean(low[1:] > high[:-1])


def fracture(basis):
    """Return the stretches at which the first bond, and the last one, is cut."""
    cut = np.array([share_of_cut_bonds(basis, stretch + 1e-4 * np.pi) for stretch in STRETCHES])
    return STRETCHES[np.argmax(cut > 0.0)], STRETCHES[np.argmax(cut == 1.0)]


def expected_fracture(basis):
    """Return ``(h + 2 l_p) / d`` and ``2 (h + l_p) / d`` at ``d = h / 2``: supports that may, and must, miss a node."""
    return 2.0 * (1.0 + 2.0 * BASES[basis]), 4.0 * (1.0 + BASES[basis])


def stretch_flagged(basis, length=12.0):
    """Return the stretch of a strip, drawn out evenly by its own inertia, at which a run that ends is flagged."""
    x, y = lattice(length, 2.0, 0.5)
    strip = allocate_particles(x, y + 2.0, 0.25, 1.0)
    strip.velocity_x[:] = x
    start, level = copy_particles(strip), Surface(np.array([0.0, 7.0 * length]), np.zeros(2), toe_x=7.0 * length)
    grid, work = grid_without_walls(7.0 * length, 6.0, 1.0, BASES[basis]), allocate_workspace(x.size)
    stretch, step = 1.0, 0.01
    while detached_volume(strip, start, level, 0.5) == 0.0 and stretch < STRETCHES[-1]:
        advance(strip, grid, work, (elastic_soil(1e-9, 0.0),), MUSL, 0.0, 0.0, step, 1)
        stretch += step
    return stretch


HEIGHT, PEAK, RESIDUAL, RATE, REFERENCE = 2.0, 10e3, 2e3, 10.0, 0.25  # m, Pa, Pa, 1, m


def slip_to_half_strength(cell, rate):
    """Return the plastic slip (m) at which a sheared strip of Tresca soil has lost half of what softening takes.

    The strip is four cells wide. Its foot is fixed, its uppermost cells are drawn sideways, one row is 5 % weaker.
    """
    x, y = lattice(4.0 * cell, HEIGHT, cell / 2.0)
    soil = mohr_coulomb(Constants(1e7, 0.3, 0.0, Softening(rate, is_linear=False)))
    strip = allocate_particles(x + 4.0 * cell, y, cell**2 / 4.0, 2000.0)
    drawn = y > HEIGHT - cell
    strip.cohesion[~drawn] = PEAK
    strip.cohesion_residual[:] = RESIDUAL
    strip.cohesion[np.abs(y - HEIGHT / 2.0 + cell / 2.0) < cell / 2.0] *= 0.95
    grid, work = grid_without_walls(16.0 * cell, HEIGHT + 2.0 * cell, cell), allocate_workspace(x.size)
    grid.free_y[:] = 0.0
    grid.free_x[node_indices(grid)[1] <= 0] = 0.0
    speed, dt = 0.1, 0.4 * cell / 82.0
    peak, slip = 0.0, 0.0
    while slip < 0.4:
        strip.velocity_x[drawn] = speed
        advance(strip, grid, work, (soil,), MUSL, 0.0, 0.0, dt, 4)
        slip += 4.0 * speed * dt
        shear = strip.stress_xy[~drawn].mean()
        peak = max(peak, shear)
        if peak > 0.9 * PEAK and shear < 0.5 * (peak + RESIDUAL):
            return slip - shear * (HEIGHT - cell) / soil.shear_modulus
    return np.nan


def mesh_dependence(is_scaled, cells=(0.25, 0.125)):
    """Return the ratio of the slips on a mesh and on one twice as fine."""
    coarse, fine = (slip_to_half_strength(cell, RATE * (cell / REFERENCE if is_scaled else 1.0)) for cell in cells)
    return coarse / fine
