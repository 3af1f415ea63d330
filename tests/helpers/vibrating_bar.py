"""A bar that is fixed at one end and vibrates along its axis in its first mode.

    u(X, t) = A sin(w t) sin(pi X / 2 L),  w = pi c / 2 L,  c = sqrt(E / rho)

Places belong to whole steps and velocities to half steps (leapfrog), hence the start with the velocity at ``-dt / 2``
and the kinetic energy from the mean of two velocities.
"""

import numpy as np
from driver import MUSL, elastic_soil, grid_without_walls, lattice, node_indices

from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

LENGTH, MODULUS, DENSITY = 25.0, 100.0, 1.0  # m, Pa, kg/m3
SPEED = np.sqrt(MODULUS / DENSITY)
FREQUENCY = np.pi * SPEED / (2.0 * LENGTH)  # rad/s
PERIOD = 2.0 * np.pi / FREQUENCY
PERIODS = 5


def fixed_free_bar(cell, half_length=0.25):
    """Return the bar, a grid on which it can only move along itself, and its mode shape (n,)."""
    X, y = lattice(LENGTH, cell, cell / 2.0)
    bar = allocate_particles(X, y + 2.0 * cell, cell**2 / 4.0, DENSITY)
    grid = grid_without_walls(LENGTH + 4.0 * cell, 5.0 * cell, cell, half_length)
    grid.free_x[node_indices(grid)[0] <= 0] = 0.0
    grid.free_y[:] = 0.0
    return bar, grid, np.sin(np.pi * X / (2.0 * LENGTH))


def vibrate(cells, amplitude, scheme=MUSL, courant=0.3, half_length=0.25):
    """Return rms displacement error over ``amplitude`` (m), and relative errors of period and energy."""
    cell = LENGTH / cells
    bar, grid, mode = fixed_free_bar(cell, half_length)
    X, work, soil = bar.x.copy(), allocate_workspace(bar.x.size), elastic_soil(MODULUS, 0.0)
    steps = round(PERIODS * PERIOD * SPEED / (courant * cell))
    dt = PERIODS * PERIOD / steps
    bar.velocity_x[:] = amplitude * FREQUENCY * mode * np.cos(FREQUENCY * dt / 2.0)
    time = dt * np.arange(1, steps + 1)
    error, share, energy = np.empty((3, steps))
    for k in range(steps):
        before = bar.velocity_x.copy()
        advance(bar, grid, work, (soil,), scheme, 0.0, 0.0, dt, 1)
        u = bar.x - X
        error[k] = np.mean((u - amplitude * np.sin(FREQUENCY * time[k]) * mode) ** 2)
        share[k] = u @ mode
        energy[k] = 0.5 * np.sum(bar.mass * (0.5 * (before + bar.velocity_x)) ** 2) + work.ledger[0]
    rising = np.flatnonzero((share[:-1] < 0.0) & (share[1:] >= 0.0))
    crossing = time[rising] - share[rising] * dt / (share[rising + 1] - share[rising])
    initial = 0.5 * np.sum(bar.mass * (amplitude * FREQUENCY * mode) ** 2)
    return (
        np.sqrt(error.mean()) / amplitude,
        np.diff(crossing).mean() / PERIOD - 1.0,
        energy[-steps // PERIODS :].mean() / initial - 1.0,
    )
