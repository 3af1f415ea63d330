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
(``tiles``) that are treated at once (``lanes``). A step is three passes over the tiles: one for 3 and 4, one for 5 and
6 (``deformation``), and one for 1 of the next step (``spread``), after the few particles that have left their cells are
put into their new tiles. Means over cells, against locking (``mean_dilation``) or of the plastic strain that softens
(``nonlocal_softening``), need all particles at two places more, each of which takes another pass. What happens to a
block or to the nodes in between is in ``operations`` and ``transfer``; here it is put together.

All kernels take the ``tiles`` of the particles and the nodes of ``grid``, and modify them; ``laws``, a tuple with the
parameters of each material; a ``scheme``; gravity downward in m/s2; ``dt`` in s.
"""

from typing import NamedTuple

import numpy as np

from solver._jit import kernel
from solver.deformation import deform_cells, deform_each, move_each
from solver.operations import accelerate_block, remap_velocity, solve_momentum
from solver.scheme import MUSL, USF, USL, Scheme
from solver.spread import reads_cells, spread_all, spread_each
from solver.tiles import (
    TileStore,
    allocate_tiles,
    change_tiles,
    empty_tiles,
    fill_tiles,
    is_on_grid,
    place_of,
    sort_if_due,
    take,
)
from solver.transfer import add_momentum, deposit_momentum, interpolate, no_momentum, weights_of

WITHOUT_CELLS = Scheme(USF, 1.0, 0.0)


class Workspace(NamedTuple):
    """Room for the tiles of a march, and the energy ledger it keeps."""

    tiles: TileStore
    ledger: np.ndarray  # (2,) J/m: work of the stresses, work of gravity


def allocate_workspace(n_particles: int) -> Workspace:
    """Return scratch space for ``n_particles`` with an empty ledger."""
    return Workspace(allocate_tiles(n_particles), np.zeros(2))


@kernel
def accelerate_each(tiles, grid, scheme, dt):
    """Operation 3, and the transfer of 4 where the stress is updated last, modified."""
    remaps = scheme.stress_update == MUSL
    for tile in range(tiles.first.size):
        block = tiles.first[tile]
        if block < 0:
            continue
        row, column = place_of(tile, grid)
        low = middle = high = no_momentum()
        while block >= 0:
            p = take(tiles, block)
            w = weights_of(p.x, p.y, row, column, grid)
            acceleration = interpolate(grid.acceleration, row, column, w, grid)
            velocity = interpolate(grid.velocity, row, column, w, grid)
            v_x, v_y = accelerate_block(tiles, block, p, acceleration, velocity, scheme.flip_fraction, dt)
            low = add_momentum(low, w, 0, p.mass * v_x, p.mass * v_y)
            middle = add_momentum(middle, w, 1, p.mass * v_x, p.mass * v_y)
            high = add_momentum(high, w, 2, p.mass * v_x, p.mass * v_y)
            block = tiles.following[block]
        if remaps:
            deposit_momentum(grid.remapped, row, column, low, grid)
            deposit_momentum(grid.remapped, row + 1, column, middle, grid)
            deposit_momentum(grid.remapped, row + 2, column, high, grid)


@kernel
def accelerate(tiles, grid, work, scheme, gravity, dt):
    """Operations 3 and 4; return whether all particles are on the grid."""
    accelerate_each(tiles, grid, scheme, dt)
    if scheme.stress_update == USF:
        move_each(tiles, grid, gravity, work.ledger)
        if not change_tiles(tiles, grid):
            return False
        spread_each(tiles, grid, WITHOUT_CELLS)  # mass and momentum; the strains of cells are in the particles already
        grid.remapped[:] = grid.momentum
    remap_velocity(grid)
    return True


@kernel
def deform(tiles, grid, work, laws, scheme, gravity, dt):
    """Operations 5 and 6, and 1 of the next step; return whether all particles are on the grid."""
    nodal_velocity = grid.velocity if scheme.stress_update == USL else grid.remapped
    if reads_cells(scheme):
        deform_cells(tiles, grid, work, laws, scheme, nodal_velocity, gravity, dt)
    else:
        deform_each(tiles, grid, work, laws, scheme, nodal_velocity, gravity, dt)
    if not change_tiles(tiles, grid):
        return False
    spread_all(tiles, grid, scheme)
    return True


@kernel
def are_on_grid(particles, grid):
    """Return whether the nodes of all particles exist."""
    outside = 0
    for p in range(particles.x.size):
        outside += 0 if is_on_grid(particles.x[p], particles.y[p], grid) else 1
    return outside == 0


@kernel
def advance(particles, grid, work, laws, scheme, gravity, gravity_rate, dt, steps):
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
    if not are_on_grid(particles, grid):
        return 0
    tiles = fill_tiles(particles, grid, work.tiles)
    spread_all(tiles, grid, scheme)
    taken = 0
    are_all_there = True
    while taken < steps and are_all_there:
        tiles = sort_if_due(tiles, taken, particles, grid, work.tiles)
        g = gravity + gravity_rate * (taken + 0.5) * dt
        solve_momentum(grid, g, scheme.damping, dt)
        are_all_there = accelerate(tiles, grid, work, scheme, g, dt) and deform(tiles, grid, work, laws, scheme, g, dt)
        taken += are_all_there
    empty_tiles(tiles, particles)
    return taken
