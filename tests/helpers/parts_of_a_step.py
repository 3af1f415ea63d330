"""Parts of a step as kernels, for loops in Python."""

from solver import deformation, operations, pool, sorting, spread, step
from solver._jit import kernel


@kernel
def sorted_tiles(tiles, grid):
    """Return the same particles in blocks without holes."""
    return sorting.sorted_tiles(tiles, grid)


@kernel
def spread_all(tiles, grid, scheme):
    """Operation 1."""
    spread.spread_all(tiles, grid, scheme)


def begin(particles, grid, work, scheme):
    """Return the tiles of particles that have spread their state to the grid: operation 1 of the first step."""
    tiles = sorting.fill_tiles(particles, grid, work.tiles)
    spread_all(tiles, grid, scheme)
    return tiles


@kernel
def pool_each(tiles, grid, scheme):
    """Find the means over cells."""
    pool.pool_each(tiles, grid, scheme)


@kernel
def solve(grid, gravity, damping, dt):
    """Operation 2."""
    operations.solve_momentum(grid, gravity, damping, dt)


@kernel
def accelerate(tiles, grid, work, scheme, gravity, dt):
    """Operations 3 and 4."""
    return step.accelerate(tiles, grid, work, scheme, gravity, dt)


@kernel
def deform(tiles, grid, work, laws, scheme, gravity, dt):
    """Operations 5 and 6, and 1 of the next step."""
    return deformation.deform(tiles, grid, work.ledger, laws, scheme, gravity, dt)


@kernel
def move(tiles, grid, work):
    """Operation 6."""
    return deformation.move_each(tiles, grid, 0.0, work.ledger)
