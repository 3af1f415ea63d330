"""The records of a campaign on disk: one file a realization, later packed by the hundred.

`records/realization-000123.h5` and `records/baseline.h5` appear whole or not at all; `packs/p00000.h5` holds
`PACK_SIZE` consecutive realizations, a group each. A loose record takes precedence over a packed one. Any rank may
write records; only rank 0, which holds the directory's lock, recovers and packs.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py

from campaign.errors import DamagedRecordError
from campaign.record import Record
from campaign.seeds import BASELINE
from campaign.storage.files import write_atomically
from campaign.storage.layout import PACKS, RECORDS
from campaign.storage.record_format import hdf5_bytes, read_group, to_bytes

PACK_SIZE = 256


class RecordStore:
    """The finished realizations of the campaign in `directory`."""

    def __init__(self, directory: Path) -> None:
        self.records = directory / RECORDS
        self.packs = directory / PACKS

    def create(self) -> None:
        """Make the directories; raises OSError where that is not allowed."""
        self.records.mkdir(parents=True, exist_ok=True)
        self.packs.mkdir(parents=True, exist_ok=True)

    def write(self, record: Record) -> None:
        """Keep a record for good; raises OSError, leaving no trace, when the disk is full or not writable."""
        write_atomically(self._loose_path(record.realization), to_bytes(record))

    def read(self, realization: int) -> Record:
        """Return a finished realization's record.

        Raises
        ------
        KeyError
            When there is none.
        DamagedRecordError
            When its file is truncated or altered.
        """
        path = self._loose_path(realization)
        if path.exists():
            return _read(path, "/")
        path = self._pack_path(realization // PACK_SIZE)
        if realization == BASELINE or not path.exists():
            raise KeyError(realization)
        return _read(path, file_name(realization))

    def finished(self) -> set[int]:
        """Return the ids that have a record, the baseline's included."""
        return self._loose() | {number for path in self._pack_paths() for number in _packed(path)}

    def read_all(self) -> Iterator[Record]:
        """Yield every record in the order of ids, the baseline first."""
        for realization in sorted(self.finished()):
            yield self.read(realization)

    def recover(self) -> list[str]:
        """Clear what a killed campaign left behind, and set damaged files aside so that their ids are run again.

        Returns
        -------
        list of str
            A sentence for each damaged file, which is kept under the name `*.damaged`.
        """
        for path in (*self.records.glob(".*"), *self.packs.glob(".*")):
            path.unlink()
        sentences = [self._unpack_damaged(path) for path in self._pack_paths()]
        sentences += [self._check_loose(number) for number in sorted(self._loose())]
        return [sentence for sentence in sentences if sentence]

    def pack(self) -> None:
        """Move complete runs of `PACK_SIZE` loose records into packs, which spares a cluster's inodes."""
        loose = self._loose()
        for number in sorted({realization // PACK_SIZE for realization in loose - {BASELINE}}):
            block = range(number * PACK_SIZE, (number + 1) * PACK_SIZE)
            if loose.issuperset(block):
                content = hdf5_bytes({file_name(k): self.read(k) for k in block})
                write_atomically(self._pack_path(number), content)
                for realization in block:
                    self._loose_path(realization).unlink()

    def _check_loose(self, realization: int) -> str:
        try:
            self.read(realization)
        except DamagedRecordError as error:
            aside = _set_aside(self._loose_path(realization))
            return f"{error} It is set aside as {aside.name}, and realization {realization} is run again."
        return ""

    def _unpack_damaged(self, path: Path) -> str:
        """Turn a damaged pack back into loose records, as far as they are whole."""
        block = range(number := int(path.stem[1:]) * PACK_SIZE, number + PACK_SIZE)
        whole, lost = [], 0
        for realization in block:
            try:
                whole.append(_read(path, file_name(realization)))
            except DamagedRecordError:
                lost += 1
        if not lost:
            return ""
        for record in whole:
            if not self._loose_path(record.realization).exists():
                self.write(record)
        aside = _set_aside(path)
        return f"{path} is damaged; it is set aside as {aside.name}, and {lost} of its realizations are run again."

    def _loose(self) -> set[int]:
        numbers = {int(path.stem.partition("-")[2]) for path in self.records.glob("realization-*.h5")}
        return numbers | ({BASELINE} if self._loose_path(BASELINE).exists() else set())

    def _pack_paths(self) -> list[Path]:
        return sorted(self.packs.glob("p*.h5"))

    def _loose_path(self, realization: int) -> Path:
        return self.records / f"{file_name(realization)}.h5"

    def _pack_path(self, number: int) -> Path:
        return self.packs / f"p{number:05d}.h5"


def file_name(realization: int) -> str:
    """Return what files and groups of a realization are called, without a suffix."""
    return "baseline" if realization == BASELINE else f"realization-{realization:06d}"


def _packed(path: Path) -> list[int]:
    try:
        with h5py.File(path, "r") as file:
            return [int(match[1]) for name in file if (match := re.fullmatch(r"realization-(\d+)", name))]
    except OSError as error:
        raise DamagedRecordError(f"The pack {path} cannot be opened ({error}).") from error


def _read(path: Path, name: str) -> Record:
    try:
        with h5py.File(path, "r") as file:
            group: Any = file[name]
            return read_group(group, f"{path}{name if name != '/' else ''}")
    except (OSError, KeyError) as error:
        raise DamagedRecordError(f"The record in {path} cannot be opened ({error}).") from error


def _set_aside(path: Path) -> Path:
    aside = path.with_name(path.name + ".damaged")
    path.replace(aside)
    return aside
