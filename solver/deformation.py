"""Operations 5 and 6 of a step: particles deform with the velocity of the nodes, and move.

Arguments are those of ``step``; ``nodal_velocity`` (rows, 2, columns) in m/s.
"""

from solver._jit import inlined, kernel
from solver.cells import add_to_pool, average, deposit_pool, no_pool, read, shares_of, volumes_in
from solver.lanes import splat, total
from solver.mean_dilation import NO_VOLUME, with_mean_dilation
from solver.operations import GRAVITY_WORK, INTERNAL_WORK, deform_block, move_block
from solver.scheme import CELL_AVERAGE, USF
from solver.tiles import INCREMENT_XX, INCREMENT_XY, INCREMENT_YX, INCREMENT_YY, get, place_of, put, take
from solver.transfer import gradient, weights_of


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
def move_each(tiles, grid, gravity, ledger):
    """Operation 6 for all particles."""
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            fall = move_block(tiles, block, take(tiles, block), row, column, grid)
            ledger[GRAVITY_WORK] += gravity * total(fall)
            block = tiles.following[block]
