"""One realization's result: what is measured, declared once, and how it is kept as bytes."""

import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple, TypeAlias

import h5py
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
        One entry for each name in `QUANTITIES`, in the units given there.
    """

    realization: int
    status: Status
    reason: str
    values: Mapping[str, Value]


class DamagedRecordError(Exception):
    """A record's bytes are not what was written; the message names the file."""


def missing_values(sizes: Mapping[str, int]) -> dict[str, Value]:
    """Return the values of a realization without a result: NaN, or 0 for integers; `sizes` maps dimension to length."""
    values: dict[str, Value] = {}
    for name, quantity in QUANTITIES.items():
        fill = np.nan if quantity.dtype.startswith("f") else 0
        values[name] = np.full([sizes[dim] for dim in quantity.dims], fill, dtype=quantity.dtype)
    return values


def to_bytes(record: Record) -> bytes:
    """Return the record as the content of an HDF5 file."""
    return hdf5_bytes({"": record})


def hdf5_bytes(groups: Mapping[str, Record]) -> bytes:
    """Return an HDF5 file's content with each record in the group of its name, "" being the root.

    It is built in memory, so that a full disk is the plain write error of one place (`files.write_atomically`).
    """
    buffer = io.BytesIO()
    with h5py.File(buffer, "w") as file:
        for name, record in groups.items():
            _write_group(file.create_group(name) if name else file, record)
    return buffer.getvalue()


def _write_group(group: Any, record: Record) -> None:
    arrays = _arrays(record)
    for name, array in arrays.items():
        group[name] = array
        group[name].attrs["units"] = QUANTITIES[name].units
    group.attrs["realization"] = record.realization
    group.attrs["status"] = int(record.status)
    group.attrs["reason"] = record.reason
    group.attrs["checksum"] = _checksum(record.realization, record.status, record.reason, arrays)


def read_group(group: Any, place: str) -> Record:
    """Read a record from an open HDF5 group and verify it; `place` names the group in errors.

    Raises
    ------
    DamagedRecordError
        When something is missing, unreadable, or does not match its checksum.
    """
    try:
        arrays = {name: np.asarray(group[name][()]) for name in QUANTITIES}
        number, status = int(group.attrs["realization"]), Status(int(group.attrs["status"]))
        reason, checksum = str(group.attrs["reason"]), str(group.attrs["checksum"])
    except (OSError, KeyError, ValueError, RuntimeError) as error:
        raise DamagedRecordError(f"The record in {place} cannot be read ({error}).") from error
    if checksum != _checksum(number, status, reason, arrays):
        raise DamagedRecordError(f"The record in {place} does not match its checksum.")
    return Record(number, status, reason, {n: a if a.ndim else a.item() for n, a in arrays.items()})


def _arrays(record: Record) -> dict[str, NDArray[Any]]:
    return {name: np.asarray(record.values[name], dtype=quantity.dtype) for name, quantity in QUANTITIES.items()}


def _checksum(number: int, status: Status, reason: str, arrays: Mapping[str, NDArray[Any]]) -> str:
    digest = hashlib.sha256(f"{number} {int(status)} {reason}".encode())
    for name, array in arrays.items():
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()
