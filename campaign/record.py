"""One realization's result, and what its numbers mean."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Value: TypeAlias = NDArray[Any] | float | int

Front: TypeAlias = Literal["mass", "tip"]
"""The front of a slide: that of its mass, ahead of which `slide.front_area` lies, or its front-most particle."""

FINAL_RUNOUT: dict[Front, str] = {"mass": "final_runout_mass", "tip": "final_runout"}
"""The quantity that says how far a front came."""


class Status(IntEnum):
    """How a realization ended; the names are the dataset's flag meanings."""

    slid = 0
    no_slide = 1
    not_settled = 2
    timeout = 3
    diverged = 4
    left_domain = 5
    crashed = 6
    reached_wall = 7

    __hash__ = int.__hash__  # that of an enumeration runs in Python, several times for each realization of an account


FAILED = frozenset({Status.timeout, Status.diverged, Status.left_domain, Status.crashed})
"""Without a result: counted, reported, and never part of a statistic."""

SLID = frozenset({Status.slid, Status.not_settled, Status.reached_wall})
"""Slides, whose run-out is a lower bound where the front had not settled yet or the wall ahead stopped it."""

UNHINDERED = SLID - {Status.reached_wall}
"""Slides that the wall ahead has not stopped."""

LOWER_BOUND = SLID - {Status.slid}
"""Slides whose front was still on its way, or was stopped by the wall ahead: they may come farther than they did."""

USABLE = SLID | {Status.no_slide}
"""With a result: a slope that does not slide has a run-out of zero."""


class Average(NamedTuple):
    """What the mean of a quantity over the realizations without failure is called in the dataset."""

    name: str
    long_name: str


@dataclass(frozen=True)
class Quantity:
    """What a number of a record means.

    Parameters
    ----------
    dims
        Of the array; none for a single number.
    units, long_name
        After CF.
    dtype
        Of the array; what is missing is NaN, or 0 for integers.
    average
        The dataset holds this in its place, where one for each realization would be too large.
    """

    dims: tuple[str, ...]
    units: str
    long_name: str
    dtype: str = "f8"
    average: Average | None = None


T = TypeVar("T", bound=Quantity)


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
        By the name of the quantity. A record that was kept by another version may lack some and hold others.
    units
        Of the values, by the same names.
    scene
        SHA-256 of the scene whose realization it is, seed and cell included; "" where it does not say.
    """

    realization: int
    status: Status
    reason: str
    values: Mapping[str, Value]
    units: Mapping[str, str] = field(default_factory=dict)
    scene: str = ""


class RealizationSummary(NamedTuple):
    """The part of a record that decisions rest on; run-outs are in m, the wall-clock time in s."""

    realization: int
    status: Status
    final_runout: float
    final_runout_mass: float
    wall_time: float

    def runout(self, front: Front) -> float:
        """Return the run-out of a front in m: zero without a slide, NaN without a result."""
        if self.status in SLID:
            return self.final_runout_mass if front == "mass" else self.final_runout
        return 0.0 if self.status is Status.no_slide else np.nan


def summarize(record: Record) -> RealizationSummary:
    """Return the part of a record that decisions rest on."""
    numbers = (float(record.values.get(name, np.nan)) for name in SUMMARIZED)
    return RealizationSummary(record.realization, record.status, *numbers)


SUMMARIZED = RealizationSummary._fields[2:]
"""The quantities of a summary."""


def plain(value: Any) -> Value:
    """Return a number without dimensions as Python's own."""
    array = np.asarray(value)
    number: Value = array if array.ndim else array.item()
    return number


def fill_of(dtype: Any) -> float | int:
    """Return what stands for a missing number: NaN, or 0 for integers."""
    return np.nan if np.dtype(dtype).kind == "f" else 0


def units_of(quantities: Mapping[str, Quantity]) -> dict[str, str]:
    """Return the unit of each quantity."""
    return {name: quantity.units for name, quantity in quantities.items()}


def with_dims(quantities: Mapping[str, T], sizes: Mapping[str, int]) -> dict[str, T]:
    """Return the quantities of which all dimensions exist: without receptors nothing is told of them."""
    return {name: quantity for name, quantity in quantities.items() if sizes.keys() >= set(quantity.dims)}


def markdown_table(rows: Iterable[tuple[str, Quantity]]) -> str:
    """Return quantities of the dataset, each with the names it is shown by, as a table in Markdown."""
    lines = ["| name | by | unit | meaning |", "|---|---|---|---|"]
    lines += [f"| {shown} | {', '.join(row.dims)} | {row.units} | {row.long_name} |" for shown, row in rows]
    return "\n".join(lines)


def missing_values(quantities: Mapping[str, Quantity], sizes: Mapping[str, int]) -> dict[str, Value]:
    """Return the values of a realization without a result: NaN, or 0 for integers; `sizes` maps dimension to length."""
    values: dict[str, Value] = {}
    for name, quantity in quantities.items():
        shape = [sizes[dim] for dim in quantity.dims]
        values[name] = np.full(shape, fill_of(quantity.dtype), dtype=quantity.dtype)
    return values
