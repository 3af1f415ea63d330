"""The same kind of step in Taichi, on one thread, where Taichi happens to be installed: MLS-MPM with Drucker-Prager.

Loops are serial, or else each addition to a node is atomic. Less is done than in ours: APIC instead of GIMP and MUSL,
so one transfer each way, no softening, no ledger, and a law without edges. It is what a user of Taichi would write.
"""

from importlib.util import find_spec

import numpy as np

IS_INSTALLED = find_spec("taichi") is not None
STEPS = 100


class TaichiSlope:
    """Particles of a slope on Taichi's own grid."""

    def __init__(self, particles, grid, bulk, shear, dt):
        import taichi as ti

        ti.init(arch=ti.cpu, cpu_max_num_threads=1, default_fp=ti.f64, log_level=ti.ERROR, offline_cache=False)
        self._step = _kernel(ti, particles, grid, bulk, shear, dt)
        self.n_particles = particles.x.size
        self.take_steps(1)

    def take_steps(self, steps=STEPS):
        """Take so many steps."""
        for _ in range(steps):
            self._step()


def _kernel(ti, particles, grid, bulk, shear, dt):
    """Return a function that takes a step; `particles` and `grid` are the solver's."""
    n, (rows, columns) = particles.x.size, grid.mass.shape
    x, v, c = ti.Vector.field(2, ti.f64, n), ti.Vector.field(2, ti.f64, n), ti.Matrix.field(2, 2, ti.f64, n)
    stress = ti.Vector.field(4, ti.f64, n)  # xx, yy, zz, xy
    mass, volume = ti.field(ti.f64, n), ti.field(ti.f64, n)
    cohesion, friction = ti.field(ti.f64, n), ti.field(ti.f64, n)
    node_velocity, node_mass = ti.Vector.field(2, ti.f64, (rows, columns)), ti.field(ti.f64, (rows, columns))
    free = ti.Vector.field(2, ti.f64, (rows, columns))
    x.from_numpy(np.stack([particles.x, particles.y], -1))
    v.from_numpy(np.stack([particles.velocity_x, particles.velocity_y], -1))
    stress.from_numpy(
        np.stack([particles.stress_xx, particles.stress_yy, particles.stress_zz, particles.stress_xy], -1)
    )
    mass.from_numpy(particles.mass)
    volume.from_numpy(particles.volume)
    cohesion.from_numpy(particles.cohesion)
    friction.from_numpy(particles.friction_angle)
    free.from_numpy(np.stack([grid.free_x, grid.free_y], -1))
    h, origin, lame = grid.cell_size, grid.origin, bulk - 2.0 * shear / 3.0

    @ti.kernel
    def step():
        ti.loop_config(serialize=True)
        for j, i in ti.ndrange(rows, columns):
            node_mass[j, i] = 0.0
            node_velocity[j, i] = ti.Vector([0.0, 0.0])
        ti.loop_config(serialize=True)
        for p in range(n):
            at = (x[p] - origin) / h
            base = ti.cast(at - 0.5, ti.i32)
            f = at - ti.cast(base, ti.f64)
            w = [0.5 * (1.5 - f) ** 2, 0.75 - (f - 1.0) ** 2, 0.5 * (f - 0.5) ** 2]
            s = stress[p]
            tensor = ti.Matrix([[s[0], s[3]], [s[3], s[1]]])
            affine = -dt * volume[p] * 4.0 / h**2 * tensor + mass[p] * c[p]
            for a, b in ti.static(ti.ndrange(3, 3)):
                away = (ti.Vector([float(a), float(b)]) - f) * h
                weight = w[a][0] * w[b][1]
                node_velocity[base[1] + b, base[0] + a] += weight * (mass[p] * v[p] + affine @ away)
                node_mass[base[1] + b, base[0] + a] += weight * mass[p]
        ti.loop_config(serialize=True)
        for j, i in ti.ndrange(rows, columns):
            if node_mass[j, i] > 1e-12:
                node_velocity[j, i] /= node_mass[j, i]
                node_velocity[j, i][1] -= dt * 9.80665
                node_velocity[j, i] *= free[j, i]
        ti.loop_config(serialize=True)
        for p in range(n):
            at = (x[p] - origin) / h
            base = ti.cast(at - 0.5, ti.i32)
            f = at - ti.cast(base, ti.f64)
            w = [0.5 * (1.5 - f) ** 2, 0.75 - (f - 1.0) ** 2, 0.5 * (f - 0.5) ** 2]
            new_v, new_c = ti.Vector([0.0, 0.0]), ti.Matrix([[0.0, 0.0], [0.0, 0.0]])
            for a, b in ti.static(ti.ndrange(3, 3)):
                weight = w[a][0] * w[b][1]
                g = node_velocity[base[1] + b, base[0] + a]
                new_v += weight * g
                new_c += 4.0 / h**2 * weight * g.outer_product((ti.Vector([float(a), float(b)]) - f) * h)
            v[p], c[p] = new_v, new_c
            x[p] += dt * new_v
            xx, yy, xy = dt * new_c[0, 0], dt * new_c[1, 1], 0.5 * dt * (new_c[0, 1] + new_c[1, 0])
            turn = 0.5 * dt * (new_c[0, 1] - new_c[1, 0])
            s = stress[p]
            trial = ti.Vector(
                [
                    s[0] + 2.0 * turn * s[3] + lame * (xx + yy) + 2.0 * shear * xx,
                    s[1] - 2.0 * turn * s[3] + lame * (xx + yy) + 2.0 * shear * yy,
                    s[2] + lame * (xx + yy),
                    s[3] - turn * (s[0] - s[1]) + 2.0 * shear * xy,
                ]
            )
            tangent = ti.tan(friction[p])
            scale = ti.sqrt(9.0 + 12.0 * tangent**2)
            pressure = ti.min((trial[0] + trial[1] + trial[2]) / 3.0, cohesion[p] / ti.max(tangent, 1e-9))
            d = ti.Vector([trial[0] - pressure, trial[1] - pressure, trial[2] - pressure])
            q = ti.sqrt(0.5 * d.dot(d) + trial[3] ** 2)
            strength = (3.0 * cohesion[p] - 3.0 * tangent * pressure) / scale
            factor = ti.min(1.0, ti.max(strength, 0.0) / ti.max(q, 1e-9))
            stress[p] = ti.Vector(
                [pressure + factor * d[0], pressure + factor * d[1], pressure + factor * d[2], factor * trial[3]]
            )
            volume[p] *= 1.0 + xx + yy

    return step
