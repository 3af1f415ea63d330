"""The in-situ state: elastic ground brought to rest under its own weight, the same for every realization.

The ground swings under local damping (Cundall 1987), which opposes the motion of a node by a share ``alpha`` of its
unbalanced force: a swing leaves ``(1 - alpha) / (1 + alpha)`` of itself, whatever its frequency. The ground is at rest
when the unbalanced force of the nodes is small.

On some surfaces it never is. Where a few particles of a bump are all that more nodes than particles carry, nodal forces
can cancel at the particles, ``sum_i S_ip f_i / m_i = 0``. They move nothing, and so they stay. Damped, they no longer
cancel, and hold the particles up to a share ``alpha`` of themselves out of balance, as dry friction does. So once the
unbalanced force falls no more, the damping fades, and the ground is at rest when the force that particles feel is
small. Particles may still swing then: their speed is taken away, and that force is all that is left of the swing.
"""

import numpy as np

from solver import observables
from solver.balance import felt_share, unbalanced_share
from solver.constants import STANDARD_GRAVITY
from solver.laws.registry import unyielding
from solver.method import Method
from solver.model import Model
from solver.overburden import overburden
from solver.particles import Particles, copy_particles
from solver.pore_pressure import wet_ground_of
from solver.scheme import scheme_of
from solver.slide import PAPER
from solver.sorting import fill_tiles, read_tiles
from solver.step import allocate_workspace, take_steps
from solver.timestep import stable_step

LOCAL_DAMPING = 0.7  # share of the unbalanced force; gone after release
LEAST_DAMPING = 0.01  # when it has faded to this, what does not rest never will
MOST_COURANT = 0.5
UNBALANCED = 1e-4  # of the weight: at rest
STEPS_BETWEEN_CHECKS = 50
FALL = 0.8  # of the least force so far: what is not below it has not fallen
PATIENCE = 10_000  # steps; on cuts, benches, notches and columns that come to rest it falls by so much within 7500
PATIENCE_PERIODS = 2.0  # of the slowest swing, of which the damping then leaves less than a tenth


class NotSettledError(RuntimeError):
    """The ground does not come to rest under its own weight."""


def lay_geostatic_stress(particles: Particles, model: Model) -> None:
    """Start from ``s_yy = u + uplift - weight above``, ``s_xx = s_zz = K_0 s_yy``; true of level ground."""
    x, y = particles.x, particles.y
    lifted = model.water.uplift(model.surface.height_at(x), y)
    vertical = particles.pore_pressure + lifted - overburden(model, x, y)
    horizontal = np.array([material.horizontal_share for material in model.materials])[particles.material] * vertical
    particles.stress_yy[:] = vertical
    particles.stress_xx[:] = horizontal
    particles.stress_zz[:] = horizontal


def loading_model(model: Model) -> Model:
    """Return the model with all that its in-situ state depends on, and standard values for what matters later only."""
    elastic = tuple(each._replace(law=unyielding(each.law)) for each in model.materials)
    return model._replace(
        materials=elastic,
        courant=min(model.courant, MOST_COURANT),
        method=Method(model.method.basis, locking=model.method.locking),
        internal_length=0.0,
        ramp_time=0.0,
        criteria=PAPER,
    )


class Stall:
    """Whether a force falls no more: none of the last ``patience`` checks was a fifth below the least before."""

    def __init__(self, patience: int) -> None:
        self._patience = patience
        self._least = np.inf
        self._checks = 0

    def has_come(self, force: float) -> bool:
        """Return whether the force falls no more, after a check that found ``force``."""
        self._checks += 1
        if force < FALL * self._least:
            self._least, self._checks = force, 0
        return self._checks >= self._patience


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
        If neither the unbalanced force of the nodes nor that which particles feel falls below 1e-4 of the weight.
    """
    model = loading_model(model)
    drawn = wet_ground_of(model)
    particles = copy_particles(drawn)
    if not from_nothing:
        lay_geostatic_stress(particles, model)
    grid = model.allocate_grid()
    work = allocate_workspace(particles.x.size)
    scheme = scheme_of(model.method, damping=LOCAL_DAMPING)
    dt = stable_step(model.courant, model.cell_size, model.wave_speed, 0.0)
    patience = int(max(PATIENCE, PATIENCE_PERIODS * model.slowest_period / dt) / STEPS_BETWEEN_CHECKS)
    stall, has_stalled = Stall(patience), False
    steps = 0
    tiles = fill_tiles(particles, grid, work.tiles)
    while scheme.damping > LEAST_DAMPING:
        tiles, taken = take_steps(
            tiles, grid, work, model.laws, scheme, STANDARD_GRAVITY, 0.0, dt, STEPS_BETWEEN_CHECKS, steps == 0
        )
        read_tiles(tiles, particles)
        steps += STEPS_BETWEEN_CHECKS
        if taken < STEPS_BETWEEN_CHECKS or not np.isfinite(observables.kinetic_energy(particles)):
            raise NotSettledError(
                f"The ground did not come to rest under its own weight: it fell apart within {steps} elastic steps; "
                "check young_modulus, unit_weight and the size of the cells."
            )
        unbalanced = unbalanced_share(grid, STANDARD_GRAVITY)
        has_stalled = has_stalled or stall.has_come(unbalanced)
        if has_stalled:
            unbalanced = min(unbalanced, felt_share(tiles, grid, STANDARD_GRAVITY))
            scheme = scheme._replace(damping=scheme.damping * (1.0 - 4.0 / patience))
        if unbalanced < UNBALANCED:
            particles.velocity_x[:] = 0.0
            particles.velocity_y[:] = 0.0
            # The water is that which is drawn, however much the ground is compressed.
            particles.pore_area[:] *= particles.volume / drawn.volume
            particles.pore_pressure[:] = drawn.pore_pressure
            return particles
    fastest = np.argmax(np.hypot(particles.velocity_x, particles.velocity_y))
    x, y = particles.x[fastest], particles.y[fastest]
    raise NotSettledError(
        f"The ground did not come to rest under its own weight in {steps} elastic steps (unbalanced force "
        f"{unbalanced:.1e} of the weight, {UNBALANCED:.0e} wanted): it still moves at x = {x:.4g} m, y = {y:.4g} m; "
        "check young_modulus and unit_weight, smooth the surface there, or change the size of the cells."
    )
