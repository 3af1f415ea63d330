"""A record as bytes: an HDF5 file with a dataset for each quantity, behind a seal."""

import io
from collections.abc import Collection
from typing import Any

import h5py
import numpy as np

from campaign.errors import DamagedRecordError
from campaign.record import QUANTITIES, SUMMARIZED, Record, Status, Value
from campaign.storage import format_0
from campaign.storage.seal import SIZE, check_bytes, seal_of, sealed


def to_bytes(record: Record) -> bytes:
    """Return the record as the content of a file.

    It is built in memory, so that a full disk is the plain write error of one place (`files.write_atomically`).
    """
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=SIZE) as file:
        for name, value in record.values.items():
            write_values(file, name, as_declared(name, value))
        file.attrs["realization"] = record.realization
        file.attrs["status"] = int(record.status)
        file.attrs["reason"] = record.reason
    return sealed(buffer.getvalue())


def from_bytes(content: bytes, place: str) -> Record:
    """Read a record and verify it.

    Parameters
    ----------
    content
        Of its file.
    place
        Names the file in errors.

    Raises
    ------
    DamagedRecordError
        When something is missing, unreadable, or does not match its checksum.
    RefusalError
        When only a newer version of the program can read it.
    """
    return _read(content, f"The record in {place}", None)


def summarized_from_bytes(content: bytes, place: str) -> Record:
    """Read and verify a record of which only `SUMMARIZED` is taken; raises like `from_bytes`."""
    return _read(content, f"The record in {place}", SUMMARIZED)


def _read(content: bytes, place: str, names: Collection[str] | None) -> Record:
    seal = seal_of(content, place)
    if seal is not None:
        check_bytes(content, seal, place)
    try:
        with h5py.File(io.BytesIO(content), "r") as file:
            if seal is None:
                return format_0.read_group(file, place)
            return _record(file, [name for name in file if names is None or name in names])
    except (OSError, KeyError, ValueError, RuntimeError, TypeError) as error:
        raise DamagedRecordError(f"{place} cannot be read ({error}).") from error


def _record(file: Any, names: Collection[str]) -> Record:
    about = file.attrs
    values: dict[str, Value] = {name: plain(file[name][()]) for name in names}
    return Record(int(about["realization"]), Status(int(about["status"])), str(about["reason"]), values)


def write_values(group: Any, name: str, values: Any, **how: Any) -> None:
    """Write a quantity's numbers with their unit, where this version knows it."""
    group.create_dataset(name, data=values, **how)
    if name in QUANTITIES:
        group[name].attrs["units"] = QUANTITIES[name].units


def as_declared(name: str, value: Value) -> np.ndarray[Any, Any]:
    """Return a value in the type that its quantity declares; an unknown quantity keeps its own."""
    return np.asarray(value, dtype=QUANTITIES[name].dtype if name in QUANTITIES else None)


def plain(value: Any) -> Value:
    """Return a number without dimensions as Python's own."""
    array = np.asarray(value)
    number: Value = array if array.ndim else array.item()
    return number
