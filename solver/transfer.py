"""Between particles and nodes.

Every function is of a block of particles whose base cells are at ``row``, from ``column`` on (``tiles``); weights and
values are lanes. In a vector field ``(rows, 2, columns)`` the components of a row are ``columns`` apart.
"""

from typing import NamedTuple

from solver._jit import inlined
from solver.basis import weight_and_gradient
from solver.constants import LANE_COUNT
from solver.lanes import lane_numbers, load, spill_1, spill_2, splat, store, up_1, up_2
from solver.standing_water import displaced_mass
from solver.water import GRAVITY


class Weights(NamedTuple):
    """What particles are to their 3 x 3 nodes, factorised by direction; each has three entries."""

    sx: tuple[float, float, float]
    gx: tuple[float, float, float]  # d/dx, 1/m
    sy: tuple[float, float, float]
    gy: tuple[float, float, float]  # d/dy, 1/m


@inlined
def weights_of(x, y, row, column, grid):
    """Return the weights of a block of particles at ``x``, ``y`` (m)."""
    inverse_cell = 1.0 / grid.cell_size
    first = lane_numbers() + float(column)
    sx, gx = weight_and_gradient((x - grid.origin) * inverse_cell - first, grid.half_length, inverse_cell)
    sy, gy = weight_and_gradient((y - grid.origin) * inverse_cell - float(row), grid.half_length, inverse_cell)
    return Weights(sx, gx, sy, gy)


@inlined
def three(field, start, s):
    """Return ``sum_i s_i field_i`` over three neighbouring nodes of a row."""
    return s[0] * load(field, start) + s[1] * load(field, start + 1) + s[2] * load(field, start + 2)


@inlined
def nine(field, start, stride, sx, sy):
    """Return ``sum_i S_ip field_i`` over 3 x 3 nodes, whose rows are ``stride`` apart."""
    return (
        sy[0] * three(field, start, sx)
        + sy[1] * three(field, start + stride, sx)
        + sy[2] * three(field, start + 2 * stride, sx)
    )


@inlined
def interpolate(field, row, column, w, grid):
    """Return ``sum_i S_ip field_i`` of a vector field ``(rows, 2, columns)``, as (x, y)."""
    start = 2 * row * grid.columns + column
    return (
        nine(field, start, 2 * grid.columns, w.sx, w.sy),
        nine(field, start + grid.columns, 2 * grid.columns, w.sx, w.sy),
    )


@inlined
def gradient(field, row, column, w, grid):
    """Return ``sum_i field_i (x) grad S_ip`` of a vector field ``(rows, 2, columns)``, as (xx, xy, yx, yy)."""
    start = 2 * row * grid.columns + column
    stride = 2 * grid.columns
    return (
        nine(field, start, stride, w.gx, w.sy),
        nine(field, start, stride, w.sx, w.gy),
        nine(field, start + grid.columns, stride, w.gx, w.sy),
        nine(field, start + grid.columns, stride, w.sx, w.gy),
    )


@inlined
def nothing():
    """Return sums of three neighbouring nodes that are zero."""
    return splat(0.0), splat(0.0), splat(0.0)


@inlined
def plus(sums, s, value):
    """Return the sums of three neighbouring nodes with ``s_i value`` added to each."""
    return sums[0] + s[0] * value, sums[1] + s[1] * value, sums[2] + s[2] * value


@inlined
def deposit(field, start, sums):
    """Add the sums of the three nodes of each lane to a row of nodes, from the flat index ``start`` on."""
    store(field, start, load(field, start) + (sums[0] + up_1(sums[1]) + up_2(sums[2])))
    store(field, start + LANE_COUNT, load(field, start + LANE_COUNT) + (spill_1(sums[1]) + spill_2(sums[2])))


class Momentum(NamedTuple):
    """Momentum of three neighbouring nodes."""

    x: tuple[float, float, float]
    y: tuple[float, float, float]


@inlined
def no_momentum():
    """Return sums of 3 x 3 nodes, by rows, that are zero."""
    nothing_yet = Momentum(nothing(), nothing())
    return nothing_yet, nothing_yet, nothing_yet


