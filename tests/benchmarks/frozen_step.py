"""The yardstick: one plain scalar loop for the step of `ma2023-printed`, which is never made faster.

GIMP, MUSL, Mohr-Coulomb without dilation, exponential softening, walls; particle by particle, node by node, nothing
fused or vectorised by hand. It imports nothing of the solver, so that a speed given as a multiple of its own means the
same in every version. `test_speed.py` holds it to the solver's step.
"""

from math import cos, exp, floor, sin, sqrt
from typing import NamedTuple

import numba
import numpy as np

frozen = numba.njit(cache=True, fastmath={"contract", "reassoc", "arcp", "nsz"}, error_model="numpy", nogil=True)


class Ground(NamedTuple):
    """Particles, (n,) or (n, k), in SI units; stress is xx, yy, zz, xy, strength c, phi, and both residual."""

    x: np.ndarray  # (n, 2)
    v: np.ndarray  # (n, 2)
    mass: np.ndarray
    volume: np.ndarray
    stress: np.ndarray  # (n, 4)
    plastic_strain: np.ndarray
    strength: np.ndarray  # (n, 4)


class Nodes(NamedTuple):
    """Nodes (rows, columns), of which node 0 is at `origin` in both directions."""

    cell: float
    half_length: float
    origin: float
    free: np.ndarray  # (rows, columns, 2) 1 or 0
    mass: np.ndarray  # (rows, columns)
    momentum: np.ndarray  # (rows, columns, 2)
    force: np.ndarray
    acceleration: np.ndarray
    velocity: np.ndarray
    remapped: np.ndarray


@frozen
def weights(place, nodes, s, g):
    """Fill the three weights along an axis and their gradients; return the first node."""
    h, l = nodes.cell, nodes.half_length  # noqa: E741
    xi = (place - nodes.origin) / h
    first = floor(xi - l)
    d = xi - first
    t = max(0.0, d - (1.0 - l))
    s[2] = t * t / (4.0 * l)
    s[0] = 1.0 - d + s[2]
    s[1] = 1.0 - s[0] - s[2]
    g[2] = t / (2.0 * l) / h
    g[0] = g[2] - 1.0 / h
    g[1] = -g[0] - g[2]
    return int(first)


@frozen
def stress_after(stress, strain_xx, strain_yy, strain_xy, c, phi, bulk, shear):
    """Return xx, yy, zz, xy and the increment of the plastic strain."""
    lame = bulk - 2.0 * shear / 3.0
    zz = stress[2] + lame * (strain_xx + strain_yy)
    xx = stress[0] + lame * (strain_xx + strain_yy) + 2.0 * shear * strain_xx
    yy = stress[1] + lame * (strain_xx + strain_yy) + 2.0 * shear * strain_yy
    xy = stress[3] + 2.0 * shear * strain_xy
    mean, half = 0.5 * (xx + yy), 0.5 * (xx - yy)
    radius = sqrt(half * half + xy * xy)
    high, low = mean + radius, mean - radius
    s1, s3 = max(high, zz), min(low, zz)
    s2 = high + low + zz - s1 - s3
    sine, strength = sin(phi), 2.0 * c * cos(phi)
    f = s1 - s3 + (s1 + s3) * sine - strength
    if f <= 0.0:
        return xx, yy, zz, xy, 0.0
    n1, n2, n3 = s1 - 0.5 * f, s2, s3 + 0.5 * f
    if n2 > n1 or n3 > n2:
        is_upper = n2 > n1
        a, b = 4.0 * shear, 2.0 * shear * (1.0 - sine if is_upper else 1.0 + sine)
        other = s2 - s3 + (s2 + s3) * sine - strength if is_upper else s1 - s2 + (s1 + s2) * sine - strength
        both = (f + other) / (a + b)
        first = (a * f - b * other) / (a * a - b * b)
        n1 = s1 - 2.0 * shear * (first if is_upper else both)
        n3 = s3 + 2.0 * shear * (both if is_upper else first)
        n2 = n1 if is_upper else n3
        if n1 < n3:
            n1 = n2 = n3 = 0.5 * strength / max(sine, 1e-30)
    d1, d2, d3 = s1 - n1, s2 - n2, s3 - n3
    of_high, of_low = d2 if zz > high else d1, d2 if zz < low else d3
    of_zz = d1 if zz > high else (d3 if zz < low else d2)
    drop, shrink = 0.5 * (of_high + of_low), 0.5 * (of_high - of_low) / max(radius, 1e-30)
    middle = (d1 + d2 + d3) / 3.0
    squares = (d1 - middle) ** 2 + (d2 - middle) ** 2 + (d3 - middle) ** 2
    grown = sqrt(squares * 2.0 / 3.0) / (2.0 * shear)
    return xx - drop - half * shrink, yy - drop + half * shrink, zz - of_zz, xy - xy * shrink, grown


@frozen
def particles_to_nodes(ground, nodes):
    """Spread mass, momentum and internal force."""
    nodes.mass[:], nodes.momentum[:], nodes.force[:] = 0.0, 0.0, 0.0
    sx, gx, sy, gy = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for p in range(ground.mass.size):
        i, j = weights(ground.x[p, 0], nodes, sx, gx), weights(ground.x[p, 1], nodes, sy, gy)
        for b in range(3):
            for a in range(3):
                s, d_x, d_y = sx[a] * sy[b], gx[a] * sy[b], sx[a] * gy[b]
                nodes.mass[j + b, i + a] += s * ground.mass[p]
                for k in range(2):
                    nodes.momentum[j + b, i + a, k] += s * ground.mass[p] * ground.v[p, k]
                xx, yy, xy = ground.stress[p, 0], ground.stress[p, 1], ground.stress[p, 3]
                nodes.force[j + b, i + a, 0] -= ground.volume[p] * (xx * d_x + xy * d_y)
                nodes.force[j + b, i + a, 1] -= ground.volume[p] * (xy * d_x + yy * d_y)


