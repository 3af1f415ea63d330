"""Loading so slowly that inertia does not matter: a rigid footing, and strength reduced until the ground fails.

Stresses settle under local damping (Cundall). The soil is perfectly plastic and so stiff that the geometry at collapse
is still the initial one; a limit load depends on neither the stiffness nor the path.
"""

import math

import numpy as np

from solver import observables
from solver._jit import kernel
from solver.balance import unbalanced_share
from solver.constants import STANDARD_GRAVITY
from solver.deformation import deform
from solver.filling import ground_of
from solver.grid import PADDING, SMALLEST_MASS
from solver.in_situ import LOCAL_DAMPING, in_situ_state
from solver.laws.registry import Constants, make_law
from solver.materials import Material
from solver.method import Method
from solver.model import Model
from solver.operations import solve_momentum
from solver.particles import copy_particles
from solver.scheme import scheme_of
from solver.softening import NO_SOFTENING
from solver.sorting import fill_tiles, read_tiles, sort_if_due
from solver.spread import spread_all
from solver.step import accelerate, advance, allocate_workspace
from solver.surface import Surface
from solver.tiles import SORTS, after_sorts
from solver.timestep import stable_step

PRANDTL = 2.0 + math.pi  # exact limit of a strip load over the cohesion, on Tresca ground
YOUNG_MODULUS, POISSON_RATIO = 1e9, 0.3
COURANT = 0.5
STEPS = 100  # between two looks
AT_REST = 2e-4  # unbalanced force over weight
MOST_LOOKS = 300
STEP_OF_STRENGTH = 1.01


def quasi_static_model(surface, cell_size, unit_weight, locking, young_modulus=YOUNG_MODULUS, law="mohr-coulomb"):
    """Return a uGIMP model, four particles a cell, without softening."""
    constants = Constants(young_modulus, POISSON_RATIO, 0.0, NO_SOFTENING)
    return Model(
        surface=surface,
        materials=(Material(unit_weight / STANDARD_GRAVITY, POISSON_RATIO, make_law(law, constants)),),
        cell_size=cell_size,
        particles_per_cell=4,
        method=Method(locking=locking),
        courant=COURANT,
    )


def damped(model):
    """Return the scheme of a model with local damping."""
    return scheme_of(model.method, damping=LOCAL_DAMPING)


@kernel
def prescribe(grid, footing, velocity, dt):
    """Hold the ``footing`` (n, 2: row, column) at ``velocity`` downward, not sideways; return the force in N/m."""
    force = 0.0
    for row, i in footing:
        if grid.mass[row, i] > SMALLEST_MASS:
            force += grid.force[row, 1, i]
            grid.acceleration[row, 0, i] = -grid.momentum[row, 0, i] / grid.mass[row, i] / dt
            grid.acceleration[row, 1, i] = (-velocity - grid.momentum[row, 1, i] / grid.mass[row, i]) / dt
        grid.velocity[row, 0, i] = 0.0
        grid.velocity[row, 1, i] = -velocity
    return force


def push(particles, grid, work, laws, scheme, footing, velocity, dt, steps):
    """Push a rough rigid footing into weightless ground; return the mean force in N/m."""
    tiles = fill_tiles(particles, grid, work.tiles)
    force = _push(tiles, grid, work, laws, scheme, footing, velocity, dt, steps)
    read_tiles(after_sorts(tiles), particles)
    return force / steps


@kernel
def _push(tiles, grid, work, laws, scheme, footing, velocity, dt, steps):
    force = 0.0
    tiles.counts[SORTS] = 0
    spread_all(tiles, grid, scheme)
    for _ in range(steps):
        tiles = sort_if_due(tiles, grid)
        solve_momentum(grid, 0.0, scheme.damping, dt)
        force += prescribe(grid, footing, velocity, dt)
        accelerate(tiles, grid, work, scheme, 0.0, dt)
        for row, i in footing:
            for axis in range(2):  # no slices, whose assignment Numba compiles for seconds
                grid.remapped[row, axis, i] = grid.velocity[row, axis, i]
        deform(tiles, grid, work.ledger, laws, scheme, 0.0, dt)
    return force


def bearing_pressure(cells, locking, settlement=0.003, samples=40, steps=500, law="mohr-coulomb"):
    """Return pressure over cohesion against settlement, for half a footing ``cells`` cells wide on Tresca ground.

    The settlement is in widths, with ``E = 10^4 c``. The velocity of the ground falls to zero in the cell beside the
    last footing node, so the width of the footing ends in the middle of that cell. Ended at its last node the pressures
    are ``1 + 1 / (2 cells)`` times larger and tend to the same limit.
    """
    cohesion, half_width, depth = 1e4, 1.0, 2.0
    cell = half_width / cells
    ground = Surface(np.array([0.0, 4.0]), np.array([depth, depth]))
    model = quasi_static_model(ground, cell, 20e3, locking, young_modulus=1e4 * cohesion, law=law)
    particles = ground_of(model)
    particles.cohesion[:] = cohesion
    grid, work = model.allocate_grid(), allocate_workspace(particles.x.size)
    row = round(depth / cell) + PADDING
    # And the nodes above, which a heaving particle reaches.
    footing = np.array([(row + above, i) for above in (0, 1) for i in range(PADDING + cells + 1)])
    dt = stable_step(COURANT, cell, model.wave_speed, 0.0)
    velocity = 2.0 * half_width * settlement / (samples * steps * dt)
    scheme = damped(model)
    forces = [push(particles, grid, work, model.laws, scheme, footing, velocity, dt, steps) for _ in range(samples)]
    return np.array(forces) / (cohesion * (half_width + 0.5 * cell))


def comes_to_rest(particles, grid, work, model):
    """Return whether the unbalanced force dies before the ground has moved twice ``gamma H^2 / E``."""
    before = copy_particles(particles)
    height = model.surface.top - model.surface.y[-1]
    far = 2.0 * model.materials[0].density * STANDARD_GRAVITY * height**2 / YOUNG_MODULUS
    dt = stable_step(COURANT, model.cell_size, model.wave_speed, 0.0)
    for look in range(MOST_LOOKS):
        advance(particles, grid, work, model.laws, damped(model), STANDARD_GRAVITY, 0.0, dt, STEPS)
        if observables.displacement(particles, before).max() > far:
            return False
        if look > 0 and unbalanced_share(grid, STANDARD_GRAVITY) < AT_REST:
            return True
    return False


def factor_of_safety(model, cohesion, friction_angle, first):
    """Return the factor that strength is divided by at collapse, between the last that holds and the first that fails.

    Gravity acts on elastic ground; then strength falls by 1 % at a time, each time until the ground is at rest again.
    Restarting from elastic ground for every factor would give the same limit in more steps, and an overshoot besides.
    """
    particles = in_situ_state(model)
    grid, work = model.allocate_grid(), allocate_workspace(particles.x.size)
    factor = first
    while True:
        particles.cohesion[:] = cohesion / factor
        particles.friction_angle[:] = math.atan(math.tan(friction_angle) / factor)
        if not comes_to_rest(particles, grid, work, model):
            assert factor > first, f"the ground fails at the first factor {first}"
            return factor / math.sqrt(STEP_OF_STRENGTH)
        factor *= STEP_OF_STRENGTH
