"""One time step in plain NumPy, an operation a function: the oracle of ``solver.step.advance``.

The six lines of the box of ``solver.step``, with nothing fused, blocked or inlined. Weights are dense, ``(nodes, n)``,
so a sum over particles or nodes is a matrix product. Only the law of a point comes from the solver, as a function.

The letters are those of the box: ``p`` a particle, ``i`` a node, ``c`` a cell. A cell has the number of the node at its
lower left corner. Lengths along an axis are counted in cells.
"""

from typing import NamedTuple

import numpy as np

from solver.grid import PADDING
from solver.particles import copy_particles
from solver.water import DENSITY, LEVEL, LIGHTENING

EMPTY_NODE = 1e-12  # kg/m: a node with less mass stands still
EMPTY_CELL = 1e-12  # m2: a cell with less volume has no mean


class StepChoices(NamedTuple):
    """How a step is taken."""

    stress_update: str  # "musl", "usl" or "usf"
    flip_fraction: float = 1.0
    damping: float = 0.0
    has_cell_averages: bool = False
    has_internal_length: bool = False


class Weights(NamedTuple):
    """What a particle is to a node; each ``(nodes, n)``."""

    s: np.ndarray  # S_ip
    x: np.ndarray  # dS_ip/dx, 1/m
    y: np.ndarray  # dS_ip/dy, 1/m


class Nodes(NamedTuple):
    """The state of the nodes: mass ``(nodes,)`` in kg/m, momentum (kg/s) and internal force (N/m) ``(nodes, 2)``."""

    mass: np.ndarray
    momentum: np.ndarray
    force: np.ndarray


class Step(NamedTuple):
    """What one step leaves behind."""

    particles: object  # Particles, at the end
    nodes: Nodes  # of the particles at the end
    acceleration: np.ndarray  # (nodes, 2) m/s2
    velocity: np.ndarray  # (nodes, 2) m/s, after line 2
    mass: np.ndarray  # (nodes,) kg/m, that belongs to these two
    work_of_stresses: float  # J/m
    work_of_gravity: float  # J/m


def mean_of_hat(d, l_p):
    """Return the mean of ``max(0, 1 - |d|)`` over ``d +- l_p``: Bardenhagen and Kober (2004), eq. 23."""
    a = np.abs(d)
    pieces = [1.0 - (d**2 + l_p**2) / (2.0 * l_p), 1.0 - a, (1.0 + l_p - a) ** 2 / (4.0 * l_p)]
    return np.select([a < l_p, a < 1.0 - l_p, a < 1.0 + l_p], pieces, 0.0)


def mean_slope_of_hat(d, l_p):
    """Return the derivative of ``mean_of_hat`` by ``d``."""
    a = np.abs(d)
    pieces = [-d / l_p, -np.sign(d), -np.sign(d) * (1.0 + l_p - a) / (2.0 * l_p)]
    return np.select([a < l_p, a < 1.0 - l_p, a < 1.0 + l_p], pieces, 0.0)


def in_cells(place, grid):
    """Return a place along one axis, counted in cells from the first node."""
    return (place - grid.origin) / grid.cell_size


def products(along_x, along_y):
    """Return the products of ``(columns, n)`` and ``(rows, n)``, one a node, ``(nodes, n)``."""
    return (along_y[:, None] * along_x).reshape(-1, along_x.shape[1])


def weights_at(particles, grid):
    """Return the weights of the particles where they are now."""
    l_p = grid.half_length
    d_x = in_cells(particles.x, grid) - np.arange(grid.columns)[:, None]
    d_y = in_cells(particles.y, grid) - np.arange(grid.rows)[:, None]
    s_x, s_y = mean_of_hat(d_x, l_p), mean_of_hat(d_y, l_p)
    g_x, g_y = mean_slope_of_hat(d_x, l_p) / grid.cell_size, mean_slope_of_hat(d_y, l_p) / grid.cell_size
    return Weights(products(s_x, s_y), products(g_x, s_y), products(s_x, g_y))


def shares_of_cells(particles, grid):
    """Return ``w_cp``, the share of each particle's domain that lies in each cell, ``(nodes, n)``."""

    def along(place, count):
        edges = np.arange(count + 1)[:, None]
        left_of_edge = np.clip((edges - (in_cells(place, grid) - grid.half_length)) / (2.0 * grid.half_length), 0, 1)
        return np.diff(left_of_edge, axis=0)

    return products(along(particles.x, grid.columns), along(particles.y, grid.rows))


def cell_average(values, particles, grid):
    """Return ``sum_c w_cp (sum_q w_cq V_q values_q) / (sum_q w_cq V_q)``, ``(n,)``."""
    w = shares_of_cells(particles, grid)
    return w.T @ quotient(w @ (particles.volume * values), w @ particles.volume, EMPTY_CELL)


