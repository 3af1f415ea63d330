"""What a campaign asks of the thing it runs many times; `campaign.simulation.ground.Ground` is the one in use."""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from campaign.record import Quantity, Record, Status, missing_values, units_of
from campaign.scene.scene import Scene

TEXT = "O"
"""The dtype of names."""

COORDINATES: dict[str, Quantity] = {
    "time": Quantity(("time",), "s", "time since release of strength"),
    "x": Quantity(("x",), "m", "horizontal place"),
    "particle_x": Quantity(("particle",), "m", "initial horizontal place of the particle"),
    "particle_y": Quantity(("particle",), "m", "initial elevation of the particle"),
    "receptor": Quantity(("receptor",), "", "name of the receptor", TEXT),
    "receptor_x": Quantity(("receptor",), "m", "middle of the receptor"),
    "layer": Quantity(("layer",), "", "name of the layer, from the surface down", TEXT),
    "property": Quantity(("property",), "", "random property of the soil", TEXT),
    "box_x": Quantity(("box_x",), "m", "horizontal place of the middle of the box"),
    "box_y": Quantity(("box_y",), "m", "elevation of the middle of the box"),
}
"""What labels the dimensions of records."""

SHARED: dict[str, Quantity] = {
    "receptor_x_bounds": Quantity(("receptor", "bound"), "m", "near and far end of the receptor"),
    "particle_layer": Quantity(("particle",), "1", "number of the particle's layer, from 0", "i1"),
    "initial_surface": Quantity(("x",), "m", "initial elevation of the ground surface"),
}
"""What else is the same in all realizations."""


class Interrupted(Exception):  # noqa: N818  -- not an error: the caller asked for it
    """The simulation was left at the caller's request."""


class PreparedGround(Protocol):
    """What all realizations of a scene share, and the way from an id to a record; pickled once, to every rank."""

    @property
    def coordinates(self) -> Mapping[str, NDArray[Any]]:
        """Arrays by the names of `COORDINATES` and `SHARED`, without those that the scene does not ask for."""

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """What a realization's record holds, by name; `final_runout`, `runout` and `wall_time` among it."""

    @property
    def n_particles(self) -> int:
        """Number of particles."""

    @property
    def toe_x(self) -> float:
        """Place of the initial toe [m], from which run-out is measured."""

    def simulate(self, realization: int, interrupt: Callable[[], bool]) -> Record:
        """Compute one realization; asks `interrupt` a few times a second and raises `Interrupted` on True."""


Prepare = Callable[[Scene, Path], PreparedGround]
"""Computes what realizations share, once on rank 0; it may keep files in the directory."""


def sizes(ground: PreparedGround) -> dict[str, int]:
    """Return the length of each dimension that a record may have."""
    given = ground.coordinates
    rows = given_rows(given)
    return {dim: n for name, row in rows.items() for dim, n in zip(row.dims, np.shape(given[name]), strict=True)}


def shapes(ground: PreparedGround) -> dict[str, tuple[int, ...]]:
    """Return the shape of each quantity of a record."""
    lengths = sizes(ground)
    return {name: tuple(lengths[dim] for dim in row.dims) for name, row in ground.quantities.items()}


def given_rows(given: Mapping[str, Any]) -> dict[str, Quantity]:
    """Return the rows of `COORDINATES` and `SHARED` that a ground gives."""
    return {name: row for name, row in (COORDINATES | SHARED).items() if name in given}


def without_result(
    ground: PreparedGround, realization: int, status: Status, reason: str, wall_time: float = math.nan
) -> Record:
    """Return the record of a realization that gave no result, after so many seconds."""
    values = missing_values(ground.quantities, sizes(ground)) | {"wall_time": wall_time}
    return Record(realization, status, reason, values, units_of(ground.quantities))
