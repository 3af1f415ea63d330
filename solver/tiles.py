"""Particles in blocks of eight, so that eight neighbours in a row are the lanes of a vector.

The *base cell* of a particle is the lower left of its 3 x 3 nodes. A *tile* is eight neighbouring base cells of a row.
A *block* holds at most one particle of each: lane ``l`` is one of base cell ``l``. So the nodes that lane ``l`` touches
stand one place to the right of those of lane ``l - 1``, and a transfer between a block and a row of nodes is three
vectors of eight neighbouring nodes: no gather, no conflict. A tile has as many blocks as its fullest cell has
particles, in a chain.

An empty lane has no mass, no volume and no stress, and stands in the middle of its cell. A particle that leaves its
base cell is taken out and put into a hole of its new tile, or into a new block. That happens to few in a step, so it is
done one by one, in order: a run is the same, bit for bit, each time.
"""

from typing import NamedTuple

import numpy as np

from solver._jit import inlined, kernel
from solver.constants import LANE_COUNT
from solver.lanes import bits, lane_numbers, load, store
from solver.particles import UNYIELDING, Particles

# Fields of a block: those of the particles in their order, then what a step keeps until it ends.
X, Y, VELOCITY_X, VELOCITY_Y, MASS, VOLUME, STRESS_XX, STRESS_YY, STRESS_ZZ, STRESS_XY, PLASTIC_STRAIN = range(11)
COHESION, FRICTION_ANGLE, COHESION_RESIDUAL, FRICTION_ANGLE_RESIDUAL, MATERIAL = range(11, 16)
NUMBER = 16  # of the particle
MOVED_X, MOVED_Y = 17, 18  # m, places at the end of the step
INCREMENT_XX, INCREMENT_XY, INCREMENT_YX, INCREMENT_YY = 19, 20, 21, 22  # displacement gradient of the step
PLASTIC_INCREMENT = 23  # of the plastic strain, until it is averaged
FIELDS = 24

BLOCK = FIELDS * LANE_COUNT
USED, LEAVERS = 0, 1  # entries of ``Tiles.counts``: blocks in use, particles that have left their base cell
STEPS_BETWEEN_SORTS = 64
MIDDLE = 0.75  # of the place of an empty lane, in cells from its base node: it touches no third node


class Tiles(NamedTuple):
    """Particles in blocks, and their tiles, numbered row by row."""

    blocks: np.ndarray  # (capacity, FIELDS, 8)
    following: np.ndarray  # (capacity,) the next block of the same tile, -1 after the last
    first: np.ndarray  # (rows * tiles in a row,) the first block of a tile, -1 if it is empty
    tile: np.ndarray  # (capacity,) the tile of a block
    gone: np.ndarray  # (capacity,) lanes that have left their base cells in this step, as bits
    leavers: np.ndarray  # (n, FIELDS) their particles
    counts: np.ndarray  # (2,)


class TileStore(NamedTuple):
    """Room for the blocks of ``n`` particles."""

    blocks: np.ndarray
    following: np.ndarray
    tile: np.ndarray
    gone: np.ndarray
    leavers: np.ndarray
    cell: np.ndarray  # (n,) flat number of the base cell of a particle
    rank: np.ndarray  # (n,) how many particles of the same base cell come before


