"""What is measured in a realization: one table, from which records, dataset and documentation follow.

A new quantity is a new row. `python -m campaign.simulation.quantities` prints the table for README.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from campaign.record import Average, Quantity, Value, missing_values, plain, units_of, with_dims
from campaign.simulation import receptors
from campaign.simulation.detachment import detached_volume
from campaign.simulation.receptors import ReceptorLog
from campaign.simulation.solver_model import Array, column_edges
from solver import observables
from solver.march import MarchHistory
from solver.model import Model
from solver.particles import Particles


@dataclass(frozen=True)
class Ending:
    """A march that has ended, with all that a quantity may be computed from.

    Parameters
    ----------
    model : solver.model.Model
    start : Particles
        The in-situ state with the peak strengths of the realization.
    history : solver.march.MarchHistory
        The series in time and the particles at the end.
    begin : float
        When the simulation began, on the clock of `time.perf_counter` [s].
    receptors : ReceptorLog, optional
        What the slide did at the places that the scene names, if there are any.
    """

    model: Model
    start: Particles
    history: MarchHistory
    begin: float
    receptors: ReceptorLog | None = None

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
    def edges(self) -> Array:
        """Edges of the columns of the deposit surface [m]."""
        return column_edges(self.model)

    @cached_property
    def at_receptors(self) -> Mapping[str, Value]:
        """What the slide did at receptors, by the names of `receptors.QUANTITIES`."""
        return {} if self.receptors is None else self.receptors.values(self.deposit, self.start)

    @property
    def sizes(self) -> dict[str, int]:
        """The length of each dimension of the record."""
        sizes = {"time": self.history.runout.size, "x": self.edges.size - 1, "particle": self.start.x.size}
        return sizes if self.receptors is None else sizes | {"receptor": self.receptors.near.size}


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


DISPLACED = Average(
    "influence_probability",
    "share of the realizations without failure in which the particle is displaced farther than slide.displaced",
)

QUANTITIES: dict[str, Measured] = {
    "runout": Measured(
        ("time",),
        "m",
        "advance of the sliding front from the initial toe",
        compute=lambda end: end.history.runout,
        after_failure=True,
    ),
    "max_displacement": Measured(
        ("time",),
        "m",
        "largest particle displacement since release",
        compute=lambda end: end.history.max_displacement,
        after_failure=True,
    ),
    "kinetic_energy": Measured(
        ("time",),
        "J/m",
        "kinetic energy per metre run",
        compute=lambda end: end.history.kinetic_energy,
        after_failure=True,
    ),
    "final_runout": Measured(
        (),
        "m",
        "final advance of the front-most slid particle from the initial toe",
        compute=lambda end: end.history.runout[-1],
    ),
    "final_runout_mass": Measured(
        (),
        "m",
        "final advance of the front beyond which slide.front_area of slid material lies",
        compute=lambda end: observables.runout_mass(end.particles, end.start, end.model.surface, end.model.criteria),
    ),
    "sliding_volume": Measured(
        (),
        "m3/m",
        "volume displaced farther than slide.displaced, per metre run",
        compute=lambda end: observables.sliding_volume(end.particles, end.start, end.model.criteria),
    ),
    "detached_volume": Measured(
        (),
        "m3/m",
        "volume that has come apart and lies ahead of the slide, per metre run",
        compute=lambda end: detached_volume(end.particles, end.start, end.model.surface, end.model.allocate_grid()),
    ),
    "settle_time": Measured(
        (), "s", "time from release to rest", compute=lambda end: end.history.settle_time, after_failure=True
    ),
    "energy_error": Measured(
        (), "1", "energy imbalance over the work of gravity", compute=lambda end: end.history.energy_error
    ),
    "steps": Measured((), "1", "number of time steps", "i8", compute=lambda end: end.history.steps, after_failure=True),
    "deposit_surface": Measured(
        ("x",),
        "m",
        "final elevation of the ground surface",
        compute=lambda end: observables.deposit_surface(end.deposit, end.half_spacing, end.edges),
    ),
    "displaced": Measured(
        ("particle",),
        "1",
        "1 where a particle is displaced farther than slide.displaced",
        "u1",
        DISPLACED,
        compute=lambda end: observables.is_displaced(end.particles, end.start, end.model.criteria),
    ),
    "wall_time": Measured(
        (),
        "s",
        "wall-clock time of the simulation",
        compute=lambda end: time.perf_counter() - end.begin,
        after_failure=True,
    ),
    **taken_from(lambda end: end.at_receptors, receptors.QUANTITIES),
}

UNITS = units_of(QUANTITIES)


def measure(end: Ending, quantities: Mapping[str, Measured] = QUANTITIES) -> dict[str, Value]:
    """Return the values of the quantities that the scene asks for: arrays of the declared types, and numbers."""
    wanted = with_dims(quantities, end.sizes)
    values = missing_values(wanted, end.sizes)
    for name, quantity in wanted.items():
        if quantity.after_failure or not end.history.has_failed:
            values[name] = np.asarray(quantity.compute(end), dtype=quantity.dtype)
    return {name: plain(value) for name, value in values.items()}


def markdown() -> str:
    """Return the quantities of the dataset as a table in Markdown."""
    lines = ["| name | by | unit | meaning |", "|---|---|---|---|"]
    for name, quantity in QUANTITIES.items():
        by = quantity.dims if quantity.average else ("realization", *quantity.dims)
        shown, meaning = quantity.average or (name, quantity.long_name)
        lines.append(f"| `{shown}` | {', '.join(by)} | {quantity.units} | {meaning} |")
    return "\n".join(lines)


if __name__ == "__main__":
    print(markdown())
