"""The operations of a time step between the transfers, on all nodes or on a block of eight particles (see ``step``)."""

from typing import NamedTuple

from solver._jit import inlined
from solver.constants import LANE_COUNT
from solver.grid import SMALLEST_MASS
from solver.lanes import bits, load, splat, store, where
from solver.leavers import is_in_base_cell, take_out
from solver.materials import deformed
from solver.standing_water import displaced_mass
from solver.tiles import (
    MOVED_X,
    MOVED_Y,
    STRESS_XX,
    STRESS_XY,
    STRESS_YY,
    STRESS_ZZ,
    VELOCITY_X,
    VELOCITY_Y,
    VOLUME,
    X,
    Y,
    get,
    put,
)

INTERNAL_WORK, GRAVITY_WORK = 0, 1  # entries of the energy ledger


@inlined
def clear_state(grid):
    """Empty the nodes before the particles spread their state to them."""
    nothing = splat(0.0)
    for row in range(grid.rows):
        for column in range(0, grid.columns, LANE_COUNT):
            node = row * grid.columns + column
            if bits(load(grid.mass, node) > 0.0):
                x = node + row * grid.columns
                store(grid.mass, node, nothing)
                store(grid.momentum, x, nothing)
                store(grid.momentum, x + grid.columns, nothing)
                store(grid.force, x, nothing)
                store(grid.force, x + grid.columns, nothing)


@inlined
def solve_momentum(grid, gravity, damping, dt):
    """Set nodal acceleration and the velocity at the end of the step from mass, momentum and force.

    Parameters
    ----------
    grid : Grid
        Its ``acceleration`` and ``velocity`` are set where eight neighbours are not all empty, and the ``remapped``
        momentum emptied.
    gravity : float
        Downward, in m/s2.
    damping : float
        Share of the unbalanced force that opposes the motion.
    dt : float
        In s.
    """
    for row in range(grid.rows):
        for column in range(0, grid.columns, LANE_COUNT):
            node = row * grid.columns + column
            x = node + row * grid.columns
            mass = load(grid.mass, node)
            if bits(mass > 0.0):
                has_mass = mass > SMALLEST_MASS
                inverse = where(has_mass, 1.0 / mass, 0.0)
                weight = where(has_mass, splat(gravity), 0.0)
                _solve(grid, x, load(grid.free_x, node), inverse, splat(0.0), damping, dt)
                _solve(grid, x + grid.columns, load(grid.free_y, node), inverse, weight, damping, dt)


@inlined
def _solve(grid, at, free, inverse, gravity, damping, dt):
    """Solve one component of eight nodes; ``at`` is their flat index in vector fields."""
    v = load(grid.momentum, at) * inverse
    a = load(grid.force, at) * inverse - gravity
    a = a - damping * abs(a) * sign(v)
    store(grid.acceleration, at, a * free)
    store(grid.velocity, at, (v + a * dt) * free)
    store(grid.remapped, at, splat(0.0))


@inlined
def sign(v):
    """Return 1, 0 or -1."""
    return where(v > 0.0, splat(1.0), where(v < 0.0, splat(-1.0), 0.0))


@inlined
def remap_velocity(grid):
    """Turn remapped momentum into velocity that respects the walls."""
    for row in range(grid.rows):
        for column in range(0, grid.columns, LANE_COUNT):
            node = row * grid.columns + column
            mass = load(grid.mass, node)
            has_mass = mass > SMALLEST_MASS
            if bits(has_mass):
                x, y = node + row * grid.columns, node + (row + 1) * grid.columns
                inverse = where(has_mass, 1.0 / mass, 0.0)
                store(grid.remapped, x, load(grid.remapped, x) * inverse * load(grid.free_x, node))
                store(grid.remapped, y, load(grid.remapped, y) * inverse * load(grid.free_y, node))


@inlined
def accelerate_block(tiles, block, particles, acceleration, velocity, flip_fraction, dt):
    """Accelerate a block of particles and note where they will be at the end of the step; return their new velocity.

    Parameters
    ----------
    tiles : Tiles
        Modified.
    block : int
    particles : Particles
        Its lanes.
    acceleration, velocity : tuple of 2 lanes
        Of the nodes, at the particles; m/s2 and m/s.
    flip_fraction : float
        1 FLIP, 0 PIC.
    dt : float
        In s.
    """
    is_there = particles.mass > 0.0
    v_x, v_y = velocity
    put(tiles, block, MOVED_X, where(is_there, particles.x + v_x * dt, particles.x))
    put(tiles, block, MOVED_Y, where(is_there, particles.y + v_y * dt, particles.y))
    flip_x = particles.velocity_x + acceleration[0] * dt
    flip_y = particles.velocity_y + acceleration[1] * dt
    new_x = flip_fraction * flip_x + (1.0 - flip_fraction) * v_x
    new_y = flip_fraction * flip_y + (1.0 - flip_fraction) * v_y
    put(tiles, block, VELOCITY_X, new_x)
    put(tiles, block, VELOCITY_Y, new_y)
    return new_x, new_y


@inlined
def deform_block(tiles, block, particles, increment, laws, dt):
    """Update stress and volume of a block of particles; return what became of them (``Deformed``).

    Parameters
    ----------
    tiles : Tiles
        Modified, but for the plastic strain.
    block : int
    particles : Particles
        Its lanes.
    increment : tuple of 4 lanes
        Displacement gradients ``L dt``: xx, xy, yx, yy.
    laws : tuple of NamedTuple
        Parameters of the law of each material.
    dt : float
        In s.
    """
    new = deformed(particles, increment, laws, dt)
    put(tiles, block, STRESS_XX, new.stress_xx)
    put(tiles, block, STRESS_YY, new.stress_yy)
    put(tiles, block, STRESS_ZZ, new.stress_zz)
    put(tiles, block, STRESS_XY, new.stress_xy)
    put(tiles, block, VOLUME, new.volume)
    return new


class Moved(NamedTuple):
    """Particles after they have moved; lanes."""

    x: float  # m
    y: float
    stays: bool  # in its base cell
    fall: float  # kg m, loss of height times mass, less that of the water displaced


@inlined
def move_block(tiles, block, particles, row, column, grid):
    """Put a block of particles at their new places; those that leave their base cells are taken out.

    Parameters
    ----------
    tiles : Tiles
        Modified.
    block : int
    particles : Particles
        Its lanes.
    row, column : int
        Of the base cell of the first lane.
    grid : Grid
    """
    x, y = get(tiles, block, MOVED_X), get(tiles, block, MOVED_Y)
    put(tiles, block, X, x)
    put(tiles, block, Y, y)
    stays = is_in_base_cell(x, y, row, column, grid)
    take_out(tiles, block, particles.mass > 0.0, stays, row, column, grid)
    submerged_mass = particles.mass - displaced_mass(particles, grid)
    return Moved(x, y, stays, submerged_mass * (particles.y - y))
