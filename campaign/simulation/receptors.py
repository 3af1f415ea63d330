"""What a slide does at the places that a scene names: whether and when it comes, how deep and how fast.

A receptor is looked at through columns, at least one cell wide, because the mesh sees nothing narrower: a point through
one that has it in its middle, a range through as many as it is cells long. What is told of a range is the largest of
its columns. All of it is seen at the output times.

Two kinds of ground come: that of the slide, from the arrival of its front on, and ahead of it ground that is pushed or
thrown. The largest of either is told for itself, because a clod that flies ahead is fast and weighs little.

Velocities are those at which ground has moved since the last output time. The particles' own hold differences inside a
cell that move nothing (see `solver.observables.resolved_kinetic_energy`), of metres per second in a deposit at rest.
"""

import numpy as np
from numpy.typing import NDArray

from campaign.record import Quantity, Value
from campaign.simulation.solver_model import Array
from solver import observables
from solver.flow import Flow, flow_through
from solver.march import March
from solver.model import Model
from solver.particles import Particles

NO_RECEPTORS: Array = np.empty((0, 2))
"""The ends of no receptor."""

PLACE = ("receptor",)
FREE = "of the free flow, with no structure in its way"
COME = "from the arrival of the front on, 0 where it does not come"
AHEAD = "of ground pushed or thrown ahead, before the front arrives or where it does not come"

QUANTITIES: dict[str, Quantity] = {
    "front_reaches": Quantity(
        PLACE,
        "1",
        "1 where the front of the slide reaches the receptor, else 0: slide.front_area of slid ground from upslope of "
        "the toe gets beyond its near end; upslope of the toe, slid ground is there",
    ),
    "front_arrival": Quantity(PLACE, "s", "first output time at which the front of the slide has reached the receptor"),
    "moved_ground_reaches": Quantity(
        PLACE,
        "1",
        "1 where ground displaced farther than slide.displaced is at the receptor, pushed and heaved too, else 0",
    ),
    "moved_ground_arrival": Quantity(PLACE, "s", "first output time at which moved ground is at the receptor"),
    "receptor_deposit": Quantity(
        PLACE, "m", "largest final rise of the ground surface at the receptor; negative where ground is lost"
    ),
    "receptor_max_depth": Quantity(
        PLACE,
        "m",
        f"largest vertical thickness of moved ground at the receptor, pushed ground below it included, {COME}",
    ),
    "receptor_max_velocity": Quantity(
        PLACE, "m/s", f"largest velocity of moved ground at the receptor, averaged over its depth, {COME}"
    ),
    "receptor_momentum_flux": Quantity(
        PLACE, "N/m", f"largest momentum flux rho h v^2 at the receptor, per metre run, {FREE}, {COME}"
    ),
    "receptor_impact_pressure": Quantity(
        PLACE, "Pa", f"largest impact pressure rho v^2 at the receptor, {FREE}, {COME}"
    ),
    "receptor_ahead_depth": Quantity(PLACE, "m", f"largest vertical thickness at the receptor {AHEAD}"),
    "receptor_ahead_velocity": Quantity(
        PLACE, "m/s", f"largest velocity at the receptor, averaged over the depth, {AHEAD}"
    ),
    "receptor_ahead_momentum_flux": Quantity(
        PLACE, "N/m", f"largest momentum flux rho h v^2 at the receptor, per metre run, {AHEAD}"
    ),
    "receptor_ahead_impact_pressure": Quantity(
        PLACE, "Pa", f"largest impact pressure rho v^2 at the receptor, {AHEAD}"
    ),
    "receptor_depth": Quantity(
        (*PLACE, "time"),
        "m",
        "vertical thickness of moved ground at the receptor, pushed or thrown ground included",
        "f4",
    ),
    "receptor_velocity": Quantity(
        (*PLACE, "time"),
        "m/s",
        "velocity of moved ground at the receptor since the last output time, averaged over its depth, pushed or "
        "thrown ground included",
        "f4",
    ),
}
"""What is measured at each receptor."""


def columns_of(stretch: Array, cell: float, width: float) -> Array:
    """Return the edges (k, 2) in m of the columns through which a receptor is looked at.

    Parameters
    ----------
    stretch : ndarray (2,)
        Near and far end of the receptor in m, between the walls.
    cell : float
        Their least width in m.
    width : float
        Distance between the walls in m.
    """
    middle, length = np.mean(stretch), max(cell, float(np.ptp(stretch)))
    left = np.clip(middle - 0.5 * length, 0.0, width - length)
    edges = left + np.linspace(0.0, length, int(length / cell + 1e-9) + 1)
    return np.column_stack([edges[:-1], edges[1:]])


