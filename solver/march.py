"""Release of strength and the march to rest."""

from collections.abc import Callable

import numpy as np

from solver import observables
from solver.constants import STANDARD_GRAVITY
from solver.energy_guard import MOST_CREATED_EARLY, EnergyGuard
from solver.grid import Grid
from solver.history import MarchEnd, MarchHistory, Moment, moment
from solver.materials import intact_share
from solver.model import Model
from solver.particles import Particles, copy_particles
from solver.rest import RestBy, RestDetector, StandDetector
from solver.sorting import fill_tiles, read_tiles
from solver.step import Workspace, allocate_workspace, take_steps
from solver.timestep import even_steps, largest_courant, stable_step
from solver.walls import Walls, reached_walls

MOST_STEPS_UNCHECKED = 64


class March:
    """One slope on its way from the in-situ state to rest.

    Parameters
    ----------
    model : Model
    start : Particles
        The in-situ state with peak strengths assigned; not modified.
    settled : Particles, optional
        The same ground at rest under gravity, where ``start`` is not: displacement counts from there.
    """

    def __init__(self, model: Model, start: Particles, settled: Particles | None = None) -> None:
        self.model = model
        self.start = start
        self.settled = settled or start
        self.particles = copy_particles(start)
        self.grid: Grid = model.allocate_grid()
        self.work: Workspace = allocate_workspace(start.x.size)
        self.energy = EnergyGuard(
            start, self.particles, self.work.ledger, model.method.flip_fraction, model.criteria.displaced
        )
        self.time = 0.0
        self.steps = 0
        self.reason = ""
        self._tiles = fill_tiles(self.particles, self.grid, self.work.tiles)
        self._take_steps(0, 0.0, are_new=True)  # the grid shows the start

    @property
    def reference(self) -> Particles:
        """The ground from whose places displacement counts: at rest under the gravity of now."""
        if self.settled is self.start:
            return self.start
        share = self._gravity()[0] / STANDARD_GRAVITY
        start, settled = self.start, self.settled
        x, y = start.x + share * (settled.x - start.x), start.y + share * (settled.y - start.y)
        return start._replace(x=x, y=y)

    def moment(self) -> Moment:
        """Return what is seen of the slide now."""
        with np.errstate(over="ignore", invalid="ignore"):  # the next step finds a bad number
            return moment(self.particles, self.reference, self.grid, self.model, self._gravity()[0])

    def reached_walls(self) -> Walls:
        """Return the walls that the slide has reached now."""
        grid = self.grid
        return reached_walls(self.particles, self.reference, grid.width, grid.cell_size, self.model.criteria)

    def advance_to(self, time: float) -> MarchEnd | None:
        """March to ``time`` (s); return why it could not be reached, or None."""
        if self._step_is_unstable():
            return MarchEnd.DIVERGED
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
        method = model.method
        largest = largest_courant(method.basis, method.stress_update)
        if model.courant > largest:
            self.reason = (
                f"The Courant number {model.courant:g} is beyond {largest:g}, the largest that is stable with the "
                f'basis "{method.basis}" and the stress update "{method.stress_update}"; lower numerics.courant.'
            )
        return model.courant > largest

    def _advance_towards(self, goal: float) -> MarchEnd | None:
        speed = observables.fastest(self.particles)
        if not speed < self.model.wave_speed:
            self.reason = f"A particle is faster than the P-wave ({speed:.3g} m/s) at {self.time:.2f} s."
            return MarchEnd.DIVERGED
        dt_most = stable_step(self.model.courant, self.model.cell_size, self.model.wave_speed, speed)
        left = even_steps(goal - self.time, dt_most)
        dt = (goal - self.time) / left
        steps = min(left, MOST_STEPS_UNCHECKED)
        taken = self._take_steps(steps, dt)
        self.steps += taken
        self.time = goal if steps == left else self.time + taken * dt
        if taken < steps:
            return self._left_or_diverged()
        return None

    def _take_steps(self, steps: int, dt: float, are_new: bool = False) -> int:
        gravity, rate = self._gravity()
        model = self.model
        self._tiles, taken = take_steps(
            self._tiles, self.grid, self.work, model.laws, model.scheme, gravity, rate, dt, steps, are_new
        )
        read_tiles(self._tiles, self.particles)
        return int(taken)

    def _left_or_diverged(self) -> MarchEnd:
        if not (np.isfinite(self.particles.x).all() and np.isfinite(self.particles.y).all()):
            self.reason = f"A position is not finite at {self.time:.2f} s."
            return MarchEnd.DIVERGED
        if not observables.fastest(self.particles) < self.model.wave_speed:
            self.reason = (
                f"A particle left the grid faster than the P-wave at {self.time:.2f} s; lower numerics.courant."
            )
            return MarchEnd.DIVERGED
        if self.energy.is_created() or self.energy.is_lost():
            return self.blame_scheme()
        self.reason = f"A particle left the grid {self._way_out()} at {self.time:.2f} s; widen the ground there."
        return MarchEnd.LEFT_DOMAIN

    def _way_out(self) -> str:
        """Return on which side the particle that left is farthest outside."""
        x, y = self.particles.x, self.particles.y
        outside = {
            "on the left": -x.min(),
            "on the right": x.max() - self.grid.width,
            "at the base": -y.min(),
            "at the top": y.max() - self.grid.height,
        }
        return max(outside, key=outside.__getitem__)

    def _gravity(self) -> tuple[float, float]:
        """Return gravity now (m/s2) and its rate (m/s3)."""
        if self.time >= self.model.ramp_time:
            return STANDARD_GRAVITY, 0.0
        rate = STANDARD_GRAVITY / self.model.ramp_time
        return rate * self.time, rate

    def blame_scheme(self) -> MarchEnd:
        """Give what the scheme did to the energy as the reason; return that the march diverged."""
        self.reason = self.energy.complaint()
        return MarchEnd.DIVERGED


