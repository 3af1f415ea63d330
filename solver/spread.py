"""Operation 1 of a step: what particles bring to their nodes, and the means over cells that have a part in it.

Arguments are those of ``step``.
"""

from solver._jit import inlined, kernel
from solver.cells import add_to_pool, average, deposit_pool, no_pool, read, shares_of, volumes_in
from solver.mean_dilation import NO_VOLUME
from solver.nonlocal_softening import smooth
from solver.operations import clear_state
from solver.scheme import CELL_AVERAGE
from solver.tiles import PLASTIC_INCREMENT, PLASTIC_STRAIN, get, place_of, put, take
from solver.transfer import add_state, deposit_state, load_of, no_state, weights_of


@inlined
def reads_cells(scheme):
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
        if reads_cells(scheme):
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
    if reads_cells(scheme):
        pool_all(tiles, grid, scheme)
    spread_each(tiles, grid, scheme)
