"""One explicit GIMP time step, and many of them.

The modified update-stress-last step (MUSL; Sulsky, Zhou and Schreyer 1995, Nairn 2003), with the weights of the places
``x_p`` at the start of the step until the particles move, last of all:

    1  m_i = S_ip m_p,  (mv)_i = S_ip m_p v_p,  f_i = -V_p sigma_p . grad S_ip       particle_to_grid
    2  a_i = f_i / m_i + g,  v_i = (mv)_i / m_i + a_i dt,  walls                     solve_momentum
    3  v_p <- v_p + S_ip a_i dt                                                      update_velocity
    4  v_i <- S_ip m_p v_p / m_i,  walls                                             remap_velocity
    5  L_p = v_i (x) grad S_ip,  sigma_p <- law(sigma_p, L_p dt),  V_p               update_materials
    6  x_p <- x_p + S_ip v_i(2) dt                                                   move

Update-stress-last (USL) leaves out 4; update-stress-first (USF) moves before 4. A step is two passes over the
particles, one for 3 and 4, one for 5, 6 and 1 of the next step, in blocks small enough for the first-level cache. Cell
averages against locking (``mean_dilation``) need all particles at two places, which cuts the second pass in three;
averaged plastic strain (``nonlocal_softening``) follows as a pass of its own. The operations are in ``operations`` and
``transfer``; here they are put together.

All kernels take ``particles`` (n,), the nodes of ``grid`` and scratch arrays ``work``, and modify them; ``laws``, a
tuple with the parameters of each material; a ``scheme``; gravity downward in m/s2; ``dt`` in s.
"""

from typing import NamedTuple

import numpy as np

from solver._jit import kernel
from solver.basis import Stencil, allocate_stencil, evaluate_stencil
from solver.cells import average, clear
from solver.materials import update_materials
from solver.mean_dilation import NO_VOLUME, pool_dilation, pool_pressure, read_pressure, replace_dilation
from solver.nonlocal_softening import average_plastic_strain
from solver.operations import (
    INTERNAL_WORK,
    are_inside,
    clear_state,
    gather_increments,
    move,
    remap_momentum,
    remap_velocity,
    solve_momentum,
    update_velocity,
)
from solver.particles import take_block
from solver.scheme import CELL_AVERAGE, USF, USL
from solver.transfer import particle_to_grid, spread_mass

BLOCK = 128


class Workspace(NamedTuple):
    """Scratch arrays of a march, and the energy ledger it keeps."""

    stencil: Stencil
    increment: np.ndarray  # (4, BLOCK) displacement gradient increments L dt: xx, xy, yx, yy
    normal_stress: np.ndarray  # (2, BLOCK) Pa, xx and yy with the mean of their cells
    increments: np.ndarray  # (blocks, 4, BLOCK) the same of all particles, where cells are averaged
    moved_x: np.ndarray  # (n,) m, places at the end of the step
    moved_y: np.ndarray  # (n,) m
    plastic_strain: np.ndarray  # (n,) at the start of the step, where its increments are averaged
    ledger: np.ndarray  # (2,) J/m: work of the stresses, work of gravity


