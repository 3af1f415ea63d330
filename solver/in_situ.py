"""The in-situ state: elastic ground brought to rest under its own weight, the same for every realization."""

import numpy as np

from solver import observables
from solver.constants import STANDARD_GRAVITY
from solver.filling import ground_of
from solver.grid import Grid
from solver.method import Method
from solver.model import Model
from solver.particles import Particles
from solver.scheme import scheme_of
from solver.slide import PAPER
from solver.softening import NO_SOFTENING
from solver.sorting import fill_tiles, read_tiles
from solver.step import allocate_workspace, take_steps
from solver.timestep import stable_step

LOCAL_DAMPING = 0.7  # share of the unbalanced force (Cundall); gone after release
MOST_COURANT = 0.5
UNBALANCED = 1e-4  # of the weight: at rest
STEPS_BETWEEN_CHECKS = 50
MOST_CHECKS = 4000


class NotSettledError(RuntimeError):
    """The ground does not come to rest under its own weight."""


def overburden(model: Model, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the weight in Pa of the ground above each place, ``sum gamma_k thickness_k`` over the layers."""
    weight = np.zeros_like(x)
    tops = [surface.height_at(x) for surface in (model.surface, *model.interfaces)]
    bottoms = [*tops[1:], np.full_like(x, -np.inf)]
    for material, top, bottom in zip(model.materials, tops, bottoms, strict=True):
        weight += material.unit_weight * np.maximum(np.minimum(top, tops[0]) - np.maximum(bottom, y), 0.0)
    return weight


def lay_geostatic_stress(particles: Particles, model: Model) -> None:
    """Start from ``s_yy = -overburden``, ``s_xx = s_zz = nu / (1 - nu) s_yy``, exact under level ground; in place."""
    vertical = -overburden(model, particles.x, particles.y)
    poisson_ratio = np.array([material.poisson_ratio for material in model.materials])[particles.material]
    horizontal = poisson_ratio / (1.0 - poisson_ratio) * vertical
    particles.stress_yy[:] = vertical
    particles.stress_xx[:] = horizontal
    particles.stress_zz[:] = horizontal


def unbalanced_share(grid: Grid, gravity: float) -> float:
    """Return ``||f_int + m gravity|| / ||m g||``, the force over the nodes that may move; NaN on an empty grid."""
    weight = float(np.sum((grid.mass * STANDARD_GRAVITY) ** 2))
    if not weight > 0.0:
        return np.nan
    force_x = grid.force[:, 0] * grid.free_x
    force_y = (grid.force[:, 1] - grid.mass * gravity) * grid.free_y
    return float(np.sqrt((np.sum(force_x**2) + np.sum(force_y**2)) / weight))


def loading_model(model: Model) -> Model:
    """Return the model with all that its in-situ state depends on, and standard values for what matters later only."""
    elastic = tuple(each._replace(law=each.law._replace(softening=NO_SOFTENING)) for each in model.materials)
    return model._replace(
        materials=elastic,
        courant=min(model.courant, MOST_COURANT),
        method=Method(model.method.basis, locking=model.method.locking),
        internal_length=0.0,
        ramp_time=0.0,
        criteria=PAPER,
    )


def in_situ_state(model: Model, from_nothing: bool = False) -> Particles:
    """Return the particles at rest under gravity, unyielding, with zero velocity.

    Parameters
    ----------
    model : Model
    from_nothing : bool
        Gravity is new to ground free of stress, which settles; else the ground is laid with the stress of its
        overburden and stays about where it is.

    Raises
    ------
    NotSettledError
        If the unbalanced force does not fall below 1e-4 of the weight.
    """
    model = loading_model(model)
    particles = ground_of(model)
    if not from_nothing:
        lay_geostatic_stress(particles, model)
    grid = model.allocate_grid()
    work = allocate_workspace(particles.x.size)
    scheme = scheme_of(model.method, damping=LOCAL_DAMPING)
    dt = stable_step(model.courant, model.cell_size, model.wave_speed, 0.0)
    unbalanced = np.inf
    steps = 0
    tiles = fill_tiles(particles, grid, work.tiles)
    for _ in range(MOST_CHECKS):
        tiles, taken = take_steps(
            tiles, grid, work, model.laws, scheme, STANDARD_GRAVITY, 0.0, dt, STEPS_BETWEEN_CHECKS, steps == 0
        )
        read_tiles(tiles, particles)
        steps += STEPS_BETWEEN_CHECKS
        if taken < STEPS_BETWEEN_CHECKS or not np.isfinite(observables.kinetic_energy(particles)):
            break
        unbalanced = unbalanced_share(grid, STANDARD_GRAVITY)
        if unbalanced < UNBALANCED:
            particles.velocity_x[:] = 0.0
            particles.velocity_y[:] = 0.0
            return particles
    raise NotSettledError(
        f"The ground did not come to rest under its own weight in {steps} elastic steps "
        f"(unbalanced force {unbalanced:.1e} of the weight, {UNBALANCED:.0e} wanted); "
        "check young_modulus, unit_weight and the size of the cells."
    )
