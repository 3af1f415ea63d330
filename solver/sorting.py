"""Particles are put into tiles, sorted there, and read back.

Blocks fill with holes as particles go from tile to tile, and chains scatter over the memory, so now and then all blocks
are copied in the order of the tiles.
"""

import numpy as np

from solver._jit import allocating, inlined, kernel
from solver.constants import LANE_COUNT
from solver.leavers import settle_next
from solver.tiles import (
    COHESION,
    COHESION_RESIDUAL,
    FIELDS,
    FRICTION_ANGLE,
    FRICTION_ANGLE_RESIDUAL,
    LEAVERS,
    MASS,
    MATERIAL,
    NUMBER,
    PLASTIC_STRAIN,
    PORE_AREA,
    PORE_PRESSURE,
    SORTS,
    STEPS,
    STRESS_XX,
    STRESS_XY,
    STRESS_YY,
    STRESS_ZZ,
    USED,
    VELOCITY_X,
    VELOCITY_Y,
    VOLUME,
    Tiles,
    X,
    Y,
    after_sorts,
    empty_block,
    place_of,
    tiles_in_row,
)

STEPS_BETWEEN_SORTS = 64


def fill_tiles(particles, grid, room):
    """Return the particles (n,) in blocks, sorted by base cell; who is not on the grid is a leaver.

    Parameters
    ----------
    particles : Particles (n,)
    grid : Grid
    room : Tiles
        What ``allocate_tiles`` or an earlier call returned; its arrays become those of the tiles.
    """
    tiles = room._replace(first=np.full(grid.rows * tiles_in_row(grid), -1, np.int64))
    _fill_tiles(particles, grid, tiles)
    return after_sorts(tiles)


@kernel
def _fill_tiles(particles, grid, tiles):
    tiles.counts[LEAVERS] = tiles.counts[USED] = tiles.counts[SORTS] = 0
    for p in range(particles.x.size):
        fields = tiles.leavers[tiles.counts[LEAVERS]]
        for field in range(FIELDS):
            fields[field] = 0.0
        fields[X], fields[Y] = particles.x[p], particles.y[p]
        fields[VELOCITY_X], fields[VELOCITY_Y] = particles.velocity_x[p], particles.velocity_y[p]
        fields[MASS], fields[VOLUME] = particles.mass[p], particles.volume[p]
        fields[STRESS_XX], fields[STRESS_YY] = particles.stress_xx[p], particles.stress_yy[p]
        fields[STRESS_ZZ], fields[STRESS_XY] = particles.stress_zz[p], particles.stress_xy[p]
        fields[PLASTIC_STRAIN], fields[MATERIAL] = particles.plastic_strain[p], particles.material[p]
        fields[COHESION], fields[COHESION_RESIDUAL] = particles.cohesion[p], particles.cohesion_residual[p]
        fields[FRICTION_ANGLE] = particles.friction_angle[p]
        fields[FRICTION_ANGLE_RESIDUAL] = particles.friction_angle_residual[p]
        fields[PORE_AREA] = particles.pore_area[p]
        fields[PORE_PRESSURE] = particles.pore_pressure[p]
        fields[NUMBER] = p
        tiles.counts[LEAVERS] += 1
        settle_next(tiles, grid)
    sorted_tiles(tiles, grid)


@allocating
def sorted_tiles(tiles, grid):
    """Return the same particles in blocks in the order of the tiles, without holes."""
    used = 0
    filled = np.empty(LANE_COUNT, np.int64)  # blocks of the tile in which a lane has its particle already
    for tile in range(tiles.first.size):
        start, block = used, tiles.first[tile]
        row, column = place_of(tile, grid)
        for lane in range(LANE_COUNT):
            filled[lane] = start
        while block >= 0:
            for lane in range(LANE_COUNT):
                if tiles.blocks[block, MASS, lane] > 0.0:
                    if filled[lane] == used:
                        empty_block(tiles.spare, used, row, column, grid)
                        tiles.tile[used] = tile
                        used += 1
                    for field in range(FIELDS):
                        tiles.spare[filled[lane], field, lane] = tiles.blocks[block, field, lane]
                    filled[lane] += 1
            block = tiles.following[block]
        tiles.first[tile] = start if used > start else -1
    for block in range(used):
        is_last = block == used - 1 or tiles.tile[block + 1] != tiles.tile[block]
        tiles.following[block] = -1 if is_last else block + 1
    tiles.counts[USED], tiles.counts[STEPS] = used, 0
    tiles.counts[SORTS] += 1
    return Tiles(tiles.spare, tiles.blocks, tiles.following, tiles.first, tiles.tile, tiles.leavers, tiles.counts)


@allocating
def sort_if_due(tiles, grid):
    """Return the tiles for the next step: sorted now and then, and where the room for blocks runs out."""
    is_due = tiles.counts[STEPS] == STEPS_BETWEEN_SORTS or 2 * tiles.counts[USED] > tiles.blocks.shape[0]
    tiles.counts[STEPS] += 1
    return sorted_tiles(tiles, grid) if is_due else tiles


@inlined
def write_back(at, particles):
    """Give a particle what steps have changed, from its ``FIELDS``."""
    p = int(at[NUMBER])
    particles.x[p], particles.y[p] = at[X], at[Y]
    particles.velocity_x[p], particles.velocity_y[p] = at[VELOCITY_X], at[VELOCITY_Y]
    particles.volume[p], particles.plastic_strain[p] = at[VOLUME], at[PLASTIC_STRAIN]
    particles.stress_xx[p], particles.stress_yy[p] = at[STRESS_XX], at[STRESS_YY]
    particles.stress_zz[p], particles.stress_xy[p] = at[STRESS_ZZ], at[STRESS_XY]
    particles.pore_pressure[p] = at[PORE_PRESSURE]


@kernel
def read_tiles(tiles, particles):
    """Give the particles (n,) the state that they have in the tiles, or that they left the grid with."""
    for block in range(tiles.counts[USED]):
        for lane in range(LANE_COUNT):
            if tiles.blocks[block, MASS, lane] > 0.0:
                write_back(tiles.blocks[block, :, lane], particles)
    for leaver in range(tiles.counts[LEAVERS]):
        write_back(tiles.leavers[leaver], particles)
