"""A pack as bytes: the records of consecutive realizations as columns of an HDF5 file, behind a seal and a summary.

The seal covers the whole file. A checksum for each row stands beside it, by which the whole rows of a damaged pack are
told from the others, and one of the units that they share.
"""

import hashlib
import io
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from campaign.errors import DamagedRecordError
from campaign.record import Record, Status, plain
from campaign.storage import format_0, pack_summary
from campaign.storage.columns import Columns, columns_of
from campaign.storage.pack_summary import PackSummary, summary_of
from campaign.storage.record_format import read_units, write_values
from campaign.storage.seal import SIZE, check_bytes, seal_of, sealed

VALUES = "values"
"""The group of the quantities."""

UNITS = "units_sha256"
"""The attribute with a checksum of the units, which all rows share; older packs have none."""

READ_ERRORS = (OSError, KeyError, ValueError, RuntimeError, TypeError)
"""What HDF5 makes of damaged bytes."""


def to_bytes(columns: Columns) -> bytes:
    """Return the content of a pack; flags are compressed, a row at a time, so that damage stays in its row."""
    buffer, front = io.BytesIO(), bytes(SIZE) + pack_summary.to_bytes(summary_of(columns))
    room = 1 << (len(front) - 1).bit_length()  # HDF5 leaves a power of two to its user
    with h5py.File(buffer, "w", userblock_size=room) as file:
        file.attrs["scene"] = columns.scene
        file.attrs[UNITS] = _checksum_of_units(columns.units)
        file["realization"] = columns.realizations
        file["status"] = columns.statuses
        file.create_dataset("reason", data=columns.reasons, dtype=h5py.string_dtype())
        file["checksum"] = np.array([_checksum(record) for record in columns.records()], dtype="S64")
        values = file.create_group(VALUES)
        for name, column in columns.values.items():
            rows = {"compression": 1, "chunks": (1, *column.shape[1:])} if column.dtype == np.uint8 else {}
            write_values(values, name, column, columns.units, **rows)
    return sealed(front.ljust(room, b"\0") + buffer.getvalue()[room:])


def read(path: Path) -> Columns:
    """Read a pack and verify it.

    Raises
    ------
    DamagedRecordError
        When anything in it is not as it was written.
    RefusalError
        When only a newer version of the program can read it.
    """
    return _columns(_verified(path), f"The pack {path}")


def verify(path: Path) -> PackSummary:
    """Verify a pack, records and all, and return what is known without them; raises like `read`."""
    content = _verified(path)
    summary = pack_summary.read(io.BytesIO(content[SIZE:]))
    return summary or summary_of(_columns(content, f"The pack {path}"))


def read_summary(path: Path) -> PackSummary:
    """Read what is known of a pack without its records, at which it does not look if it can; raises like `read`."""
    with _opening(path), path.open("rb") as file:
        seal_of(file.read(SIZE), f"The pack {path}")
        summary = pack_summary.read(file)
    return summary or summary_of(read(path))


def whole_records(path: Path) -> list[Record]:
    """Return the records of a damaged pack that are as they were written."""
    try:
        with h5py.File(path, "r") as file:
            if VALUES not in file:
                return _whole(lambda name: format_0.read_group(file[name], str(path)), file)
            return _whole(lambda row: _row(file, row), range(len(file["realization"])))
    except READ_ERRORS:
        return []


def is_current(path: Path) -> bool:
    """Whether a pack is of a numbered format."""
    with path.open("rb") as file:
        return seal_of(file.read(SIZE), f"The pack {path}") is not None


@contextmanager
def _opening(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise DamagedRecordError(f"The pack {path} cannot be opened ({error}).") from error


def _verified(path: Path) -> bytes:
    """Return the content of a pack whose bytes are as they were written, as far as its format tells."""
    with _opening(path):
        content = path.read_bytes()
    place = f"The pack {path}"
    seal = seal_of(content, place)
    if seal is not None:
        check_bytes(content, seal, place)
    return content


def _columns(content: bytes, place: str) -> Columns:
    try:
        with h5py.File(io.BytesIO(content), "r") as file:
            if VALUES not in file:
                return columns_of([format_0.read_group(file[name], place) for name in file])
            datasets = dict(file[VALUES].items())
            values = {name: column[()] for name, column in datasets.items()}
            reasons, units = file["reason"].asstr()[()], read_units(datasets)
            return Columns(file["realization"][()], file["status"][()], reasons, values, units, _scene(file))
    except READ_ERRORS as error:
        raise DamagedRecordError(f"{place} cannot be read ({error}).") from error


def _row(file: h5py.File, row: int) -> Record:
    """Read one row and verify it by its own checksum."""
    values = {name: plain(column[row]) for name, column in file[VALUES].items()}
    status = Status(int(file["status"][row]))
    units = read_units(file[VALUES])
    if file.attrs.get(UNITS, _checksum_of_units(units)) != _checksum_of_units(units):
        raise DamagedRecordError("The units do not match their checksum.")
    record = Record(int(file["realization"][row]), status, file["reason"].asstr()[row], values, units, _scene(file))
    if file["checksum"][row].decode() != _checksum(record):
        raise DamagedRecordError(f"Row {row} does not match its checksum.")
    return record


def _checksum_of_units(units: Mapping[str, str]) -> str:
    return hashlib.sha256(repr(sorted(units.items())).encode()).hexdigest()


def _scene(file: h5py.File) -> str:
    return str(file.attrs.get("scene", ""))


def _whole(read_one: Callable[[Any], Record], places: Iterable[Any]) -> list[Record]:
    whole = []
    for place in places:
        try:
            whole.append(read_one(place))
        except (*READ_ERRORS, DamagedRecordError):
            continue
    return whole


def _checksum(record: Record) -> str:
    digest = hashlib.sha256(f"{record.realization} {int(record.status)} {record.reason}{record.scene}".encode())
    for name, value in sorted(record.values.items()):
        array = np.asarray(value)
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()
