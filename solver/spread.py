"""Operation 1 of a step: what particles bring to their nodes.

Arguments are those of ``step``.
"""

from typing import Any

from solver._jit import chosen_by_type, inlined, sweep
from solver.cells import read, shares_of
from solver.lanes import lane_numbers, where
from solver.leavers import NOWHERE, settle_next
from solver.operations import clear_state
from solver.pool import own_mean_stress, pool_each
from solver.scheme import CellScheme
from solver.tiles import LEAVERS, PLASTIC_STRAIN, place_of, put, take
from solver.transfer import Load, add_state, deposit_state, load_of, no_state, weights_of


@inlined
def spread_tile(tiles, tile, grid):
    """Operation 1 for a tile."""
    row, column = place_of(tile, grid)
    sums = no_state()
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        w = weights_of(p.x, p.y, row, column, grid)
        sums = add_state(sums, w, load_of(p, own_mean_stress(p, p.pore_pressure), grid))
        block = tiles.following[block]
    deposit_state(grid, row, column, sums)


@inlined
def spread_tile_of_cells(tiles, tile, grid, scheme):
    """Operation 1 for a tile that reads the means over cells, for the internal force and of the plastic strain."""
    row, column = place_of(tile, grid)
    sums = no_state()
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        w = weights_of(p.x, p.y, row, column, grid)
        shares = shares_of(p.x, p.y, row, column, grid)
        mean_stress = own_mean_stress(p, p.pore_pressure)
        if scheme.averages_dilation:
            mean_stress = read(grid.cell_pressure, row, column, shares, grid)
        if scheme.averages_plastic_strain:
            increment = read(grid.cell_plastic_strain, row, column, shares, grid)
            put(tiles, block, PLASTIC_STRAIN, p.plastic_strain + increment)
        sums = add_state(sums, w, load_of(p, mean_stress, grid))
        block = tiles.following[block]
    deposit_state(grid, row, column, sums)


@sweep
def spread_each(tiles, grid):
    """Operation 1 for all particles."""
    clear_state(grid)
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            spread_tile(tiles, tile, grid)


@sweep
def spread_each_of_cells(tiles, grid, scheme):
    """Operation 1 for all particles, with the means that the cells have."""
    clear_state(grid)
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            spread_tile_of_cells(tiles, tile, grid, scheme)


def spread_all(tiles, grid, scheme):
    """Operation 1 for particles as they are."""
    raise NotImplementedError("A kernel's own.")


@chosen_by_type(spread_all)
def _spread_all(tiles: Any, grid: Any, scheme: Any) -> Any:
    def with_cells(tiles, grid, scheme):
        pool_each(tiles, grid, scheme)
        spread_each_of_cells(tiles, grid, scheme)

    def without(tiles, grid, scheme):
        spread_each(tiles, grid)

    return with_cells if scheme.instance_class is CellScheme else without


@inlined
def spread_lane(tiles, block, lane, grid):
    """Operation 1 for one particle, which has been put into a lane of a block."""
    row, column = place_of(tiles.tile[block], grid)
    p = take(tiles, block)
    is_it = lane_numbers() == float(lane)
    brought = load_of(p, own_mean_stress(p, p.pore_pressure), grid)
    alone = Load(
        where(is_it, brought.mass, 0.0),
        where(is_it, brought.momentum_x, 0.0),
        where(is_it, brought.momentum_y, 0.0),
        where(is_it, brought.xx, 0.0),
        where(is_it, brought.yy, 0.0),
        where(is_it, brought.xy, 0.0),
        where(is_it, brought.lift, 0.0),
    )
    w = weights_of(p.x, p.y, row, column, grid)
    deposit_state(grid, row, column, add_state(no_state(), w, alone))


@sweep
def settle_and_spread(tiles, grid):
    """Put the leavers into their new tiles, with operation 1; return whether all are on the grid."""
    while tiles.counts[LEAVERS] > 0:
        block, lane = settle_next(tiles, grid)
        if block == NOWHERE:
            return False
        spread_lane(tiles, block, lane, grid)
    return True
