"""Several records as columns: an array for each quantity, with a row for each realization."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from campaign.record import SUMMARIZED, RealizationSummary, Record, Status, fill_of, plain


@dataclass(frozen=True)
class Columns:
    """The records of several realizations.

    Parameters
    ----------
    realizations, statuses : int arrays (row,)
    reasons : object array (row,)
        Of text.
    values : dict
        By the name of the quantity, an array (row, ...). A number that a record lacks is NaN, or 0 for integers.
    units : dict
        Of the values, by the same names.
    scene : str
        SHA-256 of the scene whose realizations they are; "" where that is not said.
    """

    realizations: NDArray[np.int64]
    statuses: NDArray[np.int8]
    reasons: NDArray[np.object_]
    values: Mapping[str, NDArray[Any]]
    units: Mapping[str, str]
    scene: str = ""

    def __len__(self) -> int:
        return len(self.realizations)

    def take(self, rows: NDArray[np.bool_]) -> "Columns":
        """Return the rows of a mask."""
        values = {name: column[rows] for name, column in self.values.items()}
        kept = {name: getattr(self, name)[rows] for name in ("realizations", "statuses", "reasons")}
        return replace(self, values=values, **kept)

    def record(self, row: int) -> Record:
        """Return one row as a record; its arrays are views."""
        values = {name: plain(column[row]) for name, column in self.values.items()}
        status, reason = Status(int(self.statuses[row])), str(self.reasons[row])
        return Record(int(self.realizations[row]), status, reason, values, self.units, self.scene)

    def records(self) -> list[Record]:
        """Return all rows as records."""
        return [self.record(row) for row in range(len(self))]

    @cached_property
    def summaries(self) -> list[RealizationSummary]:
        """Return the part of each row that decisions rest on."""
        absent = np.full(len(self), np.nan)
        numbers = [self.values.get(name, absent).tolist() for name in SUMMARIZED]
        codes = self.statuses.tolist()
        statuses = map({code: Status(code) for code in set(codes)}.__getitem__, codes)
        return [*map(RealizationSummary, self.realizations.tolist(), statuses, *numbers)]


def columns_of(records: Sequence[Record]) -> Columns:
    """Put records below each other.

    Raises
    ------
    ValueError
        When a quantity has not the same shape in all of them.
    """
    names = dict.fromkeys(name for record in records for name in record.values)
    return Columns(
        np.array([record.realization for record in records], dtype=np.int64),
        np.array([int(record.status) for record in records], dtype=np.int8),
        np.array([record.reason for record in records], dtype=object),
        {name: _column(name, records) for name in names},
        {name: unit for record in records for name, unit in record.units.items()},
    )


def _column(name: str, records: Sequence[Record]) -> NDArray[Any]:
    held = [None if name not in record.values else np.asarray(record.values[name]) for record in records]
    like = next(value for value in held if value is not None)
    missing = np.full(like.shape, fill_of(like.dtype), like.dtype)
    return np.stack([missing if value is None else value for value in held], dtype=like.dtype)
