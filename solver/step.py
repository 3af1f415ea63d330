"""One explicit GIMP time step, and many of them.

The modified update-stress-last step (MUSL; Sulsky, Zhou and Schreyer 1995, Nairn 2003), with the weights of the places
``x_p`` at the start of the step until the particles move, last of all:

    1  m_i = S_ip m_p,  (mv)_i = S_ip m_p v_p,  f_i = -V_p sigma_p . grad S_ip       particle_to_grid
    2  a_i = f_i / m_i + g,  v_i = (mv)_i / m_i + a_i dt,  walls                     solve_momentum
    3  v_p <- v_p + S_ip a_i dt                                                      update_velocity
    4  v_i <- S_ip m_p v_p / m_i,  walls                                             remap_velocity
    5  L_p = v_i (x) grad S_ip,  sigma_p <- law(sigma_p, L_p dt),  V_p               update_materials
    6  x_p <- x_p + S_ip v_i(2) dt                                                   move

Update-stress-last (USL) leaves out 4; update-stress-first (USF) moves before 4. Particles are in blocks of eight
(``tiles``) that are treated at once (``lanes``). A step is two passes over the tiles, one for 3 and 4, one for 5, 6 and
1 of the next step. Means over cells, against locking (``mean_dilation``) or of the plastic strain that softens
(``nonlocal_softening``), need all particles at two places, which cuts the second pass in three. The few particles that
leave their tile in a step bring what they have to the grid one by one. The operations are in ``operations`` and
``transfer``; here they are put together.

All kernels take the ``tiles`` of the particles and the nodes of ``grid``, and modify them; ``laws``, a tuple with the
parameters of each material; a ``scheme``; gravity downward in m/s2; ``dt`` in s.
"""

from typing import NamedTuple

import numpy as np

from solver._jit import inlined, kernel
from solver.cells import (
    add_to_pool,
    average,
    deposit_pool,
    no_pool,
    read,
    shares_of,
    volumes_in,
)
from solver.lanes import splat, total
from solver.mean_dilation import NO_VOLUME, with_mean_dilation
from solver.nonlocal_softening import smooth
from solver.operations import (
    GRAVITY_WORK,
    INTERNAL_WORK,
    accelerate_block,
    clear_state,
    deform_block,
    move_block,
    remap_velocity,
    solve_momentum,
)
from solver.scheme import CELL_AVERAGE, MUSL, USF, USL, Scheme
from solver.tiles import (
    INCREMENT_XX,
    INCREMENT_XY,
    INCREMENT_YX,
    INCREMENT_YY,
    PLASTIC_INCREMENT,
    PLASTIC_STRAIN,
    USED,
    TileStore,
    allocate_tiles,
    change_tiles,
    empty_tiles,
    fill_tiles,
    get,
    is_on_grid,
    place_of,
    put,
    sort_again,
    take,
)
from solver.transfer import (
    add_momentum,
    add_state,
    deposit_momentum,
    deposit_state,
    gradient,
    interpolate,
    load_of,
    no_momentum,
    no_state,
    weights_of,
)

STEPS_BETWEEN_SORTS = 64
WITHOUT_CELLS = Scheme(USF, 1.0, 0.0)


class Workspace(NamedTuple):
    """Room for the tiles of a march, and the energy ledger it keeps."""

    tiles: TileStore
    ledger: np.ndarray  # (2,) J/m: work of the stresses, work of gravity


def allocate_workspace(n_particles: int) -> Workspace:
    """Return scratch space for ``n_particles`` with an empty ledger."""
    return Workspace(allocate_tiles(n_particles), np.zeros(2))


@inlined
def pools(scheme):
    """Return whether particles read means over cells."""
    return scheme.locking == CELL_AVERAGE or scheme.averages_plastic_strain


@inlined
def own_mean_stress(particles):
    """Return the in-plane mean stress of particles in Pa."""
    return 0.5 * (particles.stress_xx + particles.stress_yy)


