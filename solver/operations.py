"""The operations of a time step between the transfers, each on all nodes or on a block of particles (see ``step``)."""

import numpy as np

from solver._jit import inlined
from solver.boundary import constrain
from solver.grid import SMALLEST_MASS
from solver.kinematics import rotate_stress, volume_ratio
from solver.laws.registry import update_stress
from solver.softening import Strength
from solver.transfer import gradient, interpolate, spread_momentum

INTERNAL_WORK, GRAVITY_WORK = 0, 1  # entries of the energy ledger


@inlined
def clear_state(grid):
    """Empty the nodes before the particles spread their state to them."""
    grid.mass[:] = 0.0
    grid.momentum[:] = 0.0
    grid.force[:] = 0.0


@inlined
def solve_momentum(grid, gravity, damping, dt):
    """Set nodal acceleration and the velocity at the end of the step from mass, momentum and force.

    Parameters
    ----------
    grid : Grid
        Its ``acceleration`` and ``velocity`` are set, its ``remapped`` is emptied.
    gravity : float
        Downward, in m/s2.
    damping : float
        Share of the unbalanced force that opposes the motion.
    dt : float
        In s.
    """
    for i in range(grid.mass.size):
        has_mass = grid.mass[i] > SMALLEST_MASS
        inverse = 1.0 / grid.mass[i] if has_mass else 0.0
        v_x = grid.momentum[i, 0] * inverse
        v_y = grid.momentum[i, 1] * inverse
        a_x = grid.force[i, 0] * inverse
        a_y = grid.force[i, 1] * inverse - (gravity if has_mass else 0.0)
        a_x -= damping * abs(a_x) * np.sign(v_x)
        a_y -= damping * abs(a_y) * np.sign(v_y)
        grid.acceleration[i, 0] = a_x
        grid.acceleration[i, 1] = a_y
        grid.velocity[i, 0] = v_x + a_x * dt
        grid.velocity[i, 1] = v_y + a_y * dt
        grid.remapped[i, 0] = 0.0
        grid.remapped[i, 1] = 0.0
    constrain(grid.acceleration, grid)
    constrain(grid.velocity, grid)


@inlined
def update_velocity(particles, stencil, grid, moved_x, moved_y, flip_fraction, dt):
    """Accelerate a block of particles and note where they will be at the end of the step.

    Parameters
    ----------
    particles : Particles (n,)
        Their velocities are modified.
    stencil : Stencil
        Their weights.
    grid : Grid
        With acceleration and velocity solved.
    moved_x, moved_y : ndarray (n,)
        Filled with the places in m.
    flip_fraction : float
        1 FLIP, 0 PIC.
    dt : float
        In s.
    """
    for p in range(particles.x.size):
        a_x, a_y = interpolate(grid.acceleration, stencil, p, grid.columns)
        v_x, v_y = interpolate(grid.velocity, stencil, p, grid.columns)
        moved_x[p] = particles.x[p] + v_x * dt
        moved_y[p] = particles.y[p] + v_y * dt
        flip_x = particles.velocity_x[p] + a_x * dt
        flip_y = particles.velocity_y[p] + a_y * dt
        particles.velocity_x[p] = flip_fraction * flip_x + (1.0 - flip_fraction) * v_x
        particles.velocity_y[p] = flip_fraction * flip_y + (1.0 - flip_fraction) * v_y


@inlined
def remap_momentum(particles, stencil, grid):
    """Add the momentum of the accelerated particles to the nodes again."""
    for p in range(particles.x.size):
        m = particles.mass[p]
        momentum_x = m * particles.velocity_x[p]
        momentum_y = m * particles.velocity_y[p]
        spread_momentum(grid.remapped, momentum_x, momentum_y, stencil, p, grid.columns)


@inlined
def remap_velocity(grid):
    """Turn remapped momentum into velocity that respects the walls."""
    for i in range(grid.mass.size):
        inverse = 1.0 / grid.mass[i] if grid.mass[i] > SMALLEST_MASS else 0.0
        grid.remapped[i, 0] *= inverse
        grid.remapped[i, 1] *= inverse
    constrain(grid.remapped, grid)