class ReceptorLog:
    """Follows a march and keeps what it does at r receptors, at each of t output times.

    Parameters
    ----------
    stretches : ndarray (r, 2)
        Near and far end of each receptor in m.
    model : solver.model.Model
    times : ndarray (t,)
        Output times in s.
    """

    def __init__(self, stretches: Array, model: Model, times: Array) -> None:
        self.near = stretches[:, 0]
        self._columns_of = [columns_of(stretch, model.cell_size, model.surface.width) for stretch in stretches]
        self.columns = np.concatenate(self._columns_of)
        self._first = np.cumsum([0, *map(len, self._columns_of[:-1])])
        self._model, self._times, self._seen = model, times, 0
        self._flow = Flow(*np.full((4, len(stretches), times.size), np.nan))
        self._front, self._moved = np.zeros((2, len(stretches), times.size), dtype=bool)
        self._last: Particles | None = None

    def observe(self, march: March) -> None:
        """Look at the march at the next output time."""
        model, k = self._model, self._seen
        self._seen += 1
        reference = march.reference
        moved = observables.is_displaced(march.particles, reference, model.criteria)
        flow = self._through(self._as_it_moved(march.particles), reference, moved)
        for series, now in zip(self._flow, flow, strict=True):
            series[:, k] = self._largest(now)
        self._front[:, k] = self._has_front(march.particles, reference, moved)
        self._moved[:, k] = self._front[:, k] | (self._flow.depth[:, k] > 0.0)

    def values(self, deposit: Particles, start: Particles) -> dict[str, Value]:
        """Return the values of `QUANTITIES` after a march without failure.

        Parameters
        ----------
        deposit, start : Particles
            At the end, with the areas before the slide, and before it.
        """
        for series in (*self._flow, self._front, self._moved):  # at rest the last values hold
            series[:, self._seen :] = series[:, self._seen - 1 : self._seen]
        every = np.ones(start.x.size, dtype=bool)
        rise = self._through(deposit, start, every).depth - self._through(start, start, every).depth
        has_come = np.logical_or.accumulate(self._front, axis=1)
        come, ahead = (
            Flow(*(series.max(axis=1, where=when, initial=0.0) for series in self._flow))
            for when in (has_come, ~has_come)
        )
        return {
            "front_reaches": self._front.any(axis=1).astype(float),
            "front_arrival": self._first_time(self._front),
            "moved_ground_reaches": self._moved.any(axis=1).astype(float),
            "moved_ground_arrival": self._first_time(self._moved),
            "receptor_deposit": self._largest(rise),
            "receptor_max_depth": come.depth,
            "receptor_max_velocity": come.velocity,
            "receptor_momentum_flux": come.momentum_flux,
            "receptor_impact_pressure": come.impact_pressure,
            "receptor_ahead_depth": ahead.depth,
            "receptor_ahead_velocity": ahead.velocity,
            "receptor_ahead_momentum_flux": ahead.momentum_flux,
            "receptor_ahead_impact_pressure": ahead.impact_pressure,
            "receptor_depth": self._flow.depth,
            "receptor_velocity": self._flow.velocity,
        }

    def _as_it_moved(self, particles: Particles) -> Particles:
        """Return the particles with the velocities at which they have moved since the last output time."""
        last, k = self._last, self._seen - 1
        self._last = particles._replace(x=particles.x.copy(), y=particles.y.copy())
        if last is None:
            return particles._replace(velocity_x=np.zeros_like(particles.x), velocity_y=np.zeros_like(particles.y))
        since = self._times[k] - self._times[k - 1]
        return particles._replace(velocity_x=(particles.x - last.x) / since, velocity_y=(particles.y - last.y) / since)

    def _through(self, particles: Particles, start: Particles, moved: NDArray[np.bool_]) -> Flow:
        return flow_through(particles, start, moved, 0.5 * self._model.particle_spacing, self.columns)

    def _largest(self, of_columns: Array) -> Array:
        return np.asarray(np.maximum.reduceat(of_columns, self._first))

    def _has_front(self, particles: Particles, start: Particles, moved: NDArray[np.bool_]) -> NDArray[np.bool_]:
        surface, criteria = self._model.surface, self._model.criteria
        runout = observables.runout_mass(particles, start, surface, criteria)
        passed = np.asarray((runout > 0.0) & (surface.toe_x + runout >= self.near))
        upslope = self.near < surface.toe_x
        if not upslope.any():
            return passed
        slid = self._through(particles, start, moved & observables.slope_body(start, surface))
        return np.where(upslope, self._largest(slid.depth) > 0.0, passed)

    def _first_time(self, is_there: NDArray[np.bool_]) -> Array:
        return np.where(is_there.any(axis=1), self._times[is_there.argmax(axis=1)], np.nan)