@inlined
def add_momentum(sums, w, x, y):
    """Return the sums of 3 x 3 nodes with the momentum (kg/s) of particles added, ``S_ip m_p v_p``."""
    low, middle, high = sums
    return (
        Momentum(plus(low.x, w.sx, w.sy[0] * x), plus(low.y, w.sx, w.sy[0] * y)),
        Momentum(plus(middle.x, w.sx, w.sy[1] * x), plus(middle.y, w.sx, w.sy[1] * y)),
        Momentum(plus(high.x, w.sx, w.sy[2] * x), plus(high.y, w.sx, w.sy[2] * y)),
    )


@inlined
def deposit_momentum(field, row, column, sums, grid):
    """Add the sums of 3 x 3 nodes to a vector field ``(rows, 2, columns)``."""
    low, middle, high = sums
    start, stride = 2 * row * grid.columns + column, 2 * grid.columns
    deposit(field, start, low.x)
    deposit(field, start + grid.columns, low.y)
    deposit(field, start + stride, middle.x)
    deposit(field, start + stride + grid.columns, middle.y)
    deposit(field, start + 2 * stride, high.x)
    deposit(field, start + 2 * stride + grid.columns, high.y)


class State(NamedTuple):
    """Mass, momentum and internal force of three neighbouring nodes."""

    mass: tuple[float, float, float]
    momentum: Momentum
    force: Momentum


@inlined
def no_state():
    """Return sums of 3 x 3 nodes, by rows, that are zero."""
    nothing_yet = State(nothing(), Momentum(nothing(), nothing()), Momentum(nothing(), nothing()))
    return nothing_yet, nothing_yet, nothing_yet


class Load(NamedTuple):
    """What particles bring to their nodes."""

    mass: float  # kg/m
    momentum_x: float  # kg/s
    momentum_y: float
    xx: float  # N: minus volume times the stress that pushes the nodes
    yy: float
    xy: float
    lift: float  # N/m, of standing water, upward


@inlined
def load_of(particles, mean_stress, grid):
    """Return the load of particles, with ``mean_stress`` (Pa) as the in-plane mean of their stress."""
    half_difference = 0.5 * (particles.stress_xx - particles.stress_yy)
    return Load(
        particles.mass,
        particles.mass * particles.velocity_x,
        particles.mass * particles.velocity_y,
        -particles.volume * (mean_stress + half_difference),
        -particles.volume * (mean_stress - half_difference),
        -particles.volume * particles.stress_xy,
        grid.lake[GRAVITY] * displaced_mass(particles, grid),
    )


@inlined
def add_load(sums, w, j, brought):
    """Return the sums of the ``j``-th row of nodes with what particles bring.

    ``m_i += S_ip m_p``, ``(mv)_i += S_ip m_p v_p``, ``f_i -= V_p sigma_p . grad S_ip``, and ``S_ip`` of the lift.
    """
    s, g = w.sy[j], w.gy[j]
    return State(
        plus(sums.mass, w.sx, s * brought.mass),
        Momentum(
            plus(sums.momentum.x, w.sx, s * brought.momentum_x), plus(sums.momentum.y, w.sx, s * brought.momentum_y)
        ),
        Momentum(
            plus(plus(sums.force.x, w.gx, s * brought.xx), w.sx, g * brought.xy),
            plus(plus(sums.force.y, w.gx, s * brought.xy), w.sx, g * brought.yy + s * brought.lift),
        ),
    )


@inlined
def add_state(sums, w, brought):
    """Return the sums of 3 x 3 nodes with what particles bring."""
    return (
        add_load(sums[0], w, 0, brought),
        add_load(sums[1], w, 1, brought),
        add_load(sums[2], w, 2, brought),
    )


@inlined
def deposit_row(grid, row, column, sums):
    """Add the sums of a row of nodes to the grid."""
    start = 2 * row * grid.columns + column
    deposit(grid.mass, row * grid.columns + column, sums.mass)
    deposit(grid.momentum, start, sums.momentum.x)
    deposit(grid.momentum, start + grid.columns, sums.momentum.y)
    deposit(grid.force, start, sums.force.x)
    deposit(grid.force, start + grid.columns, sums.force.y)


@inlined
def deposit_state(grid, row, column, sums):
    """Add the sums of 3 x 3 nodes to the grid."""
    low, middle, high = sums
    deposit_row(grid, row, column, low)
    deposit_row(grid, row + 1, column, middle)
    deposit_row(grid, row + 2, column, high)
