"""Pore pressure that follows the ground.

Stresses of particles are effective, and what pushes the nodes is the total stress, ``sigma - u``. A slide takes seconds
and does not drain: each particle keeps the ratio ``r`` of its pore pressure to the weight of the ground above it, so
that the pressure falls where the slide thins and rises where it is overridden, ``u_p = r_p sum_i S_ip W_i``. The
overburden ``W_i`` of a node is the weight of the column above it, of the masses of the nodes there and half its own:

    W_i = g / h (m_i / 2 + sum_k>i m_k)

which under level ground is ``gamma d`` from a cell below the surface on. Pore pressures depend on places and not on
strains, so they neither stiffen the ground nor shorten its steps. ``r`` is that of the drawn water before the slide, by
the same sum, so that the pore pressure is the drawn one there.
"""

from solver._jit import inlined, kernel
from solver.constants import LANE_COUNT, STANDARD_GRAVITY
from solver.filling import ground_of
from solver.lanes import load, splat, store
from solver.model import Model
from solver.overburden import overburden
from solver.particles import Particles
from solver.sorting import fill_tiles, read_tiles
from solver.spread import spread_each
from solver.tiles import PORE_PRESSURE, allocate_tiles, place_of, put, take
from solver.transfer import nine, weights_of
from solver.water import NO_WATER


@inlined
def find_overburden(grid, gravity):
    """Set the weight of the ground above each node, under ``gravity`` in m/s2, from the masses of the nodes."""
    factor = gravity / grid.cell_size
    for column in range(0, grid.columns, LANE_COUNT):
        above = splat(0.0)
        for row in range(grid.rows - 1, -1, -1):
            node = row * grid.columns + column
            weight = factor * load(grid.mass, node)
            store(grid.overburden, node, above + 0.5 * weight)
            above = above + weight


@inlined
def pore_pressure_of(p, row, column, w, grid):
    """Return the pore pressure in Pa of a block of particles under the overburden of the nodes."""
    return p.pore_pressure_ratio * nine(grid.overburden, row * grid.columns + column, grid.columns, w.sx, w.sy)


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
    """Return the particles of a model on their lattice, with the pore pressure that is drawn and their share of it."""
    ground = ground_of(model)
    if model.water == NO_WATER:
        return ground
    drawn = model.water.pore_pressure(ground.x, ground.y, overburden(model, ground.x, ground.y))
    ground.pore_pressure_ratio[:] = 1.0
    grid = model.allocate_grid()
    tiles = fill_tiles(ground, grid, allocate_tiles(ground.x.size))
    find_pore_pressures(tiles, grid, STANDARD_GRAVITY)
    read_tiles(tiles, ground)
    ground.pore_pressure_ratio[:] = drawn / ground.pore_pressure
    ground.pore_pressure[:] = drawn
    return ground
