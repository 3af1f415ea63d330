"""Arrays kept between two starts: found again only as they were written, and for what they were written."""

import hashlib
import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from campaign.files import write_atomically

Arrays = Mapping[str, NDArray[Any]]


def keep(path: Path, key: str, arrays: Arrays) -> None:
    """Keep arrays by name; the directory is made if its own is there.

    Parameters
    ----------
    path
        Of the file.
    key
        A word that says what decides the arrays: whoever asks with another one finds nothing.
    arrays
        By name.

    Raises
    ------
    OSError
        When the directory cannot be written or the disk is full; an older file is then untouched.
    """
    buffer = io.BytesIO()
    np.savez(buffer, **dict[str, Any](arrays))
    path.parent.mkdir(exist_ok=True)
    write_atomically(path, _first_line(key, buffer.getvalue()) + buffer.getvalue())


def kept(path: Path, key: str) -> Arrays | None:
    """Return the arrays that were kept in a file with this key; None if there are none, or not as they were written."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    line, end, body = content.partition(b"\n")
    if line + end != _first_line(key, body):
        return None
    with np.load(io.BytesIO(body), allow_pickle=False) as file:
        return dict(file)


def _first_line(key: str, body: bytes) -> bytes:
    return f"runout-campaign arrays of {key}, sha256 {hashlib.sha256(body).hexdigest()}\n".encode()
