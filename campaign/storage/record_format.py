"""A record as bytes: an HDF5 file with a dataset for each quantity, behind a seal."""

import io
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import h5py
import numpy as np
from numpy.typing import NDArray

from campaign.errors import DamagedRecordError
from campaign.record import SUMMARIZED, Record, Status, Value, plain
from campaign.storage import format_0
from campaign.storage.seal import SIZE, check_bytes, seal_of, sealed

_Held: TypeAlias = tuple[dict[str, Value], dict[str, str]]
"""Values and units, by the name of the quantity."""


def to_bytes(record: Record) -> bytes:
    """Return the record as the content of a file.

    It is built in memory, so that a full disk is the plain write error of one place (`files.write_atomically`).
    """
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=SIZE) as file:
        for name, value in record.values.items():
            write_values(file, name, np.asarray(value), record.units)
        file.attrs["realization"] = record.realization
        file.attrs["status"] = int(record.status)
        file.attrs["reason"] = record.reason
        file.attrs["scene"] = record.scene
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
    return _read(content, f"The record in {place}", _values)


def summarized_from_bytes(content: bytes, place: str) -> Record:
    """Read and verify a record of which only the numbers in `SUMMARIZED` are taken; raises like `from_bytes`."""
    return _read(content, f"The record in {place}", _summarized)


def _read(content: bytes, place: str, take: Callable[[h5py.File], _Held]) -> Record:
    seal = seal_of(content, place)
    if seal is not None:
        check_bytes(content, seal, place)
    try:
        with h5py.File(io.BytesIO(content), "r") as file:
            if seal is None:
                return format_0.read_group(file, place)
            values, units = take(file)
            about = file.attrs
            status, scene = Status(int(about["status"])), str(about.get("scene", ""))
            return Record(int(about["realization"]), status, str(about["reason"]), values, units, scene)
    except (OSError, KeyError, ValueError, RuntimeError, TypeError) as error:
        raise DamagedRecordError(f"{place} cannot be read ({error}).") from error


def _values(file: h5py.File) -> _Held:
    datasets = dict(file.items())
    values: dict[str, Value] = {name: plain(dataset[()]) for name, dataset in datasets.items()}
    return values, read_units(datasets)


def _summarized(file: h5py.File) -> _Held:
    return {name: plain(numbers_in(file, name)) for name in SUMMARIZED if name in file}, {}


def numbers_in(file: h5py.File, name: str) -> NDArray[Any]:
    """Return numbers without what h5py itself does around reading them, which takes several times as long."""
    dataset = h5py.h5d.open(file.id, name.encode())
    numbers = np.empty(dataset.shape, dataset.dtype)
    dataset.read(h5py.h5s.ALL, h5py.h5s.ALL, numbers)
    return numbers


def write_values(group: h5py.Group, name: str, values: Any, units: Mapping[str, str], **how: Any) -> None:
    """Write a quantity's numbers with their unit, if it has one."""
    group.create_dataset(name, data=values, **how)
    if name in units:
        group[name].attrs["units"] = units[name]


def read_units(datasets: Mapping[str, h5py.Dataset]) -> dict[str, str]:
    """Return the units of the quantities that have one."""
    units = {name: dataset.attrs.get("units") for name, dataset in datasets.items()}
    return {name: str(unit) for name, unit in units.items() if unit is not None}