def allocate_tiles(n_particles: int) -> TileStore:
    """Return room for ``n_particles``, aligned with the lines of the cache.

    A block has at least one particle after they are sorted, and a step adds at most one block for each. What is not
    used is never touched, so that it takes no memory.
    """
    capacity = 2 * n_particles + 1
    room = np.empty(capacity * BLOCK + LANE_COUNT)
    start = -(room.ctypes.data // room.itemsize) % LANE_COUNT
    return TileStore(
        blocks=room[start : start + capacity * BLOCK].reshape(capacity, FIELDS, LANE_COUNT),
        following=np.empty(capacity, np.int64),
        tile=np.empty(capacity, np.int64),
        gone=np.empty(capacity, np.int64),
        leavers=np.empty((n_particles, FIELDS)),
        cell=np.empty(n_particles, np.int64),
        rank=np.empty(n_particles, np.int64),
    )


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
def empty_lane(tiles, block, lane, row, column, grid):
    """Leave nothing in a lane, whose base cell is at ``row``, ``column``."""
    for field in range(FIELDS):
        tiles.blocks[block, field, lane] = 0.0
    tiles.blocks[block, X, lane] = grid.origin + (column + MIDDLE) * grid.cell_size
    tiles.blocks[block, Y, lane] = grid.origin + (row + MIDDLE) * grid.cell_size
    tiles.blocks[block, MOVED_X, lane] = tiles.blocks[block, X, lane]
    tiles.blocks[block, MOVED_Y, lane] = tiles.blocks[block, Y, lane]
    tiles.blocks[block, COHESION, lane] = UNYIELDING


@inlined
def empty_block(tiles, block, row, column, grid):
    """Leave nothing in a block of the tile whose base cells are at ``row``, from ``column`` on."""
    tiles.gone[block] = 0
    for lane in range(LANE_COUNT):
        empty_lane(tiles, block, lane, row, column + lane, grid)


@kernel
def fill_tiles(particles, grid, store):
    """Return the particles (n,) in blocks, sorted by base cell; all must be on the grid.

    Parameters
    ----------
    particles : Particles (n,)
    grid : Grid
    store : TileStore
        Its arrays become those of the tiles.
    """
    n = particles.x.size
    crowd = np.zeros(grid.rows * grid.columns, np.int64)
    for p in range(n):
        cell = base_cell(particles.y[p], grid) * grid.columns + base_cell(particles.x[p], grid)
        store.cell[p], store.rank[p] = cell, crowd[cell]
        crowd[cell] += 1
    first = np.full(grid.rows * tiles_in_row(grid), -1, np.int64)
    tiles = Tiles(store.blocks, store.following, first, store.tile, store.gone, store.leavers, np.zeros(2, np.int64))
    for tile in range(first.size):
        row, column = place_of(tile, grid)
        cell = row * grid.columns + column
        for _ in range(crowd[cell : cell + LANE_COUNT].max()):
            add_block(tiles, tile, row, column, grid)
    for p in range(n):
        row, column = divmod(store.cell[p], grid.columns)
        block = first[row * tiles_in_row(grid) + column // LANE_COUNT] - store.rank[p]
        at = tiles.blocks[block, :, column % LANE_COUNT]
        at[X], at[Y] = particles.x[p], particles.y[p]
        at[VELOCITY_X], at[VELOCITY_Y] = particles.velocity_x[p], particles.velocity_y[p]
        at[MASS], at[VOLUME] = particles.mass[p], particles.volume[p]
        at[STRESS_XX], at[STRESS_YY] = particles.stress_xx[p], particles.stress_yy[p]
        at[STRESS_ZZ], at[STRESS_XY] = particles.stress_zz[p], particles.stress_xy[p]
        at[PLASTIC_STRAIN], at[MATERIAL] = particles.plastic_strain[p], particles.material[p]
        at[COHESION], at[COHESION_RESIDUAL] = particles.cohesion[p], particles.cohesion_residual[p]
        at[FRICTION_ANGLE] = particles.friction_angle[p]
        at[FRICTION_ANGLE_RESIDUAL] = particles.friction_angle_residual[p]
        at[NUMBER] = p
    return tiles


@inlined
def add_block(tiles, tile, row, column, grid):
    """Put an empty block at the head of a tile's chain."""
    block = tiles.counts[USED]
    tiles.counts[USED] += 1
    empty_block(tiles, block, row, column, grid)
    tiles.following[block] = tiles.first[tile]
    tiles.first[tile] = block
    tiles.tile[block] = tile


@inlined
def write_back(at, particles):
    """Give a particle what a step has changed, from its ``FIELDS``."""
    p = int(at[NUMBER])
    particles.x[p], particles.y[p] = at[X], at[Y]
    particles.velocity_x[p], particles.velocity_y[p] = at[VELOCITY_X], at[VELOCITY_Y]
    particles.volume[p], particles.plastic_strain[p] = at[VOLUME], at[PLASTIC_STRAIN]
    particles.stress_xx[p], particles.stress_yy[p] = at[STRESS_XX], at[STRESS_YY]
    particles.stress_zz[p], particles.stress_xy[p] = at[STRESS_ZZ], at[STRESS_XY]


@kernel
def empty_tiles(tiles, particles):
    """Give the particles (n,) the state that they have in the tiles, or that they left the grid with."""
    for block in range(tiles.counts[USED]):
        for lane in range(LANE_COUNT):
            if tiles.blocks[block, MASS, lane] > 0.0:
                write_back(tiles.blocks[block, :, lane], particles)
    for leaver in range(tiles.counts[LEAVERS]):
        write_back(tiles.leavers[leaver], particles)


@kernel
def sort_again(tiles, particles, grid, store):
    """Return the particles (n,) in blocks without holes; arguments are those of ``fill_tiles``."""
    empty_tiles(tiles, particles)
    return fill_tiles(particles, grid, store)


@kernel
def sort_if_due(tiles, step, particles, grid, store):
    """Return the same now and then, by the number of the step, and where the room for blocks runs out."""
    is_due = step % STEPS_BETWEEN_SORTS == STEPS_BETWEEN_SORTS - 1 or tiles.counts[USED] > particles.x.size
    return sort_again(tiles, particles, grid, store) if is_due else tiles


@inlined
def note_leavers(tiles, block, x, y, is_there, row, column, grid):
    """Note which particles of a block, now at ``x``, ``y`` (m), are no longer in their base cells.

    A place that is not a number is in no cell.
    """
    right = (x - grid.origin) * (1.0 / grid.cell_size) - grid.half_length - (lane_numbers() + float(column))
    up = (y - grid.origin) * (1.0 / grid.cell_size) - grid.half_length - float(row)
    stay = (right >= 0.0) & (right < 1.0) & (up >= 0.0) & (up < 1.0)
    tiles.gone[block] = bits(is_there) & ~bits(stay)


@kernel
def change_tiles(tiles, grid):
    """Put the particles that have left their base cells into their new tiles; return whether all are on the grid."""
    take_out_leavers(tiles, grid)
    while tiles.counts[LEAVERS] > 0:
        if not settle(tiles, tiles.leavers[tiles.counts[LEAVERS] - 1], grid):
            return False
        tiles.counts[LEAVERS] -= 1
    return True


@kernel
def take_out_leavers(tiles, grid):
    """Move the particles that are noted as gone from their blocks to the leavers."""
    leaver = 0
    for block in range(tiles.counts[USED]):
        if tiles.gone[block]:
            row, column = place_of(tiles.tile[block], grid)
            for lane in range(LANE_COUNT):
                if (tiles.gone[block] >> lane) & 1:
                    tiles.leavers[leaver] = tiles.blocks[block, :, lane]
                    leaver += 1
                    empty_lane(tiles, block, lane, row, column + lane, grid)
            tiles.gone[block] = 0
    tiles.counts[LEAVERS] = leaver


@inlined
def settle(tiles, fields, grid):
    """Put a particle, as its ``FIELDS``, into the tile of its place; return whether that is on the grid."""
    if not is_on_grid(fields[X], fields[Y], grid):
        return False
    row, column = base_cell(fields[Y], grid), base_cell(fields[X], grid)
    tile, lane = row * tiles_in_row(grid) + column // LANE_COUNT, column % LANE_COUNT
    block = tiles.first[tile]
    while block >= 0 and tiles.blocks[block, MASS, lane] > 0.0:
        block = tiles.following[block]
    if block < 0:
        add_block(tiles, tile, row, column - lane, grid)
        block = tiles.first[tile]
    tiles.blocks[block, :, lane] = fields
    return True
