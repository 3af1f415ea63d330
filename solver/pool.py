"""What the cells gather of the particles after a step, and the means that they make of it (see ``cells``).

Arguments are those of ``step``.
"""

from typing import NamedTuple

from solver._jit import inlined, sweep
from solver.cells import Pool, add_to_pool, average, deposit_pool, no_pool, shares_of, volumes_in
from solver.lanes import lane_numbers, where
from solver.leavers import NOWHERE, settle_next
from solver.mean_dilation import NO_VOLUME
from solver.nonlocal_softening import smooth
from solver.tiles import LEAVERS, PLASTIC_INCREMENT, get, place_of, take


class StatePool(NamedTuple):
    """Sums over the cells of a tile."""

    volume: Pool  # m2
    pressure: Pool  # N/m, volume times the in-plane mean stress
    plastic_strain: Pool  # m2, volume times the increment


@inlined
def no_state_pool():
    """Return sums that are zero."""
    return StatePool(no_pool(), no_pool(), no_pool())


@inlined
def own_mean_stress(effective, pore_pressure):
    """Return the in-plane mean of the total stress of particles in Pa, of their effective stress and pore pressure."""
    return 0.5 * (effective.stress_xx + effective.stress_yy) - pore_pressure


@inlined
def add_to_state_pool(sums, shares, volume, mean_stress, plastic_increment):
    """Return the sums with a block of particles added; volume in m2, stress in Pa."""
    volumes = volumes_in(shares, volume)
    return StatePool(
        add_to_pool(sums.volume, volumes, 1.0),
        add_to_pool(sums.pressure, volumes, mean_stress),
        add_to_pool(sums.plastic_strain, volumes, plastic_increment),
    )


@inlined
def deposit_state_pool(grid, row, column, sums):
    """Add the sums of a tile to the grid."""
    deposit_pool(grid.cell_volume, row, column, sums.volume, grid)
    deposit_pool(grid.cell_pressure, row, column, sums.pressure, grid)
    deposit_pool(grid.cell_plastic_strain, row, column, sums.plastic_strain, grid)


@inlined
def empty_state_pool(grid):
    """Empty the cells before they gather."""
    grid.cell_volume[:] = 0.0
    grid.cell_pressure[:] = 0.0
    grid.cell_plastic_strain[:] = 0.0


@inlined
def pool_lane(tiles, block, lane, grid):
    """Let the cells gather one particle, which has been put into a lane of a block."""
    row, column = place_of(tiles.tile[block], grid)
    p = take(tiles, block)
    volume = where(lane_numbers() == float(lane), p.volume, 0.0)
    shares = shares_of(p.x, p.y, row, column, grid)
    increment = get(tiles, block, PLASTIC_INCREMENT)
    sums = add_to_state_pool(no_state_pool(), shares, volume, own_mean_stress(p, p.pore_pressure), increment)
    deposit_state_pool(grid, row, column, sums)


@sweep
def settle_and_pool(tiles, grid):
    """Put the leavers into their new tiles, and let the cells gather them; return whether all are on the grid."""
    while tiles.counts[LEAVERS] > 0:
        block, lane = settle_next(tiles, grid)
        if block == NOWHERE:
            return False
        pool_lane(tiles, block, lane, grid)
    return True


@inlined
def average_state_pool(grid, scheme):
    """Turn what the cells have gathered into means: of the pressure, and of the increments of plastic strain."""
    average(grid.cell_pressure, grid.cell_volume, NO_VOLUME)
    if scheme.averages_plastic_strain:
        smooth(grid.cell_volume, grid.smoothing)
        smooth(grid.cell_plastic_strain, grid.smoothing)
        average(grid.cell_plastic_strain, grid.cell_volume, 0.0)


@sweep
def pool_each(tiles, grid, scheme):
    """Find the means over cells of particles as they are."""
    empty_state_pool(grid)
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        sums = no_state_pool()
        block = tiles.first[tile]
        while block >= 0:
            p = take(tiles, block)
            shares = shares_of(p.x, p.y, row, column, grid)
            increment = get(tiles, block, PLASTIC_INCREMENT)
            sums = add_to_state_pool(sums, shares, p.volume, own_mean_stress(p, p.pore_pressure), increment)
            block = tiles.following[block]
        if tiles.first[tile] >= 0:
            deposit_state_pool(grid, row, column, sums)
    average_state_pool(grid, scheme)
