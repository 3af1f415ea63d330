"""Particles that leave their base cell in a step.

They are few, so they are taken out, put into their new tiles and brought to their nodes one by one, in order: a run is
the same, bit for bit, each time.
"""

from solver._jit import inlined, sweep
from solver.constants import LANE_COUNT
from solver.lanes import bits, lane_numbers
from solver.tiles import FIELDS, LEAVERS, MASS, X, Y, add_block, base_cell, empty_lane, is_on_grid, tiles_in_row

NOWHERE = -1


@inlined
def is_in_base_cell(x, y, row, column, grid):
    """Return which particles of a block, now at ``x``, ``y`` (m), are in their base cells; NaN is in none."""
    right = (x - grid.origin) * (1.0 / grid.cell_size) - grid.half_length - (lane_numbers() + float(column))
    up = (y - grid.origin) * (1.0 / grid.cell_size) - grid.half_length - float(row)
    return (right >= 0.0) & (right < 1.0) & (up >= 0.0) & (up < 1.0)


@inlined
def take_out(tiles, block, is_there, stays, row, column, grid):
    """Move the particles that do not stay from a block to the leavers."""
    going = bits(is_there) & ~bits(stays)
    if going:
        for lane in range(LANE_COUNT):
            if (going >> lane) & 1:
                for field in range(FIELDS):
                    tiles.leavers[tiles.counts[LEAVERS], field] = tiles.blocks[block, field, lane]
                tiles.counts[LEAVERS] += 1
                empty_lane(tiles.blocks, block, lane, row, column + lane, grid)


@inlined
def settle(tiles, leaver, grid):
    """Put a leaver into its tile; return block and lane, ``NOWHERE`` and 0 off the grid."""
    x, y = tiles.leavers[leaver, X], tiles.leavers[leaver, Y]
    if not is_on_grid(x, y, grid):
        return NOWHERE, 0
    row, column = base_cell(y, grid), base_cell(x, grid)
    tile, lane = row * tiles_in_row(grid) + column // LANE_COUNT, column % LANE_COUNT
    block = tiles.first[tile]
    while block >= 0 and tiles.blocks[block, MASS, lane] > 0.0:
        block = tiles.following[block]
    if block < 0:
        block = add_block(tiles, tile, row, column - lane, grid)
    for field in range(FIELDS):
        tiles.blocks[block, field, lane] = tiles.leavers[leaver, field]
    return block, lane


@inlined
def settle_next(tiles, grid):
    """Put the last of the leavers into its new tile; return block and lane."""
    block, lane = settle(tiles, tiles.counts[LEAVERS] - 1, grid)
    tiles.counts[LEAVERS] -= block != NOWHERE
    return block, lane


@sweep
def settle_all(tiles, grid):
    """Put the leavers into their new tiles; return whether all are on the grid."""
    while tiles.counts[LEAVERS] > 0:
        if settle_next(tiles, grid)[0] == NOWHERE:
            return False
    return True
