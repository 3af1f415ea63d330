"""A record as bytes: a group of an HDF5 file, with a checksum."""

import hashlib
import io
from collections.abc import Mapping
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from campaign.errors import DamagedRecordError
from campaign.record import QUANTITIES, Record, Status


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
