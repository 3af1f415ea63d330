"""A first line that says what a file's bytes are, readable before HDF5 looks at them.

HDF5 leaves the first `SIZE` bytes of a file to its user. They hold one line of text: the format, the oldest version of
the program that reads it, and the SHA-256 of all bytes that follow. Whatever a record holds is covered, whether or not
the reading version knows of it.
"""

import hashlib
import re
from typing import NamedTuple

from campaign.errors import DamagedRecordError
from campaign.storage.formats import FORMAT, READER, check_format

SIZE = 512
"""The smallest block of bytes that HDF5 leaves to its user."""

_HDF5 = b"\x89HDF"
"""How a file of format 0 begins."""

_LINE = re.compile(rb"runout-campaign format (\d+), read by ([!-~]+) and newer, sha256 ([0-9a-f]{64})\n")


class Seal(NamedTuple):
    """What the first line of a file says."""

    number: int
    reader: str
    sha256: str


def sealed(content: bytes) -> bytes:
    """Return an HDF5 file's content with its first line; `content` begins with a user block of `SIZE` bytes."""
    body = content[SIZE:]
    line = f"runout-campaign format {FORMAT}, read by {READER} and newer, sha256 {hashlib.sha256(body).hexdigest()}\n"
    return line.encode().ljust(SIZE, b"\0") + body


def seal_of(content: bytes, place: str) -> Seal | None:
    """Return what the first line of `content` says; None for a file of format 0, which has none.

    Parameters
    ----------
    content
        The first `SIZE` bytes of a file, or more.
    place
        Names the file in errors.

    Raises
    ------
    DamagedRecordError
        When it is not a line of any version.
    RefusalError
        When only a newer version of the program can read the file.
    """
    found = _LINE.match(content[:SIZE])
    if found is None:
        if content.startswith(_HDF5):
            return None
        raise DamagedRecordError(f"{place} does not begin as it was written.")
    seal = Seal(int(found[1]), found[2].decode(), found[3].decode())
    check_format(seal.number, seal.reader, place)
    return seal


def check_bytes(content: bytes, seal: Seal, place: str) -> None:
    """Make sure that a file's bytes are those that were sealed.

    Raises
    ------
    DamagedRecordError
        When they are not.
    """
    if hashlib.sha256(content[SIZE:]).hexdigest() != seal.sha256:
        raise DamagedRecordError(f"{place} does not match its checksum.")
