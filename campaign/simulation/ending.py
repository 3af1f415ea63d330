"""A march that has ended, and what it takes to measure something of it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from campaign.record import Quantity, Value
from campaign.simulation import field_summary
from campaign.simulation.receptors import ReceptorLog
from campaign.simulation.solver_model import Array, column_edges
from solver import observables
from solver.history import MarchHistory
from solver.model import Model
from solver.particles import Particles
from solver.stopping_distance import farther_advance


@dataclass(frozen=True)
class Ending:
    """A march that has ended, with all that a quantity may be computed from.

    Parameters
    ----------
    model : solver.model.Model
    start : Particles
        The ground from whose places displacement counts: at rest under gravity, with the peak strengths of the
        realization.
    history : solver.history.MarchHistory
        The series in time and the particles at the end.
    begin : float
        When the simulation began, on the clock of `time.perf_counter` [s].
    receptors : ReceptorLog, optional
        What the slide did at the places that the scene names, if there are any.
    field_map : ndarray (p, rows, columns), optional
        Means of ln(property) of the random field over boxes, if they are known.
    """

    model: Model
    start: Particles
    history: MarchHistory
    begin: float
    receptors: ReceptorLog | None = None
    field_map: Array | None = None

    @property
    def particles(self) -> Particles:
        """The particles at the end."""
        return self.history.particles

    @property
    def deposit(self) -> Particles:
        """The particles at the end with their areas before the slide: grains that part gain area, a deposit not."""
        return self.particles._replace(volume=self.start.volume)

    @property
    def half_spacing(self) -> float:
        """Half the distance between particles on their lattice [m]."""
        return 0.5 * self.model.particle_spacing

    @cached_property
    def farther_advance(self) -> float:
        """How much farther the front may come after the end [m]; NaN where nothing bounds it."""
        return farther_advance(self.history, self.model.surface, self.model.criteria)

    def moved_behind_crest(self, farther_than: float) -> float:
        """Return how far behind the crest the ground surface is displaced farther than that [m]."""
        model = self.model
        return observables.moved_behind_crest(
            self.particles, self.start, model.surface, farther_than, model.particle_spacing
        )

    @cached_property
    def edges(self) -> Array:
        """Edges of the columns of the deposit surface [m]."""
        return column_edges(self.model)

    @cached_property
    def at_receptors(self) -> Mapping[str, Value]:
        """What the slide did at receptors, by the names of `receptors.QUANTITIES`."""
        return {} if self.receptors is None else self.receptors.values(self.deposit, self.start)

    @cached_property
    def displaced(self) -> NDArray[np.bool_]:
        """The mask (n,) of the particles that belong to the sliding mass."""
        return observables.is_displaced(self.particles, self.start, self.model.criteria)

    @cached_property
    def field_means(self) -> Mapping[str, Value]:
        """What the ground was that slid, by the names of `field_summary.QUANTITIES`."""
        return field_summary.zone_means(self.particles, self.start, self.displaced)

    @property
    def sizes(self) -> dict[str, int]:
        """The length of each dimension of the record."""
        sizes = {"time": self.history.runout.size, "x": self.edges.size - 1, "particle": self.start.x.size}
        if self.receptors is not None:
            sizes["receptor"] = self.receptors.near.size
        if self.field_map is not None:
            sizes |= zip(("property", "box_y", "box_x"), self.field_map.shape, strict=True)
        return sizes


@dataclass(frozen=True)
class Measured(Quantity):
    """A quantity and the way to it.

    Parameters
    ----------
    compute
        From a march that has ended.
    after_failure
        Whether it means something, too, when the march has failed; else it is missing then.
    """

    compute: Callable[[Ending], Value] = field(kw_only=True)
    after_failure: bool = field(default=False, kw_only=True)


def taken_from(
    source: Callable[[Ending], Mapping[str, Value]], quantities: Mapping[str, Quantity]
) -> dict[str, Measured]:
    """Return quantities that are computed together, each taken by its name from what `source` returns."""

    def take(name: str) -> Callable[[Ending], Value]:
        return lambda end: source(end)[name]

    return {
        name: Measured(quantity.dims, quantity.units, quantity.long_name, quantity.dtype, compute=take(name))
        for name, quantity in quantities.items()
    }
