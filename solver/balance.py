"""How far ground is from balance, as its nodes have it and as its particles feel it."""

import numpy as np

from solver._jit import kernel
from solver.constants import STANDARD_GRAVITY
from solver.grid import Grid
from solver.lanes import splat, total
from solver.operations import solve_momentum
from solver.tiles import place_of, take
from solver.transfer import interpolate, weights_of


def unbalanced_share(grid: Grid, gravity: float) -> float:
    """Return ``||f_int + m gravity|| / ||m g||``, the force over the nodes that may move; NaN on an empty grid."""
    weight = float(np.sum((grid.mass * STANDARD_GRAVITY) ** 2))
    if not weight > 0.0:
        return np.nan
    force_x = grid.force[:, 0] * grid.free_x
    force_y = (grid.force[:, 1] - grid.mass * gravity) * grid.free_y
    return float(np.sqrt((np.sum(force_x**2) + np.sum(force_y**2)) / weight))


@kernel
def felt_share(tiles, grid, gravity):
    """Return ``||m_p sum_i S_ip a_i|| / ||m_p g||``, the unbalanced force that particles feel over their weight.

    Parameters
    ----------
    tiles : Tiles
    grid : Grid
        With mass and force of the particles; its acceleration and velocity are set, as the next step will do again.
    gravity : float
        Downward, in m/s2.
    """
    solve_momentum(grid, gravity, 0.0, 0.0)
    felt = weight = splat(0.0)
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            p = take(tiles, block)
            a_x, a_y = interpolate(grid.acceleration, row, column, weights_of(p.x, p.y, row, column, grid), grid)
            felt = felt + p.mass * p.mass * (a_x * a_x + a_y * a_y)
            weight = weight + p.mass * p.mass
            block = tiles.following[block]
    return np.sqrt(total(felt) / total(weight)) / STANDARD_GRAVITY
