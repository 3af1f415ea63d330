"""A column that settles under its own weight by several cells (finite strain).

With ``sigma = M ln J`` and constant cross-section (AMPLE's one-dimensional compaction in logarithmic strain)

    sigma_yy(Y) = -rho0 g (H - Y)
    u(Y) = M / (rho0 g) (exp(-rho0 g (H - Y) / M) - exp(-rho0 g H / M)) - Y
"""

import numpy as np
import pytest
from driver import Row, elastic_soil, lattice, observed_orders

from solver.grid import allocate_grid
from solver.model import STANDARD_GRAVITY
from solver.particles import allocate_particles
from solver.step import STRESS_UPDATES, Scheme, advance, allocate_workspace

HEIGHT, DENSITY, SQUASH = 8.0, 1000.0, 0.3  # m, kg/m3, rho0 g H / M
MODULUS = DENSITY * STANDARD_GRAVITY * HEIGHT / SQUASH
CELLS = (8, 16, 32, 64)


def settle(cells, half_length=0.25):
    """Return relative root mean square errors of stress and displacement of the column at rest."""
    cell = HEIGHT / cells
    x, Y = lattice(cell, HEIGHT, cell / 2.0)
    column = allocate_particles(x, Y, cell**2 / 4.0, DENSITY)
    grid, work = allocate_grid(cell, HEIGHT + cell, cell, half_length), allocate_workspace(x.size)
    soil = elastic_soil(MODULUS, 0.0)
    crossing = HEIGHT / np.sqrt(MODULUS / DENSITY)
    steps = 10 * cells * 4
    dt = 10.0 * crossing / steps
    scheme = Scheme(STRESS_UPDATES["musl"], 1.0, 0.7)
    for gravity, rate in ((0.0, STANDARD_GRAVITY / (steps * dt)), (STANDARD_GRAVITY, 0.0), (STANDARD_GRAVITY, 0.0)):
        advance(column, grid, work, soil, scheme, gravity, rate, dt, steps)
    weight = DENSITY * STANDARD_GRAVITY
    stress = -weight * (HEIGHT - Y)
    place = MODULUS / weight * (np.exp(-weight * (HEIGHT - Y) / MODULUS) - np.exp(-SQUASH))
    stress_error = np.sqrt(np.mean((column.stress_yy - stress) ** 2)) / (weight * HEIGHT)
    place_error = np.sqrt(np.mean((column.y - place) ** 2)) / (HEIGHT - place.max())
    return stress_error, place_error


if __name__ == "__main__":
    import time

    for hl in (0.25, 0.5, 1e-6):
        t = time.time()
        e = np.array([settle(c, hl) for c in CELLS])
        print(hl, e.T, observed_orders(e[:, 0]), observed_orders(e[:, 1]), time.time() - t)
