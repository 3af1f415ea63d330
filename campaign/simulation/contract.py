"""What a campaign asks of the thing it runs many times; `campaign.simulation.ground.Ground` is the one in use."""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol

from numpy.typing import NDArray

from campaign.record import Quantity, Record, Status, missing_values, units_of
from campaign.scene.scene import Scene


class Interrupted(Exception):  # noqa: N818  -- not an error: the caller asked for it
    """The simulation was left at the caller's request."""


class PreparedGround(Protocol):
    """What all realizations of a scene share, and the way from an id to a record; pickled once, to every rank."""

    @property
    def coordinates(self) -> Mapping[str, NDArray[Any]]:
        """Arrays "time" [s], "x" [m], "particle_x" and "particle_y" [m]."""

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
    """Return the length of each dimension of a record."""
    coordinates = ground.coordinates
    return {"time": len(coordinates["time"]), "x": len(coordinates["x"]), "particle": ground.n_particles}


def without_result(
    ground: PreparedGround, realization: int, status: Status, reason: str, wall_time: float = math.nan
) -> Record:
    """Return the record of a realization that gave no result, after so many seconds."""
    values = missing_values(ground.quantities, sizes(ground)) | {"wall_time": wall_time}
    return Record(realization, status, reason, values, units_of(ground.quantities))
