"""The largest stable time step, found by bisection, of particles that do not change their places."""

import numpy as np
from bodies import BASES, DENSITY, OFFSETS, SOIL, SPEED, still_block
from driver import SCHEMES, grid_without_walls

from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

EXPLODED = 1e3  # times the energy at the start


def largest_stable(is_stable, low, high, resolution=0.01):
    """Return the boundary between ``low``, which is stable, and ``high``, which is not."""
    while high - low > resolution:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return 0.5 * (low + high)


def limit_of_block(basis, scheme):
    """Return the Courant number below which a trembling free block is stable wherever its particles lie."""

    def is_stable(courant):
        return all(still_block(basis, scheme, courant, offset) < EXPLODED for offset in OFFSETS)

    return largest_stable(is_stable, 0.02, 2.6)


def particle_is_stable(place, courant, steps=400):
    """Return whether the stress of one linear particle, ``place`` cells beyond a node, does not grow under USL."""
    particle = allocate_particles(np.array([2.0 + place]), np.array([2.5]), 1.0, DENSITY)
    particle.stress_xx[:] = first = 1e-9 * SOIL.bulk_modulus
    grid, work = grid_without_walls(5.0, 5.0, 1.0, BASES["linear"]), allocate_workspace(1)
    grid.free_y[:] = 0.0
    for _ in range(steps):  # one by one: strains of the order of one would end the growth
        advance(particle, grid, work, (SOIL,), SCHEMES["usl"], 0.0, 0.0, courant / SPEED, 1)
        if not abs(particle.stress_xx[0]) < 2.0 * first:
            return False
    return True


def limit_of_particle(place):
    """Return the measured limit and ``sqrt(2 xi (1 - xi))``: a cell with nodal masses ``m xi`` and ``m (1 - xi)``."""
    measured = largest_stable(lambda courant: particle_is_stable(place, courant), 0.001, 2.0, 0.002)
    return measured, np.sqrt(2.0 * place * (1.0 - place))
