"""The records that have a file of their own."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from campaign.errors import DamagedRecordError
from campaign.files import file_names, set_aside, write_atomically
from campaign.record import RealizationSummary, Record, summarize
from campaign.storage.layout import RECORDS, realization_file, realization_of
from campaign.storage.record_format import from_bytes, summarized_from_bytes, to_bytes
from campaign.storage.soundness import Shape, check_owner, check_sound, misfit, not_fitting, shape_of


class LooseRecords:
    """The files `records/realization-000123.h5` and `records/baseline.h5` of a results directory.

    A record that was read and verified is kept in memory as long as it is loose.

    Parameters
    ----------
    directory
        Of the results.
    scene
        SHA-256 of the scene that the records belong to; one that says it belongs to another is damaged. "" takes all.
    """

    def __init__(self, directory: Path, scene: str = "") -> None:
        self.directory = directory / RECORDS
        self._scene = scene
        self._verified: dict[int, Record] = {}
        self._summaries: dict[int, RealizationSummary] = {}

    def path(self, realization: int) -> Path:
        """Return the file of a realization, whether or not it is there."""
        return self.directory / realization_file(realization)

    def ids(self) -> set[int]:
        """Return the realizations that have a file; what other files are called is no matter."""
        numbers = map(realization_of, file_names(self.directory))
        return {number for number in numbers if number is not None}

    def write(self, record: Record) -> None:
        """Keep a record for good; raises OSError, leaving no trace, when the disk is full or not writable."""
        write_atomically(self.path(record.realization), to_bytes(replace(record, scene=self._scene)))

    def read(self, realization: int) -> Record:
        """Return a record; its file is read once.

        Raises
        ------
        FileNotFoundError
            When there is none.
        DamagedRecordError
            When its file is truncated or altered, or holds another realization or that of another scene.
        RefusalError
            When only a newer version of the program can read it.
        """
        if realization not in self._verified:
            path = self.path(realization)
            self._verified[realization] = self._own(realization, from_bytes(path.read_bytes(), str(path)), path)
        return self._verified[realization]

    def summary(self, realization: int) -> RealizationSummary:
        """Return the part of a record that decisions rest on; raises like `read`."""
        if realization in self._verified:
            return summarize(self._verified[realization])
        if realization not in self._summaries:
            path = self.path(realization)
            record = self._own(realization, summarized_from_bytes(path.read_bytes(), str(path)), path)
            self._summaries[realization] = summarize(record)
        return self._summaries[realization]

    def remove(self, realization: int) -> None:
        """Remove a record that is kept elsewhere."""
        self.path(realization).unlink()
        self.forget(realization)

    def check(self, realization: int) -> str:
        """Set a damaged record aside so that its id is run again; returns a sentence when it was, else ""."""
        try:
            self.read(realization)
        except DamagedRecordError as error:
            aside = set_aside(self.path(realization))
            return f"{error} It is set aside as {aside.name}, and realization {realization} is run again."
        return ""

    def check_shapes(self, realization: int, wanted: Mapping[str, Shape]) -> str:
        """Set a record aside whose quantities have not the shapes `wanted`; returns a sentence when it was, else ""."""
        values = self.read(realization).values
        name = misfit({name: shape_of(value) for name, value in values.items()}, wanted)
        if not name:
            return ""
        self.forget(realization)
        return not_fitting(self.path(realization), name, f"realization {realization} is")

    def forget(self, realization: int) -> None:
        """Read the file of a record again when it is asked for: another rank will write it."""
        self._verified.pop(realization, None)
        self._summaries.pop(realization, None)

    def _own(self, realization: int, record: Record, path: Path) -> Record:
        """Return a record if it is what its name and its directory say; raises DamagedRecordError if not."""
        if record.realization != realization:
            raise DamagedRecordError(f"The record in {path} is that of realization {record.realization}.")
        check_owner(record.scene, self._scene, f"The record in {path}")
        check_sound([summarize(record)], f"The record in {path}")
        return record
