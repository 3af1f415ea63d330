"""One explicit GIMP time step, and many of them.

The modified update-stress-last step (MUSL; Sulsky, Zhou and Schreyer 1995, Nairn 2003), with the weights of the places
``x_p`` at the start of the step until the particles move, last of all:

    1  m_i = S_ip m_p,  (mv)_i = S_ip m_p v_p,  f_i = -V_p sigma_p . grad S_ip       spread_all
    2  a_i = f_i / m_i + g,  v_i = (mv)_i / m_i + a_i dt,  walls                     solve_momentum
    3  v_p <- v_p + S_ip a_i dt                                                      accelerate_block
    4  v_i <- S_ip m_p v_p / m_i,  walls                                             remap_velocity
    5  L_p = v_i (x) grad S_ip,  sigma_p <- law(sigma_p, L_p dt),  V_p               deform_block
    6  x_p <- x_p + S_ip v_i(2) dt                                                   move_block

Update-stress-last (USL) leaves out 4; update-stress-first (USF) moves before 4. Particles are in blocks of eight
(``tiles``) that are treated at once (``lanes``). A step is two passes over the tiles: one for 3 and 4, and one for 5, 6
and, while a tile is at hand, 1 of the next step (``deformation``); the few particles that have left their cells follow
one by one (``leavers``). Means over cells, against locking (``mean_dilation``) or of the plastic strain that softens
(``nonlocal_softening``), need all particles at two places more, each of which takes another pass. What happens to a
block or to the nodes in between is in ``operations`` and ``transfer``; here it is put together.

All kernels take the ``tiles`` of the particles and the nodes of ``grid``, and modify them; ``laws``, a tuple with the
parameters of each material; a ``scheme``; gravity downward in m/s2; ``dt`` in s.
"""

from typing import Any, NamedTuple

import numpy as np

from solver._jit import kernel, sweep
from solver.constants import LANE_COUNT
from solver.deformation import deform, move_each
from solver.grid import Grid
from solver.lanes import load, store
from solver.operations import accelerate_block, remap_velocity, solve_momentum
from solver.particles import Particles
from solver.pore_pressure import find_overburden, pore_pressure_of
from solver.scheme import MUSL, USF, AnyScheme
from solver.sorting import fill_tiles, read_tiles, sort_if_due
from solver.spread import spread_all, spread_each
from solver.tiles import LEAVERS, PORE_PRESSURE, SORTS, Tiles, after_sorts, allocate_tiles, place_of, put, take
from solver.transfer import add_momentum, deposit_momentum, interpolate, no_momentum, weights_of
from solver.water import GRAVITY


class Workspace(NamedTuple):
    """Room for the tiles of a march, and the energy ledger it keeps."""

    tiles: Tiles
    ledger: np.ndarray  # (2,) J/m: work of the stresses, work of gravity


def allocate_workspace(n_particles: int) -> Workspace:
    """Return scratch space for ``n_particles`` with an empty ledger."""
    return Workspace(allocate_tiles(n_particles), np.zeros(2))


@sweep
def accelerate_each(tiles, grid, scheme, dt):
    """Operation 3, the transfer of 4 where the stress is updated last, modified, and the pore pressures."""
    remaps = scheme.stress_update == MUSL
    for tile in range(tiles.first.size):
        block = tiles.first[tile]
        if block < 0:
            continue
        row, column = place_of(tile, grid)
        sums = no_momentum()
        while block >= 0:
            p = take(tiles, block)
            w = weights_of(p.x, p.y, row, column, grid)
            acceleration = interpolate(grid.acceleration, row, column, w, grid)
            velocity = interpolate(grid.velocity, row, column, w, grid)
            v_x, v_y = accelerate_block(tiles, block, p, acceleration, velocity, scheme.flip_fraction, dt)
            sums = add_momentum(sums, w, p.mass * v_x, p.mass * v_y)
            if grid.has_water:
                put(tiles, block, PORE_PRESSURE, pore_pressure_of(p, row, column, w, grid))
            block = tiles.following[block]
        if remaps:
            deposit_momentum(grid.remapped, row, column, sums, grid)


@sweep
def accelerate(tiles, grid, work, scheme, gravity, dt):
    """Operations 3 and 4; return whether all particles are on the grid."""
    accelerate_each(tiles, grid, scheme, dt)
    if scheme.stress_update == USF:
        if not move_each(tiles, grid, gravity, work.ledger):
            return False
        spread_each(tiles, grid)  # mass and momentum; means over cells follow
        for k in range(0, grid.momentum.size, LANE_COUNT):
            store(grid.remapped, k, load(grid.momentum, k))
    remap_velocity(grid)
    return True


def take_steps(tiles, grid, work, laws, scheme, gravity, gravity_rate, dt, steps, are_new):
    """Take ``steps`` time steps; return the tiles, and how many were taken, as ``advance`` does.

    Parameters
    ----------
    tiles : Tiles
        Modified.
    grid : Grid
        Afterwards with mass, momentum and force of the particles in the tiles.
    work, laws, scheme, gravity, gravity_rate, dt, steps
        As of ``advance``.
    are_new : bool
        The tiles have just been filled, and the grid does not know of the particles yet.
    """
    taken = _take_steps(tiles, grid, work, laws, scheme, gravity, gravity_rate, dt, steps, are_new)
    return after_sorts(tiles), taken


@kernel
def _take_steps(tiles, grid, work, laws, scheme, gravity, gravity_rate, dt, steps, are_new):
    tiles.counts[SORTS] = 0
    grid.lake[GRAVITY] = gravity
    if are_new:
        spread_all(tiles, grid, scheme)
    taken = 0
    are_all_there = tiles.counts[LEAVERS] == 0
    while taken < steps and are_all_there:
        tiles = sort_if_due(tiles, grid)
        g = gravity + gravity_rate * (taken + 0.5) * dt
        solve_momentum(grid, g, scheme.damping, dt)
        if grid.has_water:
            grid.lake[GRAVITY] = g
            find_overburden(grid, g)
        are_all_there = accelerate(tiles, grid, work, scheme, g, dt) and deform(
            tiles, grid, work.ledger, laws, scheme, g, dt
        )
        taken += are_all_there
    return taken


def advance(
    particles: Particles,
    grid: Grid,
    work: Workspace,
    laws: tuple[Any, ...],
    scheme: AnyScheme,
    gravity: float,
    gravity_rate: float,
    dt: float,
    steps: int,
) -> int:
    """Take ``steps`` time steps; return how many were taken, fewer if a particle left the grid in the next one.

    Parameters
    ----------
    particles : Particles (n,)
        Modified.
    grid : Grid
        Afterwards its mass, momentum and force are those of the particles.
    work : Workspace
        Its ledger goes on.
    laws : tuple of NamedTuple
        Parameters of the law of each material.
    scheme : Scheme
    gravity, gravity_rate : float
        Downward, at the start in m/s2, and its growth in m/s3.
    dt : float
        In s.
    steps : int
    """
    tiles = fill_tiles(particles, grid, work.tiles)
    tiles, taken = take_steps(tiles, grid, work, laws, scheme, gravity, gravity_rate, dt, steps, True)
    read_tiles(tiles, particles)
    return int(taken)