def allocate_workspace(n_particles: int) -> Workspace:
    """Return scratch space for ``n_particles`` with an empty ledger."""
    return Workspace(
        stencil=allocate_stencil(BLOCK),
        increment=np.empty((4, BLOCK)),
        normal_stress=np.empty((2, BLOCK)),
        increments=np.empty((-(-n_particles // BLOCK), 4, BLOCK)),
        moved_x=np.empty(n_particles),
        moved_y=np.empty(n_particles),
        plastic_strain=np.empty(n_particles),
        ledger=np.zeros(2),
    )


@kernel
def spread_all(particles, grid, work):
    """Operation 1 for all particles."""
    clear_state(grid)
    for start in range(0, particles.x.size, BLOCK):
        block = take_block(particles, start, start + BLOCK)
        evaluate_stencil(work.stencil, block.x, block.y, grid)
        particle_to_grid(block, block.stress_xx, block.stress_yy, block.stress_xy, work.stencil, grid)


@kernel
def pool_all_pressure(particles, grid):
    """Collect the pressure of the cells from all particles."""
    clear(grid.cell_pressure, grid)
    for start in range(0, particles.x.size, BLOCK):
        pool_pressure(take_block(particles, start, start + BLOCK), grid)


@kernel
def spread_all_with_cell_pressure(particles, grid, work):
    """Operation 1 for all particles, with the pooled pressure of the cells in the internal force."""
    average(grid.cell_pressure, NO_VOLUME, grid)
    clear_state(grid)
    for start in range(0, particles.x.size, BLOCK):
        block = take_block(particles, start, start + BLOCK)
        evaluate_stencil(work.stencil, block.x, block.y, grid)
        read_pressure(block, work.normal_stress, grid)
        particle_to_grid(block, work.normal_stress[0], work.normal_stress[1], block.stress_xy, work.stencil, grid)


@kernel
def spread_first(particles, grid, work, scheme):
    """Operation 1 of the first step."""
    if scheme.locking == CELL_AVERAGE:
        pool_all_pressure(particles, grid)
        spread_all_with_cell_pressure(particles, grid, work)
    else:
        spread_all(particles, grid, work)


@kernel
def accelerate(particles, grid, work, scheme, gravity, dt):
    """Operations 3 and 4, the first pass over the particles; return whether all are inside."""
    move_first = scheme.stress_update == USF
    if move_first:
        grid.mass[:] = 0.0
    for start in range(0, particles.x.size, BLOCK):
        stop = start + BLOCK
        block = take_block(particles, start, stop)
        moved_x = work.moved_x[start:stop]
        moved_y = work.moved_y[start:stop]
        evaluate_stencil(work.stencil, block.x, block.y, grid)
        update_velocity(block, work.stencil, grid, moved_x, moved_y, scheme.flip_fraction, dt)
        if move_first:
            if not move(block, moved_x, moved_y, grid, gravity, work.ledger):
                return False
            evaluate_stencil(work.stencil, block.x, block.y, grid)
            spread_mass(block, work.stencil, grid)
        if scheme.stress_update != USL:
            remap_momentum(block, work.stencil, grid)
    remap_velocity(grid)
    return True


@kernel
def deform_each(particles, grid, work, laws, scheme, gravity, dt):
    """Operations 5 and 6, and 1 of the next step, in one pass; return whether all are inside."""
    nodal_velocity = grid.velocity if scheme.stress_update == USL else grid.remapped
    clear_state(grid)
    for start in range(0, particles.x.size, BLOCK):
        stop = start + BLOCK
        block = take_block(particles, start, stop)
        evaluate_stencil(work.stencil, block.x, block.y, grid)
        gather_increments(work.increment, nodal_velocity, work.stencil, block.x.size, grid.columns, dt)
        work.ledger[INTERNAL_WORK] += update_materials(block, work.increment, laws, dt)
        if scheme.stress_update != USF:
            if not move(block, work.moved_x[start:stop], work.moved_y[start:stop], grid, gravity, work.ledger):
                return False
            evaluate_stencil(work.stencil, block.x, block.y, grid)
        particle_to_grid(block, block.stress_xx, block.stress_yy, block.stress_xy, work.stencil, grid)
    return True


@kernel
def deform_cells(particles, grid, work, laws, scheme, gravity, dt):
    """Do the same with the dilation and the pressure of cells, in three passes; return whether all are inside."""
    nodal_velocity = grid.velocity if scheme.stress_update == USL else grid.remapped
    clear(grid.cell_dilation, grid)
    for start in range(0, particles.x.size, BLOCK):
        block = take_block(particles, start, start + BLOCK)
        increment = work.increments[start // BLOCK]
        evaluate_stencil(work.stencil, block.x, block.y, grid)
        gather_increments(increment, nodal_velocity, work.stencil, block.x.size, grid.columns, dt)
        pool_dilation(block, increment, grid)
    average(grid.cell_dilation, NO_VOLUME, grid)
    clear(grid.cell_pressure, grid)
    for start in range(0, particles.x.size, BLOCK):
        stop = start + BLOCK
        block = take_block(particles, start, stop)
        increment = work.increments[start // BLOCK]
        replace_dilation(block, increment, grid)
        work.ledger[INTERNAL_WORK] += update_materials(block, increment, laws, dt)
        moves = scheme.stress_update != USF
        if moves and not move(block, work.moved_x[start:stop], work.moved_y[start:stop], grid, gravity, work.ledger):
            return False
        pool_pressure(block, grid)
    spread_all_with_cell_pressure(particles, grid, work)
    return True


@kernel
def deform(particles, grid, work, laws, scheme, gravity, dt):
    """Operations 5 and 6, and 1 of the next step; return whether all are inside."""
    if scheme.averages_plastic_strain:
        work.plastic_strain[:] = particles.plastic_strain
    if scheme.locking == CELL_AVERAGE:
        are_all_inside = deform_cells(particles, grid, work, laws, scheme, gravity, dt)
    else:
        are_all_inside = deform_each(particles, grid, work, laws, scheme, gravity, dt)
    if scheme.averages_plastic_strain and are_all_inside:
        average_plastic_strain(particles, grid, work.plastic_strain)
    return are_all_inside


@kernel
def advance(particles, grid, work, laws, scheme, gravity, gravity_rate, dt, steps):
    """Take ``steps`` time steps; return how many were taken, fewer if a particle left the grid in the next one.

    Parameters
    ----------
    particles : Particles (n,)
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
    if not are_inside(particles.x, particles.y, grid):
        return 0
    spread_first(particles, grid, work, scheme)
    for step in range(steps):
        g = gravity + gravity_rate * (step + 0.5) * dt
        solve_momentum(grid, g, scheme.damping, dt)
        if not accelerate(particles, grid, work, scheme, g, dt):
            return step
        if not deform(particles, grid, work, laws, scheme, g, dt):
            return step
    return steps
