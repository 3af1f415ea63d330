"""What is known of a pack without its records: what decisions rest on, ahead of them and with a checksum of its own.

It follows the seal, which covers it as well, in the part of the file that HDF5 leaves to its user: a line of JSON and a
row of numbers for each realization. Who asks only how a campaign stands reads no more; older packs have none.
"""

import hashlib
import json
from collections.abc import Mapping
from typing import BinaryIO, NamedTuple

import numpy as np

from campaign.record import SUMMARIZED, RealizationSummary, Status
from campaign.storage.columns import Columns
from campaign.storage.soundness import Shape, shape_of

_ROW = np.dtype([("realization", "<i8"), ("status", "<i1"), *((name, "<f8") for name in SUMMARIZED)])

_LONGEST = 1 << 20
"""Bytes of a line, and rows, beyond which a summary is none."""


class PackSummary(NamedTuple):
    """What is known of a pack without its records.

    Attributes
    ----------
    realizations
        The part of each record that decisions rest on.
    shapes
        Of the quantities of a record.
    scene
        SHA-256 of the scene whose realizations they are; "" where that is not said.
    """

    realizations: list[RealizationSummary]
    shapes: Mapping[str, Shape]
    scene: str


def summary_of(columns: Columns) -> PackSummary:
    """Return what is to be known of records without them."""
    shapes = {name: shape_of(column[0]) for name, column in columns.values.items() if len(column)}
    return PackSummary(columns.summaries, shapes, columns.scene)


def to_bytes(summary: PackSummary) -> bytes:
    """Return what `read` reads."""
    rows = np.array(summary.realizations, _ROW).tobytes()
    said = {"rows": len(summary.realizations), "shapes": summary.shapes, "scene": summary.scene}
    return json.dumps(said | {"sha256": _checksum(said, rows)}).encode() + b"\n" + rows


def read(file: BinaryIO) -> PackSummary | None:
    """Read what follows a pack's seal; None where it is not such a summary, wholly as it was written."""
    try:
        said = json.loads(file.readline(_LONGEST))
        checksum = said.pop("sha256")
        rows = file.read(min(said["rows"], _LONGEST) * _ROW.itemsize)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None
    if checksum != _checksum(said, rows):
        return None
    shapes = {name: None if shape is None else tuple(shape) for name, shape in said["shapes"].items()}
    return PackSummary(_summaries(np.frombuffer(rows, _ROW)), shapes, said["scene"])


def _summaries(rows: "np.ndarray[tuple[int], np.dtype[np.void]]") -> list[RealizationSummary]:
    statuses = {status.value: status for status in Status}
    return [RealizationSummary(number, statuses[code], *rest) for number, code, *rest in rows.tolist()]


def _checksum(said: Mapping[str, object], rows: bytes) -> str:
    """Return the SHA-256 of a line, of what the numbers that follow it mean, and of those."""
    return hashlib.sha256(f"{json.dumps(said)} {_ROW.descr} ".encode() + rows).hexdigest()
