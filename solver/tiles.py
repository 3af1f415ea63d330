"""Particles in blocks of eight, so that eight neighbours in a row are the lanes of a vector.

The *base cell* of a particle is the lower left of its 3 x 3 nodes. A *tile* is eight neighbouring base cells of a row.
A *block* holds at most one particle of each: lane ``l`` is one of base cell ``l``. So the nodes that lane ``l`` touches
stand one place to the right of those of lane ``l - 1``, and a transfer between a block and a row of nodes is three
vectors of eight neighbouring nodes: no gather, no conflict. A tile has as many blocks as its fullest cell has
particles, in a chain.

An empty lane has no mass, no volume and no stress, and stands in the middle of its cell. A particle that leaves its
base cell is put into a hole of its new tile, or into a new block (``leavers``). Now and then the blocks are copied in
the order of the tiles and without holes (``sorting``).
"""

from typing import NamedTuple

import numpy as np

from solver._jit import inlined
from solver.constants import LANE_COUNT
from solver.lanes import load, store
from solver.memory import aligned_zeros
from solver.particles import UNYIELDING, Particles

# Fields of a block: those of the particles in their order, then what a step keeps until it ends.
X, Y, VELOCITY_X, VELOCITY_Y, MASS, VOLUME, STRESS_XX, STRESS_YY, STRESS_ZZ, STRESS_XY, PLASTIC_STRAIN = range(11)
COHESION, FRICTION_ANGLE, COHESION_RESIDUAL, FRICTION_ANGLE_RESIDUAL = range(11, 15)
PORE_AREA, PORE_PRESSURE, MATERIAL = range(15, 18)
NUMBER = 18  # of the particle
MOVED_X, MOVED_Y = 19, 20  # m, places at the end of the step
INCREMENT_XX, INCREMENT_XY, INCREMENT_YX, INCREMENT_YY = 21, 22, 23, 24  # displacement gradient of the step
FIELDS = 25
PLASTIC_INCREMENT = INCREMENT_XX  # of the plastic strain, until it is averaged: in the place of what is used up

BLOCK = FIELDS * LANE_COUNT
USED, LEAVERS, STEPS, SORTS = 0, 1, 2, 3  # entries of ``Tiles.counts``
MIDDLE = 0.75  # of the place of an empty lane, in cells from its base node: it touches no third node


class Tiles(NamedTuple):
    """Particles in blocks, and their tiles, numbered row by row."""

    blocks: np.ndarray  # (capacity, FIELDS, 8)
    spare: np.ndarray  # (capacity, FIELDS, 8) where they are sorted to
    following: np.ndarray  # (capacity,) the next block of the same tile, -1 after the last
    first: np.ndarray  # (rows * tiles in a row,) the first block of a tile, -1 if it is empty
    tile: np.ndarray  # (capacity,) the tile of a block
    leavers: np.ndarray  # (n, FIELDS) particles that have left their base cells in this step
    counts: np.ndarray  # (4,) blocks in use, leavers, steps since the blocks were sorted, sorts of a kernel


def allocate_tiles(n_particles: int) -> Tiles:
    """Return room for ``n_particles``, whose tiles are those of the grid that they are put on.

    A block has at least one particle after they are sorted, and a step adds at most one block for each. What is not
    used is never touched, so that it takes no memory.
    """
    capacity = 2 * n_particles + 1
    return Tiles(
        blocks=aligned_zeros((capacity, FIELDS, LANE_COUNT)),
        spare=aligned_zeros((capacity, FIELDS, LANE_COUNT)),
        following=np.empty(capacity, np.int64),
        first=np.empty(0, np.int64),
        tile=np.empty(capacity, np.int64),
        leavers=np.empty((n_particles, FIELDS)),
        counts=np.zeros(4, np.int64),
    )


def after_sorts(tiles: Tiles) -> Tiles:
    """Return the tiles as a kernel that was given these has left them: at each sort, blocks and spare change places."""
    return tiles._replace(blocks=tiles.spare, spare=tiles.blocks) if tiles.counts[SORTS] % 2 else tiles


