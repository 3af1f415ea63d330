"""One realization's result: what is measured, declared once."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Value: TypeAlias = NDArray[Any] | float | int


class Status(IntEnum):
    """How a realization ended; the names are the dataset's flag meanings."""

    slid = 0
    no_slide = 1
    not_settled = 2
    timeout = 3
    diverged = 4
    left_domain = 5
    crashed = 6


FAILED = frozenset({Status.timeout, Status.diverged, Status.left_domain, Status.crashed})
"""Without a usable result: counted, reported, and never part of a statistic."""

USABLE = frozenset({Status.slid, Status.not_settled})
"""In the statistics of run-out, which are conditional on sliding (a run-out not yet settled is a lower bound)."""


class Quantity(NamedTuple):
    """What a number of a record means."""

    dims: tuple[str, ...]
    units: str
    long_name: str
    dtype: str = "f8"


QUANTITIES: dict[str, Quantity] = {
    "runout": Quantity(("time",), "m", "advance of the sliding front from the initial toe"),
    "max_displacement": Quantity(("time",), "m", "largest particle displacement since release"),
    "kinetic_energy": Quantity(("time",), "J/m", "kinetic energy per metre run"),
    "final_runout": Quantity((), "m", "final advance of the front-most slid particle from the initial toe"),
    "final_runout_mass": Quantity(
        (), "m", "final advance of the front beyond which slide.front_area of slid material lies"
    ),
    "sliding_volume": Quantity((), "m3/m", "volume displaced farther than slide.displaced, per metre run"),
    "detached_volume": Quantity((), "m3/m", "volume that has come apart and lies ahead of the slide, per metre run"),
    "settle_time": Quantity((), "s", "time from release to rest"),
    "energy_error": Quantity((), "1", "energy imbalance over the work of gravity"),
    "wall_time": Quantity((), "s", "wall-clock time of the simulation"),
    "steps": Quantity((), "1", "number of time steps", "i8"),
    "deposit_surface": Quantity(("x",), "m", "final elevation of the ground surface"),
    "displaced": Quantity(("particle",), "1", "1 where a particle is displaced farther than slide.displaced", "u1"),
}
"""Everything a realization reports; records and the dataset follow from this table."""


@dataclass(frozen=True)
class Record:
    """One realization's result.

    Parameters
    ----------
    realization
        Its id; `BASELINE` is the deterministic run.
    status, reason
        How it ended, and the sentence behind a failure or a flag ("" where there is neither).
    values
        By name, in the units that `QUANTITIES` gives. One that was kept by another version may lack some quantities and
        hold others.
    """

    realization: int
    status: Status
    reason: str
    values: Mapping[str, Value]


class RealizationSummary(NamedTuple):
    """The part of a record that decisions rest on; the run-out is in m, the wall-clock time in s."""

    realization: int
    status: Status
    final_runout: float
    wall_time: float


def summarize(record: Record) -> RealizationSummary:
    """Return the part of a record that decisions rest on."""
    runout, wall_time = (float(record.values.get(name, np.nan)) for name in SUMMARIZED)
    return RealizationSummary(record.realization, record.status, runout, wall_time)


SUMMARIZED = ("final_runout", "wall_time")
"""The quantities of a summary."""


def fill_of(dtype: Any) -> float | int:
    """Return what stands for a missing number: NaN, or 0 for integers."""
    return np.nan if np.dtype(dtype).kind == "f" else 0


def missing_values(sizes: Mapping[str, int]) -> dict[str, Value]:
    """Return the values of a realization without a result: NaN, or 0 for integers; `sizes` maps dimension to length."""
    values: dict[str, Value] = {}
    for name, quantity in QUANTITIES.items():
        shape = [sizes[dim] for dim in quantity.dims]
        values[name] = np.full(shape, fill_of(quantity.dtype), dtype=quantity.dtype)
    return values