@inlined
def gather_increments(increment, nodal_velocity, stencil, count, columns, dt):
    """Fill ``increment`` with the displacement gradients ``L dt`` of a block of particles.

    Parameters
    ----------
    increment : ndarray (4, n)
        Filled: xx, xy, yx, yy.
    nodal_velocity : ndarray (nodes, 2)
        In m/s.
    stencil : Stencil
        Weights of the particles.
    count : int
        Of the particles, at most ``n``.
    columns : int
        Of the grid.
    dt : float
        In s.
    """
    for p in range(count):
        xx, xy, yx, yy = gradient(nodal_velocity, stencil, p, columns)
        increment[0, p] = xx * dt
        increment[1, p] = xy * dt
        increment[2, p] = yx * dt
        increment[3, p] = yy * dt


@inlined
def update_material(particles, increment, law, dt):
    """Update stress, plastic strain and volume of a block of particles; return the work of the stresses in J/m.

    Parameters
    ----------
    particles : Particles (n,)
        Modified.
    increment : ndarray (4, n)
        Displacement gradients ``L dt``: xx, xy, yx, yy.
    law : NamedTuple
        Parameters of their law.
    dt : float
        In s.
    """
    work = 0.0
    for p in range(particles.x.size):
        l_xx = increment[0, p]
        l_xy = increment[1, p]
        l_yx = increment[2, p]
        l_yy = increment[3, p]
        shear = 0.5 * (l_xy + l_yx)
        xx, yy, xy = rotate_stress(
            particles.stress_xx[p], particles.stress_yy[p], particles.stress_xy[p], 0.5 * (l_xy - l_yx)
        )
        strength = Strength(
            particles.cohesion[p],
            particles.friction_angle[p],
            particles.cohesion_residual[p],
            particles.friction_angle_residual[p],
        )
        new_xx, new_yy, new_zz, new_xy, plastic_strain = update_stress(
            law, (xx, yy, particles.stress_zz[p], xy), (l_xx, l_yy, shear), particles.plastic_strain[p], strength, dt
        )
        volume = particles.volume[p] * volume_ratio(l_xx, l_xy, l_yx, l_yy)
        mean_volume = 0.5 * (volume + particles.volume[p])
        work += mean_volume * (0.5 * ((xx + new_xx) * l_xx + (yy + new_yy) * l_yy) + (xy + new_xy) * shear)
        particles.stress_xx[p] = new_xx
        particles.stress_yy[p] = new_yy
        particles.stress_zz[p] = new_zz
        particles.stress_xy[p] = new_xy
        particles.plastic_strain[p] = plastic_strain
        particles.volume[p] = volume
    return work


@inlined
def are_inside(x, y, grid):
    """Return whether every place is finite and within the walls, give or take one cell."""
    outside = 0
    for p in range(x.size):
        in_x = x[p] > -grid.cell_size and x[p] < grid.width + grid.cell_size
        in_y = y[p] > -grid.cell_size and y[p] < grid.height + grid.cell_size
        outside += 0 if in_x and in_y else 1
    return outside == 0


@inlined
def move(particles, moved_x, moved_y, grid, gravity, ledger):
    """Put a block of particles at their new places and enter the work of gravity; return whether they are inside.

    Parameters
    ----------
    particles : Particles (n,)
        Their places are modified.
    moved_x, moved_y : ndarray (n,)
        New places in m.
    grid : Grid
    gravity : float
        Downward, in m/s2.
    ledger : ndarray (2,)
        The work of gravity in J/m is added to it.
    """
    fall = 0.0
    for p in range(particles.x.size):
        fall += particles.mass[p] * (particles.y[p] - moved_y[p])
        particles.x[p] = moved_x[p]
        particles.y[p] = moved_y[p]
    ledger[GRAVITY_WORK] += gravity * fall
    return are_inside(particles.x, particles.y, grid)
