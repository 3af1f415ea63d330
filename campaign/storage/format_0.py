"""Records as version 0.1.0 kept them: a group for each, and a checksum over the quantities of its table."""

import hashlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from campaign.errors import DamagedRecordError
from campaign.record import Record, Status, plain

ORDER = (
    "runout",
    "max_displacement",
    "kinetic_energy",
    "final_runout",
    "final_runout_mass",
    "sliding_volume",
    "detached_volume",
    "settle_time",
    "energy_error",
    "wall_time",
    "steps",
    "deposit_surface",
    "displaced",
)
"""The quantities in the order of their checksum; the oldest records have no `detached_volume`."""


def read_group(group: Any, place: str) -> Record:
    """Read a record from an open HDF5 group and verify it; `place` names the group in errors.

    Raises
    ------
    DamagedRecordError
        When something is missing, unreadable, or does not match its checksum.
    """
    try:
        arrays = {name: np.asarray(group[name][()]) for name in ORDER if name in group}
        number, status = int(group.attrs["realization"]), Status(int(group.attrs["status"]))
        units = {name: str(group[name].attrs["units"]) for name in arrays}
        reason, checksum = str(group.attrs["reason"]), str(group.attrs["checksum"])
    except (OSError, KeyError, ValueError, RuntimeError) as error:
        raise DamagedRecordError(f"{place} cannot be read ({error}).") from error
    if checksum != _checksum(number, status, reason, arrays):
        raise DamagedRecordError(f"{place} does not match its checksum.")
    return Record(number, status, reason, {name: plain(array) for name, array in arrays.items()}, units)


def _checksum(number: int, status: Status, reason: str, arrays: Mapping[str, NDArray[Any]]) -> str:
    digest = hashlib.sha256(f"{number} {int(status)} {reason}".encode())
    for name, array in arrays.items():
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()
