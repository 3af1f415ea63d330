"""What verification problems need beyond the solver: other walls, body forces, and a march made of its own kernels."""

from typing import NamedTuple

import numpy as np
from parts_of_a_step import accelerate, begin, deform, solve

from solver._jit import kernel
from solver.basis import allocate_stencil, evaluate_stencil
from solver.constants import LANE_COUNT
from solver.grid import NO_SMOOTHING, allocate_grid
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.scheme import STRESS_UPDATES, Scheme
from solver.softening import NO_SOFTENING
from solver.sorting import read_tiles
from solver.step import allocate_workspace
from solver.tiles import MASS, MOVED_X, USED

UGIMP, B_SPLINE, LINEAR = 0.25, 0.5, 1e-6  # half lengths in cells, at four particles a cell
SCHEMES = {name: Scheme(number, 1.0, 0.0) for name, number in STRESS_UPDATES.items()}
MUSL = SCHEMES["musl"]


class Row(NamedTuple):
    """One line of the verification table: four texts, and whether the target is met."""

    phenomenon: str
    expected: str
    observed: str
    error: str
    is_met: bool


def elastic_soil(young_modulus, poisson_ratio):
    """Return a soil whose particles (as allocated, unyielding) are elastic."""
    return mohr_coulomb(Constants(young_modulus, poisson_ratio, 0.0, NO_SOFTENING))


def observed_orders(errors):
    """Return the orders between successive errors of a ladder that halves the cell each time."""
    return np.log2(np.divide(errors[:-1], errors[1:]))


def orders_row(phenomenon, order, accepted, errors, finest):
    """Return the line of a ladder of relative errors whose last was found at ``finest``.

    ``order`` is what theory gives, ``accepted`` the least that counts as met.
    """
    orders = observed_orders(errors)
    return Row(
        phenomenon,
        f"order {order:g}, at least {accepted:g}",
        f"order {', '.join(f'{order:.2f}' for order in orders)}",
        f"{errors[-1]:.2%} at {finest}",
        bool(orders.min() >= accepted),
    )


def divergence_row(phenomenon, errors, finest):
    """Return the line of a method that is known not to converge."""
    orders = observed_orders(errors)
    return Row(
        phenomenon,
        "no convergence",
        f"order {', '.join(f'{order:.2f}' for order in orders)}",
        f"{errors[-1]:.2%} at {finest}",
        bool(orders.max() < 0.2),
    )


def node_indices(grid):
    """Return column and row of every node, (rows, columns), counted from the lower left corner of the walls."""
    j, i = np.indices(grid.mass.shape)
    offset = round(grid.origin / grid.cell_size)
    return i + offset, j + offset


def grid_without_walls(width, height, cell_size, half_length=UGIMP, smoothing=NO_SMOOTHING):
    """Return a grid whose nodes are all free."""
    grid = allocate_grid(width, height, cell_size, half_length, smoothing)
    grid.free_x[:] = grid.free_y[:] = 1.0
    return grid


def grid_with_rollers(width, height, cell_size, half_length=UGIMP):
    """Return a grid with a frictionless wall on each of its four sides."""
    grid = grid_without_walls(width, height, cell_size, half_length)
    i, j = node_indices(grid)
    grid.free_x[(i <= 0) | (i >= round(width / cell_size))] = 0.0
    grid.free_y[(j <= 0) | (j >= round(height / cell_size))] = 0.0
    return grid


def lattice(width, height, spacing):
    """Return the centres of squares that tile a rectangle."""
    x = (np.arange(round(width / spacing)) + 0.5) * spacing
    y = (np.arange(round(height / spacing)) + 0.5) * spacing
    return (axis.ravel() for axis in np.meshgrid(x, y))


@kernel
def add_body_force(particles, grid, stencil, acceleration_x, acceleration_y):
    """Add ``S_ip m_p b_p`` to the nodal forces, ``b`` (n,) in m/s2."""
    evaluate_stencil(stencil, particles.x, particles.y, grid)
    for p in range(particles.x.size):
        row, column = stencil.node[p] // grid.columns, stencil.node[p] % grid.columns
        for j in range(3):
            for i in range(3):
                mass = stencil.sx[i, p] * stencil.sy[j, p] * particles.mass[p]
                grid.force[row + j, 0, column + i] += mass * acceleration_x[p]
                grid.force[row + j, 1, column + i] += mass * acceleration_y[p]


@kernel
def wrap_around(tiles, width):
    """Let particles that move beyond a side come back at the other, ``width`` m away."""
    for block in range(tiles.counts[USED]):
        for lane in range(LANE_COUNT):
            if tiles.blocks[block, MASS, lane] > 0.0:
                tiles.blocks[block, MOVED_X, lane] %= width


def march(particles, grid, soil, scheme, dt, steps, body_force, observe):
    """Take steps of ``dt`` s under ``body_force(t) -> (b_x, b_y)`` in m/s2; call ``observe(t)`` after each."""
    work, stencil = allocate_workspace(particles.x.size), allocate_stencil(particles.x.size)
    for step in range(steps):
        tiles = begin(particles, grid, work, scheme)
        add_body_force(particles, grid, stencil, *body_force(step * dt))
        solve(grid, 0.0, scheme.damping, dt)
        assert accelerate(tiles, grid, work, scheme, 0.0, dt)
        assert deform(tiles, grid, work, (soil,), scheme, 0.0, dt)
        read_tiles(tiles, particles)
        observe((step + 1) * dt)