def neighbourhood_average(values, particles, grid):
    """Return the same with both sums smoothed over the neighbouring cells before they are divided."""
    w = shares_of_cells(particles, grid)
    sums = smoothed(w @ (particles.volume * values), grid)
    return w.T @ quotient(sums, smoothed(w @ particles.volume, grid), 0.0)


def smoothed(sums, grid):
    """Return sums over cells, convolved with the filter along both axes; beyond the grid there is nothing."""
    table = sums.reshape(grid.rows, grid.columns)
    for axis in (0, 1):
        table = np.apply_along_axis(np.convolve, axis, table, grid.smoothing)
        middle = np.arange(grid.smoothing.size // 2, table.shape[axis] - grid.smoothing.size // 2)
        table = np.take(table, middle, axis)
    return table.ravel()


def quotient(dividend, divisor, least):
    """Return ``dividend / divisor``, and 0 where the divisor is not larger than ``least``."""
    return np.divide(dividend, divisor, out=np.zeros_like(dividend), where=divisor > least)


def per_mass(vectors, mass):
    """Return nodal vectors ``(nodes, 2)`` over the mass of their nodes."""
    return np.stack([quotient(vectors[:, axis], mass, EMPTY_NODE) for axis in (0, 1)], axis=1)


def between_walls(vectors, grid):
    """Return nodal vectors ``(nodes, 2)`` without the components that the walls hold."""
    return vectors * np.stack([grid.free_x.ravel(), grid.free_y.ravel()], axis=1)


def below_lake(y, half_height, grid):
    """Return the share of ``y +- half_height`` that lies below the level of the lake."""
    return np.clip(0.5 + 0.5 * (grid.lake[LEVEL] - y) / half_height, 0.0, 1.0)


def displaced_mass(particles, grid):
    """Return the mass of the water of the lake in the place of the particles, ``(n,)`` in kg/m."""
    return grid.lake[DENSITY] * particles.volume * below_lake(particles.y, grid.half_length * grid.cell_size, grid)


def spread(particles, grid, method, gravity):
    """Line 1: return the state of the nodes, of the total stress, averaged over the cells where the method does."""
    s = weights_at(particles, grid)
    xx, yy, xy = (
        particles.stress_xx - particles.pore_pressure,
        particles.stress_yy - particles.pore_pressure,
        particles.stress_xy,
    )
    if method.has_cell_averages:
        mean = 0.5 * (xx + yy)
        change = cell_average(mean, particles, grid) - mean
        xx, yy = xx + change, yy + change
    volume, mass = particles.volume, particles.mass
    force = [s.x @ (volume * xx) + s.y @ (volume * xy), s.x @ (volume * xy) + s.y @ (volume * yy)]
    force[1] -= s.s @ (gravity * displaced_mass(particles, grid))
    momentum = [s.s @ (mass * particles.velocity_x), s.s @ (mass * particles.velocity_y)]
    return Nodes(s.s @ mass, np.stack(momentum, axis=1), -np.stack(force, axis=1))


def solve(nodes, grid, method, gravity, dt):
    """Line 2: return acceleration and velocity of the nodes; damping opposes the motion."""
    before = per_mass(nodes.momentum, nodes.mass)
    acceleration = per_mass(nodes.force, nodes.mass)
    acceleration[nodes.mass > EMPTY_NODE, 1] -= gravity
    acceleration -= method.damping * np.abs(acceleration) * np.sign(before)
    return between_walls(acceleration, grid), between_walls(before + acceleration * dt, grid)


def accelerate(particles, s, acceleration, velocity, flip_fraction, dt):
    """Line 3, in place: FLIP adds the change of the nodal velocity, PIC takes the nodal velocity itself."""
    for axis, v_p in enumerate((particles.velocity_x, particles.velocity_y)):
        flip = v_p + s.T @ acceleration[:, axis] * dt
        v_p[:] = flip_fraction * flip + (1.0 - flip_fraction) * (s.T @ velocity[:, axis])


def feel_overburden(particles, s, mass, grid, gravity):
    """Set the pore pressures, in place: of the weight above each node, with half its own, less the uplift."""
    width = np.full(grid.columns, grid.cell_size)
    width[[PADDING, PADDING + round(grid.width / grid.cell_size)]] /= 2.0
    weight = gravity * mass.reshape(grid.rows, grid.columns) / width
    below = np.where(np.arange(grid.rows) == PADDING, 0.0, 0.5)[:, None]
    overburden = s.T @ (np.cumsum(weight[::-1], axis=0)[::-1] - below * weight).ravel()
    lake = gravity * grid.lake[DENSITY] * np.maximum(grid.lake[LEVEL] - particles.y, 0.0)
    uplift = np.minimum(grid.lake[LIGHTENING] * overburden, lake)
    particles.pore_pressure[:] = particles.pore_area / particles.volume * overburden - uplift


def move(particles, displacement):
    """Line 6, in place: add the displacement ``(2, n)`` in m."""
    particles.x[:] += displacement[0]
    particles.y[:] += displacement[1]


def remap(particles, grid):
    """Line 4: return the velocity of the nodes that the particles' velocities make where they are."""
    s = weights_at(particles, grid).s
    momentum = [s @ (particles.mass * v) for v in (particles.velocity_x, particles.velocity_y)]
    return between_walls(per_mass(np.stack(momentum, axis=1), s @ particles.mass), grid)


def displacement_gradients(particles, velocity, grid, method, dt):
    """Return ``L dt``, ``(2, 2, n)``; with cell averages every particle has the dilation of its cells."""
    s = weights_at(particles, grid)
    increment = dt * np.array([[g.T @ velocity[:, axis] for g in (s.x, s.y)] for axis in (0, 1)])
    if method.has_cell_averages:
        dilation = increment[0, 0] + increment[1, 1]
        change = 0.5 * (cell_average(dilation, particles, grid) - dilation)
        increment[0, 0] += change
        increment[1, 1] += change
    return increment


def rotated(stress, angle):
    """Return the tensor ``(2, 2)`` turned by an ``angle`` in rad."""
    q = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return q @ stress @ q.T


def deform(particles, increments, point_law):
    """Line 5, in place: turn the stress with the ground, let the law change it; return the work of the total stress.

    ``point_law(p, (xx, yy, zz, xy), (strain_xx, strain_yy, strain_xy), plastic_strain)`` returns the new stress and
    plastic strain of particle ``p``. The rotation is Cayley's: its half angle has the tangent ``W_yx dt / 2``.
    """
    work = 0.0
    for p in range(particles.x.size):
        L = increments[:, :, p]
        strain, spin = 0.5 * (L + L.T), 0.5 * (L[1, 0] - L[0, 1])
        before = np.array(
            [[particles.stress_xx[p], particles.stress_xy[p]], [particles.stress_xy[p], particles.stress_yy[p]]]
        )
        before = rotated(before, 2.0 * np.arctan(0.5 * spin))
        xx, yy, zz, xy, plastic_strain = point_law(
            p,
            (before[0, 0], before[1, 1], particles.stress_zz[p], before[0, 1]),
            (strain[0, 0], strain[1, 1], strain[0, 1]),
            particles.plastic_strain[p],
        )
        volume = particles.volume[p] * np.linalg.det(np.eye(2) + L)
        mean_stress = 0.5 * (before + np.array([[xx, xy], [xy, yy]])) - particles.pore_pressure[p] * np.eye(2)
        work += 0.5 * (volume + particles.volume[p]) * np.sum(mean_stress * strain)
        particles.stress_xx[p], particles.stress_yy[p] = xx, yy
        particles.stress_zz[p], particles.stress_xy[p] = zz, xy
        particles.plastic_strain[p], particles.volume[p] = plastic_strain, volume
    return work


def reference_step(start, grid, point_law, method, gravity, gravity_rate, dt):
    """Return what one step of ``dt`` s makes of the particles ``start``.

    Parameters
    ----------
    start : Particles
        Not modified.
    grid : Grid
        Only its geometry, walls and smoothing are read.
    point_law : callable
        See ``deform``.
    method : StepChoices
    gravity, gravity_rate : float
        Downward, at the start of the step in m/s2, and its growth in m/s3.
    dt : float
        In s.
    """
    particles, gravity_before = copy_particles(start), gravity
    gravity += 0.5 * gravity_rate * dt

    before = spread(particles, grid, method, gravity_before)  # 1
    acceleration, velocity = solve(before, grid, method, gravity, dt)  # 2
    s = weights_at(particles, grid).s
    if grid.has_water:
        feel_overburden(particles, s, before.mass, grid, gravity)
    displacement = s.T @ velocity[:, 0] * dt, s.T @ velocity[:, 1] * dt
    accelerate(particles, s, acceleration, velocity, method.flip_fraction, dt)  # 3
    if method.stress_update == "usf":
        move(particles, displacement)  # 6
    deforming = velocity if method.stress_update == "usl" else remap(particles, grid)  # 4
    increments = displacement_gradients(particles, deforming, grid, method, dt)
    displaced_before = displaced_mass(start, grid)
    work = deform(particles, increments, point_law)  # 5
    if method.stress_update != "usf":
        move(particles, displacement)  # 6
    nodes = spread(particles, grid, method, gravity)  # 1 of the next step
    if method.has_internal_length:
        increment = particles.plastic_strain - start.plastic_strain
        particles.plastic_strain[:] = start.plastic_strain + neighbourhood_average(increment, particles, grid)
    fall = np.sum((particles.mass - displaced_before) * (start.y - particles.y))
    return Step(particles, nodes, acceleration, velocity, before.mass, work, gravity * fall)
