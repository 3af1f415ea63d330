"""Pore pressure that follows the ground.

Stresses of particles are effective, and what pushes the nodes is the total stress, ``sigma - u``. A slide takes seconds
and does not drain: each particle keeps the ratio ``r`` of its pore pressure to the weight of the ground above it, so
that the pressure falls where the slide thins and rises where it is overridden, ``u_p = r_p sum_i S_ip W_i``. The
overburden ``W_i`` of a node is the weight of the column above it, of the masses of the nodes there and half its own,
over the width ``h`` of a cell (half of it at a wall, and all of its own at the base):

    W_i = g / h (m_i / 2 + sum_k>i m_k)

which under level ground is ``gamma d`` from a cell below the surface on. ``r`` is that of the drawn water before the
slide, by the same sum, so that the pore pressure is the drawn one there. Pore pressures depend on places and volumes
and not on stresses, so they neither stiffen the ground nor shorten its steps. Ground that comes apart takes in air:
pore water carries the same area of a particle however large it becomes, ``r_p V_p`` stays, or its pressure would drive
on what it has driven apart.

Where water stands over the ground, it loads the pore water in full: the pressure is ``r_p W_p`` and that of the
standing water on the surface. In excess of the standing water at the place itself (``standing_water``), which is larger
by the uplift of the ground above, it is ``u_p = r_p W_p - U_p``.
"""

import numpy as np

from solver._jit import inlined, kernel
from solver.constants import LANE_COUNT, STANDARD_GRAVITY
from solver.filling import ground_of
from solver.grid import PADDING
from solver.lanes import lane_numbers, load, splat, store, where
from solver.mean_dilation import NO_VOLUME
from solver.model import Model
from solver.overburden import overburden
from solver.particles import Particles, copy_particles
from solver.sorting import fill_tiles, read_tiles
from solver.spread import spread_each
from solver.standing_water import uplift_of
from solver.tiles import PORE_PRESSURE, allocate_tiles, place_of, put, take
from solver.transfer import nine, weights_of
from solver.water import NO_WATER


@inlined
def find_overburden(grid, gravity):
    """Set the weight of the ground above each node, under ``gravity`` in m/s2, from the masses of the nodes."""
    for column in range(0, grid.columns, LANE_COUNT):
        i = lane_numbers() + float(column - PADDING)
        is_wall = (i == 0.0) | (i == float(round(grid.width / grid.cell_size)))
        factor = where(is_wall, 2.0, 1.0) * (gravity / grid.cell_size)
        above = splat(0.0)
        for row in range(grid.rows - 1, -1, -1):
            node = row * grid.columns + column
            weight = factor * load(grid.mass, node)
            own_share = 1.0 if row == PADDING else 0.5  # the ground of a node of the base lies above it
            store(grid.overburden, node, above + own_share * weight)
            above = above + weight


@inlined
def pore_pressure_of(p, row, column, w, grid):
    """Return the pore pressure in Pa of a block of particles under the ground above the nodes."""
    start = row * grid.columns + column
    overburden = nine(grid.overburden, start, grid.columns, w.sx, w.sy)
    return p.pore_area / max(p.volume, NO_VOLUME) * overburden - uplift_of(p.y, overburden, grid)


@kernel
def find_pore_pressures(tiles, grid, gravity):
    """Set the pore pressure of particles as they are."""
    spread_each(tiles, grid)
    find_overburden(grid, gravity)
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            p = take(tiles, block)
            w = weights_of(p.x, p.y, row, column, grid)
            put(tiles, block, PORE_PRESSURE, pore_pressure_of(p, row, column, w, grid))
            block = tiles.following[block]


def wet_ground_of(model: Model) -> Particles:
    """Return the particles of a model on their lattice, with the pore pressure that is drawn and their share of it.

    Particles near a face may lie under less ground than is drawn; their share is no larger than the drawn one.
    """
    ground, water = ground_of(model), model.water
    if water == NO_WATER:
        return ground
    weight = overburden(model, ground.x, ground.y)
    drawn = water.pore_pressure(ground.x, ground.y, weight)
    excess = drawn - water.standing_pressure(ground.y)
    on_surface = water.standing_pressure(model.surface.height_at(ground.x))
    of_nodes = _pore_pressures(ground, 1.0, model)
    uplift = -_pore_pressures(ground, 0.0, model)
    ratio = np.minimum((excess + uplift) / (of_nodes + uplift), (drawn - on_surface) / weight)
    ground.pore_area[:] = ratio * ground.volume
    ground.pore_pressure[:] = _pore_pressures(ground, ratio, model)
    return ground


def _pore_pressures(ground: Particles, ratio: np.ndarray | float, model: Model) -> np.ndarray:
    """Return the pore pressures (n,) in Pa that the particles would have with a ``ratio``."""
    grid, found = model.allocate_grid(), copy_particles(ground)
    found.pore_area[:] = ratio * found.volume
    tiles = fill_tiles(found, grid, allocate_tiles(ground.x.size))
    find_pore_pressures(tiles, grid, STANDARD_GRAVITY)
    read_tiles(tiles, found)
    return found.pore_pressure
