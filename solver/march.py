"""Release of strength and the march to rest."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from solver import observables
from solver.constants import STANDARD_GRAVITY
from solver.grid import Grid
from solver.model import Model
from solver.operations import GRAVITY_WORK, INTERNAL_WORK
from solver.particles import Particles, copy_particles
from solver.slide import PAPER, Slide
from solver.step import STRESS_UPDATES, Workspace, advance, allocate_workspace
from solver.timestep import even_steps, largest_courant, stable_step

REST_ENERGY = 1e-3  # of the largest kinetic energy
MOST_STEPS_UNCHECKED = 64
MOST_ENERGY_ERROR = 0.02  # of the work of gravity: beyond it the scheme, not the ground, drives or stops the slide
MOST_CREATED_EARLY = 0.05  # the same while the slide goes on: soft ground vibrates before gravity has done much work
MOST_LOST_TO_PIC = 0.005  # the same, for a blend with PIC: a slide that loses so much is a sixth shorter


class Outcome(Enum):
    """How a march ended."""

    AT_REST = "at rest"
    END_TIME = "end time"
    DIVERGED = "diverged"
    LEFT_DOMAIN = "left domain"


@dataclass
class History:
    """Observables of one march at the output times; after rest the last values hold, after a failure NaN."""

    time: np.ndarray  # (t,) s since release
    runout: np.ndarray  # (t,) m
    max_displacement: np.ndarray  # (t,) m
    kinetic_energy: np.ndarray  # (t,) J/m, of the motion resolved by the grid
    outcome: Outcome
    reason: str
    settle_time: float  # s, NaN if it did not come to rest
    energy_error: float  # see March.energy_error
    steps: int
    particles: Particles  # at the end

    @property
    def has_failed(self) -> bool:
        """Whether the march broke off."""
        return self.outcome in (Outcome.DIVERGED, Outcome.LEFT_DOMAIN)


class March:
    """One slope on its way from the in-situ state to rest.

    Parameters
    ----------
    model : Model
    start : Particles
        The in-situ state with peak strengths assigned; not modified.
    """

    def __init__(self, model: Model, start: Particles) -> None:
        self.model = model
        self.start = start
        self.particles = copy_particles(start)
        self.grid: Grid = model.allocate_grid()
        self.work: Workspace = allocate_workspace(start.x.size)
        self.time = 0.0
        self.steps = 0
        self.reason = ""

    def advance_to(self, time: float) -> Outcome | None:
        """March to ``time`` (s); return why it could not be reached, or None."""
        if self._step_is_unstable():
            return Outcome.DIVERGED
        ramp_end = self.model.ramp_time
        goals = [ramp_end, time] if self.time < ramp_end < time else [time]
        for goal in goals:
            while self.time < goal:
                failure = self._advance_towards(goal)
                if failure:
                    return failure
        return None

    def _step_is_unstable(self) -> bool:
        """Refuse a step that is too large before it is taken.

        Shortly beyond its limit a step shakes yielding ground, which eats the energy that it creates: the slide runs
        farther by a quarter while the energy is balanced to two thousandths.
        """
        model = self.model
        stress_update = list(STRESS_UPDATES)[model.scheme.stress_update]
        largest = largest_courant(model.half_length, stress_update)
        if model.courant > largest:
            self.reason = (
                f"The Courant number {model.courant:g} is beyond {largest:g}, the largest that is stable with this "
                f'basis and the stress update "{stress_update}"; lower numerics.courant.'
            )
        return model.courant > largest

    def _advance_towards(self, goal: float) -> Outcome | None:
        speed = observables.fastest(self.particles)
        if not speed < self.model.wave_speed:
            self.reason = f"A particle is faster than the P-wave ({speed:.3g} m/s) at {self.time:.2f} s."
            return Outcome.DIVERGED
        dt_most = stable_step(self.model.courant, self.model.cell_size, self.model.wave_speed, speed)
        left = even_steps(goal - self.time, dt_most)
        dt = (goal - self.time) / left
        steps = min(left, MOST_STEPS_UNCHECKED)
        gravity, rate = self._gravity()
        taken = advance(
            self.particles, self.grid, self.work, self.model.soil, self.model.scheme, gravity, rate, dt, steps
        )
        self.steps += taken
        self.time = goal if steps == left else self.time + taken * dt
        if taken < steps:
            return self._left_or_diverged()
        return None

    def _left_or_diverged(self) -> Outcome:
        if not (np.isfinite(self.particles.x).all() and np.isfinite(self.particles.y).all()):
            self.reason = f"A position is not finite at {self.time:.2f} s."
            return Outcome.DIVERGED
        if not observables.fastest(self.particles) < self.model.wave_speed:
            self.reason = (
                f"A particle left the grid faster than the P-wave at {self.time:.2f} s; lower numerics.courant."
            )
            return Outcome.DIVERGED
        if self.creates_energy() or self.loses_energy():
            return self.blame_scheme()
        self.reason = f"A particle left the grid at {self.time:.2f} s; widen the ground."
        return Outcome.LEFT_DOMAIN

    def _gravity(self) -> tuple[float, float]:
        """Return gravity now (m/s2) and its rate (m/s3)."""
        if self.time >= self.model.ramp_time:
            return STANDARD_GRAVITY, 0.0
        rate = STANDARD_GRAVITY / self.model.ramp_time
        return rate * self.time, rate

    def energy_error(self) -> float:
        """Return (kinetic energy gained + work of the stresses - work of gravity) over the energy put in.

        What is put in is the work of gravity and the kinetic energy of the start. The work of the stresses is what they
        store plus what plastic flow dissipates, so the error is what the transfers between particles and grid create
        (> 0) or destroy (< 0).
        """
        internal = self.work.ledger[INTERNAL_WORK]
        released = self.work.ledger[GRAVITY_WORK]
        brought = observables.kinetic_energy(self.start)
        imbalance = observables.kinetic_energy(self.particles) - brought + internal - released
        put_in = abs(released) + brought
        return float(imbalance / put_in) if put_in > 0.0 else 0.0

    def creates_energy(self, most: float = MOST_ENERGY_ERROR) -> bool:
        """Whether a slope that moves has gained more energy than gravity gave, the mark of an unstable step.

        It shows best at the start, before gravity has done much work: later, plastic flow eats what was created.
        """
        return self._has_moved and not self.energy_error() <= most

    def loses_energy(self) -> bool:
        """Whether a slope that moved has lost energy to the scheme, the mark of numerical damping."""
        most = MOST_ENERGY_ERROR if self.model.scheme.flip_fraction == 1.0 else MOST_LOST_TO_PIC
        return self._has_moved and not self.energy_error() >= -most

    @property
    def _has_moved(self) -> bool:
        return bool(observables.displacement(self.particles, self.start).max() > self.model.slide.displaced)

    def blame_scheme(self) -> Outcome:
        """Give what the scheme did to the energy as the reason; return the outcome."""
        error = self.energy_error()
        verb = "destroyed" if error < 0.0 else "created"
        remedy = "set numerics.flip to 1" if self.model.scheme.flip_fraction != 1.0 else "lower numerics.courant"
        self.reason = f"The scheme {verb} energy, {abs(error):.1%} of the work of gravity; {remedy}."
        return Outcome.DIVERGED


class RestDetector:
    """Decide that a slide is over: it has moved, and its energy and its advance have stayed small for a while."""

    def __init__(self, slide: Slide = PAPER) -> None:
        self._slide = slide
        self._largest_energy = 0.0
        self._last = (0.0, 0.0)
        self._quiet_since = np.nan

    def is_over(self, time: float, farthest: float, energy: float) -> bool:
        """Return whether the slide has come to rest at ``time`` (s), given largest displacement (m) and energy."""
        self._largest_energy = max(self._largest_energy, energy)
        last_time, last_farthest = self._last
        self._last = (time, farthest)
        has_stopped = abs(farthest - last_farthest) < self._slide.rest_speed * (time - last_time)
        if not (has_stopped and farthest > self._slide.failed and energy < REST_ENERGY * self._largest_energy):
            self._quiet_since = np.nan
        elif np.isnan(self._quiet_since):
            self._quiet_since = time
        return bool(time - self._quiet_since >= self._slide.rest_time - 1e-9)


def run(
    model: Model,
    start: Particles,
    times: np.ndarray,
    watch: Callable[[March], None] = lambda march: None,
) -> History:
    """Release the strength of the in-situ state at time 0 and follow the slide to rest or to the last time.

    Parameters
    ----------
    model : Model
    start : Particles
        The in-situ state with peak strengths assigned; not modified.
    times : ndarray (t,)
        Output times in s, increasing from 0.
    watch : callable
        Called with the march at every output time; what it raises ends the march.
    """
    march = March(model, start)
    series = {name: np.full(times.size, np.nan) for name in ("runout", "max_displacement", "kinetic_energy")}
    rest = RestDetector(model.slide)
    outcome = Outcome.END_TIME
    failure = None
    for k, time in enumerate(times):
        failure = march.advance_to(float(time))
        if failure:
            outcome = failure
            break
        watch(march)
        if march.creates_energy(MOST_CREATED_EARLY):
            outcome = failure = march.blame_scheme()
            break
        now = march.particles
        farthest = float(observables.displacement(now, start).max())
        energy = observables.resolved_kinetic_energy(march.grid)
        series["runout"][k] = observables.runout(now, start, model.surface, model.slide)
        series["max_displacement"][k] = farthest
        series["kinetic_energy"][k] = energy
        if rest.is_over(march.time, farthest, energy):
            outcome = Outcome.AT_REST
            for values in series.values():
                values[k + 1 :] = values[k]
            break
    if not failure and (march.creates_energy() or march.loses_energy()):
        outcome = march.blame_scheme()
    return History(
        time=times,
        outcome=outcome,
        reason=march.reason,
        settle_time=march.time if outcome is Outcome.AT_REST else np.nan,
        energy_error=march.energy_error(),
        steps=march.steps,
        particles=march.particles,
        **series,
    )