@frozen
def solve(nodes, gravity, dt):
    """Find acceleration and velocity of the nodes."""
    rows, columns = nodes.mass.shape
    for j in range(rows):
        for i in range(columns):
            has_mass = nodes.mass[j, i] > 1e-12
            for k in range(2):
                nodes.remapped[j, i, k] = 0.0
                acceleration = nodes.force[j, i, k] / nodes.mass[j, i] - gravity * k if has_mass else 0.0
                velocity = nodes.momentum[j, i, k] / nodes.mass[j, i] if has_mass else 0.0
                nodes.acceleration[j, i, k] = acceleration * nodes.free[j, i, k]
                nodes.velocity[j, i, k] = (velocity + acceleration * dt) * nodes.free[j, i, k]


@frozen
def accelerate(ground, nodes, moved, dt):
    """Accelerate particles, note where they go, and spread their momentum again."""
    sx, gx, sy, gy = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for p in range(ground.mass.size):
        i, j = weights(ground.x[p, 0], nodes, sx, gx), weights(ground.x[p, 1], nodes, sy, gy)
        for k in range(2):
            acceleration = velocity = 0.0
            for b in range(3):
                for a in range(3):
                    acceleration += sx[a] * sy[b] * nodes.acceleration[j + b, i + a, k]
                    velocity += sx[a] * sy[b] * nodes.velocity[j + b, i + a, k]
            moved[p, k] = ground.x[p, k] + velocity * dt
            ground.v[p, k] += acceleration * dt
            for b in range(3):
                for a in range(3):
                    nodes.remapped[j + b, i + a, k] += sx[a] * sy[b] * ground.mass[p] * ground.v[p, k]
    rows, columns = nodes.mass.shape
    for j in range(rows):
        for i in range(columns):
            for k in range(2):
                inverse = 1.0 / nodes.mass[j, i] if nodes.mass[j, i] > 1e-12 else 0.0
                nodes.remapped[j, i, k] *= inverse * nodes.free[j, i, k]


@frozen
def deform_and_move(ground, nodes, moved, bulk, shear, rate, dt):
    """Update stress, plastic strain, volume and, last, the places of the particles."""
    sx, gx, sy, gy = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    turned = np.empty(4)
    for p in range(ground.mass.size):
        i, j = weights(ground.x[p, 0], nodes, sx, gx), weights(ground.x[p, 1], nodes, sy, gy)
        l_xx = l_xy = l_yx = l_yy = 0.0
        for b in range(3):
            for a in range(3):
                v_x, v_y = nodes.remapped[j + b, i + a, 0], nodes.remapped[j + b, i + a, 1]
                l_xx += v_x * gx[a] * sy[b] * dt
                l_xy += v_x * sx[a] * gy[b] * dt
                l_yx += v_y * gx[a] * sy[b] * dt
                l_yy += v_y * sx[a] * gy[b] * dt
        tangent = 0.25 * (l_xy - l_yx)  # of half the angle: the rotation is Cayley's
        cosine, sine = (1.0 - tangent**2) / (1.0 + tangent**2), 2.0 * tangent / (1.0 + tangent**2)
        cosine, sine = cosine**2 - sine**2, 2.0 * sine * cosine
        xx, yy, zz, xy = ground.stress[p]
        mean, half = 0.5 * (xx + yy), 0.5 * (xx - yy)
        new_half = half * cosine + xy * sine
        turned[0], turned[1], turned[2], turned[3] = mean + new_half, mean - new_half, zz, xy * cosine - half * sine
        share = exp(-rate * ground.plastic_strain[p])
        peak_c, peak_phi, c, phi = ground.strength[p]
        c, phi = c + (peak_c - c) * share, phi + (peak_phi - phi) * share
        xx, yy, zz, xy, grown = stress_after(turned, l_xx, l_yy, 0.5 * (l_xy + l_yx), c, phi, bulk, shear)
        ground.stress[p, 0], ground.stress[p, 1], ground.stress[p, 2], ground.stress[p, 3] = xx, yy, zz, xy
        ground.plastic_strain[p] += grown
        ground.volume[p] *= (1.0 + l_xx) * (1.0 + l_yy) - l_xy * l_yx
        ground.x[p, 0], ground.x[p, 1] = moved[p, 0], moved[p, 1]


@frozen
def take_steps(ground, nodes, moved, bulk, shear, rate, gravity, dt, steps):
    """Take so many steps; `moved` (n, 2) is scratch space."""
    for _ in range(steps):
        particles_to_nodes(ground, nodes)
        solve(nodes, gravity, dt)
        accelerate(ground, nodes, moved, dt)
        deform_and_move(ground, nodes, moved, bulk, shear, rate, dt)


def copied(particles, grid):
    """Return the solver's particles and an empty grid like its own."""
    ground = Ground(
        np.stack([particles.x, particles.y], -1),
        np.stack([particles.velocity_x, particles.velocity_y], -1),
        particles.mass.copy(),
        particles.volume.copy(),
        np.stack([particles.stress_xx, particles.stress_yy, particles.stress_zz, particles.stress_xy], -1),
        particles.plastic_strain.copy(),
        np.stack(
            [
                particles.cohesion,
                particles.friction_angle,
                particles.cohesion_residual,
                particles.friction_angle_residual,
            ],
            -1,
        ),
    )
    free = np.stack([grid.free_x, grid.free_y], -1)
    fields = (np.zeros(free.shape) for _ in range(5))
    return ground, Nodes(grid.cell_size, grid.half_length, grid.origin, free, np.zeros(free.shape[:2]), *fields)
