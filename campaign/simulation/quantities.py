"""What is measured in a realization: one table, from which records, dataset and documentation follow.

A new quantity is a new row. `python -m campaign.simulation.quantities` prints the table for README.
"""

import time
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from campaign.record import Average, Quantity, Value, markdown_table, missing_values, plain, units_of, with_dims
from campaign.simulation import field_summary, receptors
from campaign.simulation.detachment import detached_volume
from campaign.simulation.ending import Ending, Measured, taken_from
from solver import observables

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
    "runout_mass": Measured(
        ("time",),
        "m",
        "advance of the front beyond which slide.front_area of slid material lies",
        compute=lambda end: end.history.runout_mass,
        after_failure=True,
    ),
    "front_position": Measured(
        ("time",),
        "m",
        "place of the front that slide.front chooses; missing while nothing slides",
        compute=lambda end: end.history.front_position,
        after_failure=True,
    ),
    "max_displacement": Measured(
        ("time",),
        "m",
        "largest particle displacement, from the ground at rest under the gravity of the time",
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
    "unbalanced_force": Measured(
        ("time",),
        "1",
        "norm of the unbalanced nodal forces over that of the weight",
        compute=lambda end: end.history.unbalanced_force,
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
        compute=lambda end: end.history.runout_mass[-1],
    ),
    "farther_advance": Measured(
        (),
        "m",
        "how much farther the front would come at most after the end of the run, v^2 / (2 g f) with its speed or that "
        "of the sliding ground, and the residual strength over the weight for f; 0 at rest; missing where it is still "
        "faster than half of its largest speed, the wall ahead was in the way, or the front is a tip",
        compute=lambda end: end.farther_advance,
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
        compute=lambda end: detached_volume(end.particles, end.start, end.model.surface, end.model.particle_spacing),
    ),
    "retrogression": Measured(
        (),
        "m",
        "distance behind the crest to which the ground surface is lost: displaced farther than slide.failed",
        compute=lambda end: end.moved_behind_crest(end.model.criteria.failed),
    ),
    "influence_distance": Measured(
        (),
        "m",
        "distance behind the crest to which the ground surface is displaced farther than slide.displaced",
        compute=lambda end: end.moved_behind_crest(end.model.criteria.displaced),
    ),
    "reached_wall_behind": Measured(
        (),
        "1",
        "1 where the slide has reached the wall behind the crest, else 0: sliding_volume, retrogression and "
        "influence_distance are then lower bounds, and the wall disturbs the run-out in either direction",
        "i8",
        compute=lambda end: end.history.walls.left,
    ),
    "base_contact": Measured(
        (),
        "1",
        "share of the sliding ground, by columns, that slips along the fixed base",
        compute=lambda end: observables.base_contact(end.particles, end.start, end.model.cell_size, end.model.criteria),
    ),
    "settle_time": Measured(
        (), "s", "time from release to rest", compute=lambda end: end.history.settle_time, after_failure=True
    ),
    "rest_by": Measured(
        (),
        "1",
        "what held at rest: 0 no rest, 1 kinetic energy and advance, 2 the unbalanced force too, 3 it never slid",
        "i8",
        compute=lambda end: end.history.rest_by,
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
        compute=lambda end: end.displaced,
    ),
    "wall_time": Measured(
        (),
        "s",
        "wall-clock time of the simulation",
        compute=lambda end: time.perf_counter() - end.begin,
        after_failure=True,
    ),
    **taken_from(lambda end: end.field_means, field_summary.QUANTITIES),
    "field_map": Measured(
        ("property", "box_y", "box_x"),
        "1",
        "mean of the logarithm of the property in SI units over a box of the ground",
        "f4",
        compute=lambda end: end.field_map if end.field_map is not None else np.nan,
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
    return markdown_table([_shown(name, quantity) for name, quantity in QUANTITIES.items()])


def _shown(name: str, quantity: Measured) -> tuple[str, Quantity]:
    if quantity.average:
        return f"`{quantity.average.name}`", replace(quantity, long_name=quantity.average.long_name)
    return f"`{name}`", replace(quantity, dims=("realization", *quantity.dims))


if __name__ == "__main__":
    print(markdown())
