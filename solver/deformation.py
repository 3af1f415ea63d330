"""Operations 5 and 6 of a step, particles deform with the velocity of the nodes, and move; and 1 of the next step.

Arguments are those of ``step``; ``nodal_velocity`` (rows, 2, columns) in m/s.
"""

from typing import Any

from solver._jit import allocating, chosen_by_type, inlined, sweep
from solver.cells import add_to_pool, average, deposit_pool, no_pool, read, shares_of, volumes_in
from solver.lanes import splat, total, where
from solver.leavers import settle_all
from solver.mean_dilation import NO_VOLUME, with_mean_dilation
from solver.operations import GRAVITY_WORK, INTERNAL_WORK, clear_state, deform_block, move_block
from solver.pool import (
    add_to_state_pool,
    average_state_pool,
    deposit_state_pool,
    empty_state_pool,
    no_state_pool,
    own_mean_stress,
    settle_and_pool,
)
from solver.scheme import USF, USL, CellScheme
from solver.spread import settle_and_spread, spread_each_of_cells, spread_tile
from solver.tiles import (
    INCREMENT_XX,
    INCREMENT_XY,
    INCREMENT_YX,
    INCREMENT_YY,
    PLASTIC_INCREMENT,
    PLASTIC_STRAIN,
    get,
    place_of,
    put,
    take,
)
from solver.transfer import gradient, weights_of


@inlined
def displacement_gradients(nodal_velocity, row, column, w, grid, dt):
    """Return ``L dt`` of a block: xx, xy, yx, yy."""
    xx, xy, yx, yy = gradient(nodal_velocity, row, column, w, grid)
    return xx * dt, xy * dt, yx * dt, yy * dt


@inlined
def enter(ledger, work, gravity, fall):
    """Enter the work of the stresses (J/m) and the loss of height times mass (kg m) of the lanes in the ledger."""
    ledger[INTERNAL_WORK] += total(work)
    ledger[GRAVITY_WORK] += gravity * total(fall)


@inlined
def deform_tile(tiles, tile, nodal_velocity, grid, ledger, laws, moves, gravity, dt):
    """Operations 5 and 6 for a tile."""
    row, column = place_of(tile, grid)
    work = fall = splat(0.0)
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        w = weights_of(p.x, p.y, row, column, grid)
        increment = displacement_gradients(nodal_velocity, row, column, w, grid, dt)
        new = deform_block(tiles, block, p, increment, laws, dt)
        put(tiles, block, PLASTIC_STRAIN, new.plastic_strain)
        work = work + new.work
        if moves:
            fall = fall + move_block(tiles, block, p, row, column, grid).fall
        block = tiles.following[block]
    enter(ledger, work, gravity, fall)


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


@sweep
def dilate_each(tiles, grid, nodal_velocity, dt):
    """Find the displacement gradients of the particles, and the mean dilation of the cells."""
    grid.cell_volume[:] = 0.0
    grid.cell_dilation[:] = 0.0
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            dilate_tile(tiles, tile, nodal_velocity, grid, dt)
    average(grid.cell_dilation, grid.cell_volume, NO_VOLUME)


@inlined
def yield_tile(tiles, tile, grid, ledger, laws, scheme, gravity, dt):
    """Operations 5 and 6 for a tile, with the dilation of its cells, which gather the particles as they are then."""
    row, column = place_of(tile, grid)
    work = fall = splat(0.0)
    sums = no_state_pool()
    block = tiles.first[tile]
    while block >= 0:
        p = take(tiles, block)
        increment = (
            get(tiles, block, INCREMENT_XX),
            get(tiles, block, INCREMENT_XY),
            get(tiles, block, INCREMENT_YX),
            get(tiles, block, INCREMENT_YY),
        )
        shares = shares_of(p.x, p.y, row, column, grid)
        if scheme.averages_dilation:
            increment = with_mean_dilation(increment, read(grid.cell_dilation, row, column, shares, grid))
        new = deform_block(tiles, block, p, increment, laws, dt)
        work = work + new.work
        yielded = new.plastic_strain - p.plastic_strain
        put(tiles, block, PLASTIC_INCREMENT, yielded)
        if not scheme.averages_plastic_strain:
            put(tiles, block, PLASTIC_STRAIN, new.plastic_strain)
        volume = new.volume
        if scheme.stress_update != USF:
            moved = move_block(tiles, block, p, row, column, grid)
            fall = fall + moved.fall
            shares = shares_of(moved.x, moved.y, row, column, grid)
            volume = where(moved.stays, volume, 0.0)
        sums = add_to_state_pool(sums, shares, volume, own_mean_stress(new, p.pore_pressure), yielded)
        block = tiles.following[block]
    enter(ledger, work, gravity, fall)
    deposit_state_pool(grid, row, column, sums)


@sweep
def yield_each(tiles, grid, ledger, laws, scheme, gravity, dt):
    """Operations 5 and 6 with what ``dilate_each`` has found; return whether all particles are on the grid."""
    empty_state_pool(grid)
    for tile in range(tiles.first.size):
        if tiles.first[tile] >= 0:
            yield_tile(tiles, tile, grid, ledger, laws, scheme, gravity, dt)
    return settle_and_pool(tiles, grid)


@allocating
def velocity_to_deform_with(grid, scheme):
    """Return the nodal velocity (rows, 2, columns) in m/s of operation 5."""
    return grid.velocity if scheme.stress_update == USL else grid.remapped


def deform(tiles, grid, ledger, laws, scheme, gravity, dt):
    """Operations 5 and 6, and 1 of the next step; return whether all particles are on the grid."""
    raise NotImplementedError("A kernel's own.")


@chosen_by_type(deform)
def _deform(tiles: Any, grid: Any, ledger: Any, laws: Any, scheme: Any, gravity: Any, dt: Any) -> Any:
    def tile_by_tile(tiles, grid, ledger, laws, scheme, gravity, dt):
        nodal_velocity = velocity_to_deform_with(grid, scheme)
        clear_state(grid)
        for tile in range(tiles.first.size):
            if tiles.first[tile] >= 0:
                deform_tile(tiles, tile, nodal_velocity, grid, ledger, laws, scheme.stress_update != USF, gravity, dt)
                spread_tile(tiles, tile, grid)
        return settle_and_spread(tiles, grid)

    def with_means_over_cells(tiles, grid, ledger, laws, scheme, gravity, dt):
        dilate_each(tiles, grid, velocity_to_deform_with(grid, scheme), dt)
        if not yield_each(tiles, grid, ledger, laws, scheme, gravity, dt):
            return False
        average_state_pool(grid, scheme)
        spread_each_of_cells(tiles, grid, scheme)
        return True

    return with_means_over_cells if scheme.instance_class is CellScheme else tile_by_tile


@sweep
def move_each(tiles, grid, gravity, ledger):
    """Operation 6 for all particles; return whether they are on the grid."""
    fall = splat(0.0)
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            fall = fall + move_block(tiles, block, take(tiles, block), row, column, grid).fall
            block = tiles.following[block]
    ledger[GRAVITY_WORK] += gravity * total(fall)
    return settle_all(tiles, grid)