@inlined
def tiles_in_row(grid):
    """Return how many tiles a row of the grid has; eight more columns take what spills over."""
    return grid.columns // LANE_COUNT - 1


@inlined
def place_of(tile, grid):
    """Return row and first column of the base cells of a tile."""
    row = tile // tiles_in_row(grid)
    return row, (tile - row * tiles_in_row(grid)) * LANE_COUNT


@inlined
def base_cell(x, grid):
    """Return the base cell along one axis of a place in m."""
    return int(np.floor((x - grid.origin) / grid.cell_size - grid.half_length))


@inlined
def is_on_grid(x, y, grid):
    """Return whether the 3 x 3 nodes of a place exist, as up to a cell beyond a wall; those of NaN do not."""
    xi = (x - grid.origin) / grid.cell_size - grid.half_length
    yi = (y - grid.origin) / grid.cell_size - grid.half_length
    return xi >= 0.0 and xi < grid.base_columns and yi >= 0.0 and yi < grid.rows - 2


@inlined
def take(tiles, block):
    """Return the particles of a block as lanes."""
    k, blocks = block * BLOCK, tiles.blocks
    return Particles(
        load(blocks, k + X * LANE_COUNT),
        load(blocks, k + Y * LANE_COUNT),
        load(blocks, k + VELOCITY_X * LANE_COUNT),
        load(blocks, k + VELOCITY_Y * LANE_COUNT),
        load(blocks, k + MASS * LANE_COUNT),
        load(blocks, k + VOLUME * LANE_COUNT),
        load(blocks, k + STRESS_XX * LANE_COUNT),
        load(blocks, k + STRESS_YY * LANE_COUNT),
        load(blocks, k + STRESS_ZZ * LANE_COUNT),
        load(blocks, k + STRESS_XY * LANE_COUNT),
        load(blocks, k + PLASTIC_STRAIN * LANE_COUNT),
        load(blocks, k + COHESION * LANE_COUNT),
        load(blocks, k + FRICTION_ANGLE * LANE_COUNT),
        load(blocks, k + COHESION_RESIDUAL * LANE_COUNT),
        load(blocks, k + FRICTION_ANGLE_RESIDUAL * LANE_COUNT),
        load(blocks, k + PORE_AREA * LANE_COUNT),
        load(blocks, k + PORE_PRESSURE * LANE_COUNT),
        load(blocks, k + MATERIAL * LANE_COUNT),
    )


@inlined
def get(tiles, block, field):
    """Return one field of a block as lanes."""
    return load(tiles.blocks, block * BLOCK + field * LANE_COUNT)


@inlined
def put(tiles, block, field, value):
    """Set one field of a block."""
    store(tiles.blocks, block * BLOCK + field * LANE_COUNT, value)


@inlined
def empty_lane(blocks, block, lane, row, column, grid):
    """Leave nothing in a lane, whose base cell is at ``row``, ``column``."""
    for field in range(FIELDS):
        blocks[block, field, lane] = 0.0
    blocks[block, X, lane] = grid.origin + (column + MIDDLE) * grid.cell_size
    blocks[block, Y, lane] = grid.origin + (row + MIDDLE) * grid.cell_size
    blocks[block, MOVED_X, lane] = blocks[block, X, lane]
    blocks[block, MOVED_Y, lane] = blocks[block, Y, lane]
    blocks[block, COHESION, lane] = UNYIELDING


@inlined
def empty_block(blocks, block, row, column, grid):
    """Leave nothing in a block of the tile whose base cells are at ``row``, from ``column`` on."""
    for lane in range(LANE_COUNT):
        empty_lane(blocks, block, lane, row, column + lane, grid)


@inlined
def add_block(tiles, tile, row, column, grid):
    """Put an empty block at the head of a tile's chain; return it."""
    block = tiles.counts[USED]
    tiles.counts[USED] += 1
    empty_block(tiles.blocks, block, row, column, grid)
    tiles.following[block] = tiles.first[tile]
    tiles.first[tile] = block
    tiles.tile[block] = tile
    return block