@inlined
def spread_tile(tiles, tile, grid, scheme):
    """Operation 1 for a tile; with means over cells, which it reads, in the internal force and the plastic strain."""
    row, column = place_of(tile, grid)
    low = middle = high = no_state()
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        w = weights_of(p.x, p.y, row, column, grid)
        mean_stress = own_mean_stress(p)
        if pools(scheme):
            shares = shares_of(p.x, p.y, row, column, grid)
            if scheme.locking == CELL_AVERAGE:
                mean_stress = read(grid.cell_pressure, row, column, shares, grid)
            if scheme.averages_plastic_strain:
                increment = read(grid.cell_plastic_strain, row, column, shares, grid)
                put(tiles, block, PLASTIC_STRAIN, p.plastic_strain + increment)
        brought = load_of(p, mean_stress)
        low = add_state(low, w, 0, brought)
        middle = add_state(middle, w, 1, brought)
        high = add_state(high, w, 2, brought)
        block = tiles.following[block]
    deposit_state(grid, row, column, low)
    deposit_state(grid, row + 1, column, middle)
    deposit_state(grid, row + 2, column, high)


@inlined
def pool_tile(tiles, tile, grid):
    """Collect volume, pressure and increment of plastic strain of the cells from a tile."""
    row, column = place_of(tile, grid)
    volume = pressure = strain = no_pool()
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        volumes = volumes_in(shares_of(p.x, p.y, row, column, grid), p.volume)
        volume = add_to_pool(volume, volumes, 1.0)
        pressure = add_to_pool(pressure, volumes, own_mean_stress(p))
        strain = add_to_pool(strain, volumes, get(tiles, block, PLASTIC_INCREMENT))
        block = tiles.following[block]
    deposit_pool(grid.cell_volume, row, column, volume, grid)
    deposit_pool(grid.cell_pressure, row, column, pressure, grid)
    deposit_pool(grid.cell_plastic_strain, row, column, strain, grid)


@kernel
def pool_all(tiles, grid, scheme):
    """Find the means over cells: of the pressure, and of the increments of plastic strain."""
    grid.cell_volume[:] = 0.0
    grid.cell_pressure[:] = 0.0
    grid.cell_plastic_strain[:] = 0.0
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            pool_tile(tiles, tile, grid)
    average(grid.cell_pressure, grid.cell_volume, NO_VOLUME)
    if scheme.averages_plastic_strain:
        smooth(grid.cell_volume, grid.smoothing)
        smooth(grid.cell_plastic_strain, grid.smoothing)
        average(grid.cell_plastic_strain, grid.cell_volume, 0.0)


@kernel
def spread_each(tiles, grid, scheme):
    """Operation 1 for all particles, with the means that the cells have."""
    clear_state(grid)
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            spread_tile(tiles, tile, grid, scheme)


@kernel
def spread_all(tiles, grid, scheme):
    """Operation 1 for all particles."""
    if pools(scheme):
        pool_all(tiles, grid, scheme)
    spread_each(tiles, grid, scheme)


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
def move_each(tiles, grid, gravity, ledger):
    """Operation 6 for all particles; return whether all are on the grid."""
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            fall = move_block(tiles, block, take(tiles, block), row, column, grid)
            ledger[GRAVITY_WORK] += gravity * total(fall)
            block = tiles.following[block]
    return change_tiles(tiles, grid)


@kernel
def accelerate(tiles, grid, work, scheme, gravity, dt):
    """Operations 3 and 4; return whether all particles are on the grid."""
    accelerate_each(tiles, grid, scheme, dt)
    if scheme.stress_update == USF:
        if not move_each(tiles, grid, gravity, work.ledger):
            return False
        spread_each(tiles, grid, WITHOUT_CELLS)  # mass and momentum; the strains of cells are in the particles already
        grid.remapped[:] = grid.momentum
    remap_velocity(grid)
    return True


@inlined
def displacement_gradients(nodal_velocity, row, column, w, grid, dt):
    """Return ``L dt`` of a block: xx, xy, yx, yy."""
    xx, xy, yx, yy = gradient(nodal_velocity, row, column, w, grid)
    return xx * dt, xy * dt, yx * dt, yy * dt


@inlined
def enter(ledger, done, gravity, fall):
    """Enter the work of the stresses (J/m) and the loss of height times mass (kg) of the lanes in the ledger."""
    ledger[INTERNAL_WORK] += total(done)
    ledger[GRAVITY_WORK] += gravity * total(fall)


