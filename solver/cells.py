"""Means over cells: particles pool a value in the cells that their domains overlap, and read the means back.

    value_c = sum_p w_cp V_p value_p / sum_p w_cp V_p,   read back as sum_c w_cp value_c

``w_cp`` is the share of the particle's domain that lies in cell ``c``, so a particle changes cells as gently as its
weights do: of the base cell and the next along x the next has the share ``h S_2'`` (see ``basis``). The arrays of cells
are numbered like the nodes: a cell has the number of its lower left corner. Functions are of a block of particles, as
in ``transfer``.
"""

from typing import NamedTuple

from solver._jit import inlined
from solver.constants import LANE_COUNT
from solver.lanes import bits, lane_numbers, load, spill_1, splat, store, up_1, where


class Shares(NamedTuple):
    """Share of the domains of particles that lies in the next cell to the right, and in the next above."""

    right: float
    upper: float


@inlined
def shares_of(x, y, row, column, grid):
    """Return the shares of a block of particles at ``x``, ``y`` (m)."""
    inverse_cell, inverse_width = 1.0 / grid.cell_size, 0.5 / grid.half_length
    right = (x - grid.origin) * inverse_cell - (lane_numbers() + float(column)) - (1.0 - grid.half_length)
    upper = (y - grid.origin) * inverse_cell - float(row) - (1.0 - grid.half_length)
    return Shares(max(right, 0.0) * inverse_width, max(upper, 0.0) * inverse_width)


@inlined
def read(means, row, column, shares, grid):
    """Return ``sum_c w_cp mean_c`` of ``means`` (rows, columns)."""
    start = row * grid.columns + column
    below = _between(means, start, shares.right)
    return below + shares.upper * (_between(means, start + grid.columns, shares.right) - below)


@inlined
def _between(means, start, right):
    left = load(means, start)
    return left + right * (load(means, start + 1) - left)


class Pool(NamedTuple):
    """Sums of two neighbouring cells below, and of the two above them."""

    lower: tuple[float, float]
    upper: tuple[float, float]


@inlined
def no_pool():
    """Return sums that are zero."""
    return Pool((splat(0.0), splat(0.0)), (splat(0.0), splat(0.0)))


class Volumes(NamedTuple):
    """Volume (m2) of particles in each of their four cells, ``w_cp V_p``."""

    lower_left: float
    lower_right: float
    upper_left: float
    upper_right: float


@inlined
def volumes_in(shares, volume):
    """Return how the volume of particles is shared among their four cells."""
    upper = shares.upper * volume
    lower = volume - upper
    lower_right, upper_right = shares.right * lower, shares.right * upper
    return Volumes(lower - lower_right, lower_right, upper - upper_right, upper_right)


@inlined
def add_to_pool(sums, volumes, value):
    """Return the sums with ``w_cp V_p value_p`` added."""
    return Pool(
        (sums.lower[0] + volumes.lower_left * value, sums.lower[1] + volumes.lower_right * value),
        (sums.upper[0] + volumes.upper_left * value, sums.upper[1] + volumes.upper_right * value),
    )


@inlined
def deposit_pool(sums_of_cells, row, column, sums, grid):
    """Add sums to those of the cells ``(rows, columns)``."""
    _deposit_two(sums_of_cells, row * grid.columns + column, sums.lower)
    _deposit_two(sums_of_cells, (row + 1) * grid.columns + column, sums.upper)


@inlined
def _deposit_two(field, start, sums):
    store(field, start, load(field, start) + (sums[0] + up_1(sums[1])))
    store(field, start + LANE_COUNT, load(field, start + LANE_COUNT) + spill_1(sums[1]))


@inlined
def average(sums, volumes, least):
    """Turn sums over cells (rows, columns) into means, in place; 0 where the volume is not above ``least`` (m2)."""
    for k in range(0, sums.size, LANE_COUNT):
        volume = load(volumes, k)
        has_volume = volume > least
        if bits(has_volume):
            store(sums, k, where(has_volume, load(sums, k) / volume, 0.0))
