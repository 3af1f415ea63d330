"""What a slide does at the places that a scene names: whether and when it comes, how deep and how fast.

A receptor is looked at through columns, at least one cell wide, because the mesh sees nothing narrower: a point through
one that has it in its middle, a range through as many as it is cells long. What is told of a range is the largest of
its columns. All of it is seen at the output times.
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
        PLACE, "m", "largest vertical thickness of moved ground at the receptor, pushed ground below it included"
    ),
    "receptor_max_velocity": Quantity(
        PLACE, "m/s", "largest velocity of moved ground at the receptor, averaged over its depth"
    ),
    "receptor_momentum_flux": Quantity(
        PLACE, "N/m", f"largest momentum flux rho h v^2 at the receptor, per metre run, {FREE}"
    ),
    "receptor_impact_pressure": Quantity(PLACE, "Pa", f"largest impact pressure rho v^2 at the receptor, {FREE}"),
    "receptor_depth": Quantity(
        (*PLACE, "time"), "m", "vertical thickness of moved ground at the receptor, pushed ground included", "f4"
    ),
    "receptor_velocity": Quantity(
        (*PLACE, "time"), "m/s", "velocity of moved ground at the receptor, averaged over its depth", "f4"
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

    def observe(self, march: March) -> None:
        """Look at the march at the next output time."""
        model, k = self._model, self._seen
        self._seen += 1
        reference = march.reference
        moved = observables.is_displaced(march.particles, reference, model.criteria)
        flow = self._through(march.particles, reference, moved)
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
        depth, velocity, momentum_flux, impact_pressure = self._flow
        return {
            "front_reaches": self._front.any(axis=1).astype(float),
            "front_arrival": self._first_time(self._front),
            "moved_ground_reaches": self._moved.any(axis=1).astype(float),
            "moved_ground_arrival": self._first_time(self._moved),
            "receptor_deposit": self._largest(rise),
            "receptor_max_depth": depth.max(axis=1),
            "receptor_max_velocity": velocity.max(axis=1),
            "receptor_momentum_flux": momentum_flux.max(axis=1),
            "receptor_impact_pressure": impact_pressure.max(axis=1),
            "receptor_depth": depth,
            "receptor_velocity": velocity,
        }

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