@inlined
def deform_tile(tiles, tile, nodal_velocity, grid, work, laws, moves, gravity, dt):
    """Operations 5 and 6 for a tile."""
    row, column = place_of(tile, grid)
    done = fall = splat(0.0)
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        w = weights_of(p.x, p.y, row, column, grid)
        increment = displacement_gradients(nodal_velocity, row, column, w, grid, dt)
        done = done + deform_block(tiles, block, p, increment, laws, dt, False)
        if moves:
            fall = fall + move_block(tiles, block, p, row, column, grid)
        block = tiles.following[block]
    enter(work.ledger, done, gravity, fall)


@kernel
def deform_each(tiles, grid, work, laws, scheme, nodal_velocity, gravity, dt):
    """Operations 5 and 6."""
    moves = scheme.stress_update != USF
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            deform_tile(tiles, tile, nodal_velocity, grid, work, laws, moves, gravity, dt)


@inlined
def dilate_tile(tiles, tile, nodal_velocity, grid, dt):
    """Keep the displacement gradients of a tile, and collect volume and dilation of the cells."""
    row, column = place_of(tile, grid)
    volume = dilation = no_pool()
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        w = weights_of(p.x, p.y, row, column, grid)
        xx, xy, yx, yy = displacement_gradients(nodal_velocity, row, column, w, grid, dt)
        put(tiles, block, INCREMENT_XX, xx)
        put(tiles, block, INCREMENT_XY, xy)
        put(tiles, block, INCREMENT_YX, yx)
        put(tiles, block, INCREMENT_YY, yy)
        volumes = volumes_in(shares_of(p.x, p.y, row, column, grid), p.volume)
        volume = add_to_pool(volume, volumes, 1.0)
        dilation = add_to_pool(dilation, volumes, xx + yy)
        block = tiles.following[block]
    deposit_pool(grid.cell_volume, row, column, volume, grid)
    deposit_pool(grid.cell_dilation, row, column, dilation, grid)


@inlined
def yield_tile(tiles, tile, grid, work, laws, scheme, gravity, dt):
    """Operations 5 and 6 for a tile, with the dilation of its cells."""
    row, column = place_of(tile, grid)
    done = fall = splat(0.0)
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        increment = (
            get(tiles, block, INCREMENT_XX),
            get(tiles, block, INCREMENT_XY),
            get(tiles, block, INCREMENT_YX),
            get(tiles, block, INCREMENT_YY),
        )
        if scheme.locking == CELL_AVERAGE:
            shares = shares_of(p.x, p.y, row, column, grid)
            increment = with_mean_dilation(increment, read(grid.cell_dilation, row, column, shares, grid))
        averages = scheme.averages_plastic_strain
        done = done + deform_block(tiles, block, p, increment, laws, dt, averages)
        if scheme.stress_update != USF:
            fall = fall + move_block(tiles, block, p, row, column, grid)
        block = tiles.following[block]
    enter(work.ledger, done, gravity, fall)


@kernel
def deform_cells(tiles, grid, work, laws, scheme, nodal_velocity, gravity, dt):
    """Operations 5 and 6 with the dilation of the cells."""
    grid.cell_volume[:] = 0.0
    grid.cell_dilation[:] = 0.0
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            dilate_tile(tiles, tile, nodal_velocity, grid, dt)
    average(grid.cell_dilation, grid.cell_volume, NO_VOLUME)
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            yield_tile(tiles, tile, grid, work, laws, scheme, gravity, dt)


@kernel
def deform(tiles, grid, work, laws, scheme, gravity, dt):
    """Operations 5 and 6, and 1 of the next step; return whether all particles are on the grid."""
    nodal_velocity = grid.velocity if scheme.stress_update == USL else grid.remapped
    if pools(scheme):
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
        if taken % STEPS_BETWEEN_SORTS == STEPS_BETWEEN_SORTS - 1 or tiles.counts[USED] > particles.x.size:
            tiles = sort_again(tiles, particles, grid, work.tiles)
        g = gravity + gravity_rate * (taken + 0.5) * dt
        solve_momentum(grid, g, scheme.damping, dt)
        are_all_there = accelerate(tiles, grid, work, scheme, g, dt) and deform(tiles, grid, work, laws, scheme, g, dt)
        taken += are_all_there
    empty_tiles(tiles, particles)
    return taken