def march_to_rest(
    model: Model,
    start: Particles,
    times: np.ndarray,
    watch: Callable[[March], None] = lambda march: None,
    settled: Particles | None = None,
) -> MarchHistory:
    """Release the strength of the in-situ state at time 0 and follow the slide to rest or to the last time.

    Parameters
    ----------
    model : Model
    start : Particles
        The in-situ state with peak and residual strengths assigned; not modified.
    times : ndarray (t,)
        Output times in s, increasing from 0.
    watch : callable
        Called with the march at every output time; what it raises ends the march.
    settled : Particles, optional
        The same ground at rest under gravity, where ``start`` is not: displacement counts from there.
    """
    march = March(model, start, settled)
    series = {name: np.full(times.size, np.nan) for name in Moment._fields}
    rest = RestDetector(model.criteria)
    stand = StandDetector(
        model.criteria,
        model.surface.height,
        model.slowest_period,
        float(start.mass.sum()),
        float(times[-1]),
        model.ramp_time,
    )
    end, rest_by, walls = MarchEnd.END_TIME, RestBy.NEVER, Walls()
    failure = None
    for k, time in enumerate(times):
        failure = march.advance_to(float(time))
        if failure:
            end = failure
            break
        watch(march)
        if march.energy.is_created(MOST_CREATED_EARLY):
            end = failure = march.blame_scheme()
            break
        now = march.moment()
        walls |= march.reached_walls()
        for name, values in series.items():
            values[k:] = getattr(now, name)
        signs = march.time, now.max_displacement, now.kinetic_energy, now.unbalanced_force
        if rest.is_over(*signs):
            end, rest_by = MarchEnd.AT_REST, rest.by
            break
        if stand.stands(*signs, intact_share(march.particles, model.materials)):
            end, rest_by = MarchEnd.STANDS, RestBy.STANDING
            break
    if failure:
        for values in series.values():
            values[k:] = np.nan
    elif march.energy.is_created() or march.energy.is_lost():
        end, rest_by = march.blame_scheme(), RestBy.NEVER
    return MarchHistory(
        time=times,
        end=end,
        reason=march.reason,
        settle_time=march.time if end is MarchEnd.AT_REST else np.nan,
        rest_by=rest_by,
        walls=walls,
        energy_error=march.energy.error(),
        steps=march.steps,
        particles=march.particles,
        reference=march.reference,
        **series,
    )
