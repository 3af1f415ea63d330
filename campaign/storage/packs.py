"""The packs: files of consecutive realizations, which spare a cluster's inodes and are read in one go."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from campaign.errors import DamagedRecordError
from campaign.files import file_names, set_aside, write_atomically
from campaign.record import RealizationSummary, Record, summarize
from campaign.storage import pack_format
from campaign.storage.columns import Columns
from campaign.storage.layout import PACKS, pack_file, pack_of
from campaign.storage.salvage import salvaged
from campaign.storage.soundness import (
    Shape,
    check_owner,
    check_sound,
    is_sound,
    may_belong,
    misfit,
    not_fitting,
    shape_of,
)


class Packs:
    """The files `packs/p00003.h5` of a results directory; that one holds `SIZE` realizations from 3 `SIZE` on.

    Parameters
    ----------
    directory
        Of the results.
    scene
        SHA-256 of the scene that the packs belong to; one that says it belongs to another is damaged. "" takes all.
    """

    SIZE = 256

    def __init__(self, directory: Path, scene: str = "") -> None:
        self.directory = directory / PACKS
        self._scene = scene
        self._summaries: dict[int, list[RealizationSummary]] = {}
        self._shapes: dict[int, dict[str, Shape]] = {}

    def path(self, number: int) -> Path:
        """Return the file of a pack, whether or not it is there."""
        return self.directory / pack_file(number)

    def numbers(self) -> list[int]:
        """Return the numbers of the packs, in order."""
        found = map(pack_of, file_names(self.directory))
        return sorted(number for number in found if number is not None)

    def read(self, number: int) -> Columns:
        """Return the records of a pack.

        Raises
        ------
        DamagedRecordError
            When it is not as it was written.
        RefusalError
            When only a newer version of the program can read it.
        """
        return self._own(number, pack_format.read(self.path(number)))

    def summaries(self, number: int) -> list[RealizationSummary]:
        """Return the part of each record that decisions rest on; the file is read once. Raises like `read`."""
        if number not in self._summaries:
            read = pack_format.read_summarized(self.path(number))
            self._keep(number, self._own(number, read))
        return self._summaries[number]

    def check_shapes(self, number: int, wanted: Mapping[str, Shape]) -> str:
        """Set a pack aside whose quantities have not the shapes `wanted`; returns a sentence when it was, else ""."""
        name = misfit(self._shapes.get(number, {}), wanted)
        return not_fitting(self.path(number), name, "its realizations are") if name else ""

    def write(self, number: int, columns: Columns) -> None:
        """Keep a pack for good; raises OSError, leaving the old one, when the disk is full or not writable."""
        write_atomically(self.path(number), pack_format.to_bytes(replace(columns, scene=self._scene)))
        self._keep(number, columns)

    def check(self, number: int) -> tuple[list[Record], str]:
        """Verify a pack, and bring one of an older format up to date.

        Returns
        -------
        whole, sentence
            The whole records of a damaged pack, which is set aside, as far as they are this campaign's, and a
            sentence about it; nothing and "" of a pack that is not damaged.
        """
        path = self.path(number)
        try:
            columns = self.read(number)
        except DamagedRecordError as error:
            whole = [record for record in salvaged(path) if self._is_ours(record)]
            lost, aside = self.SIZE - len(whole), set_aside(path)
            return whole, f"{error} It is set aside as {aside.name}, and {lost} of its realizations are run again."
        if pack_format.is_current(path):
            self._keep(number, columns)
        else:
            self.write(number, columns)
        return [], ""

    def _keep(self, number: int, columns: Columns) -> None:
        self._summaries[number] = columns.summaries
        self._shapes[number] = {name: shape_of(column[0]) for name, column in columns.values.items() if len(column)}

    def _own(self, number: int, columns: Columns) -> Columns:
        """Return a pack if it can be this campaign's; raises DamagedRecordError if not."""
        place = f"The pack {self.path(number)}"
        check_owner(columns.scene, self._scene, place)
        check_sound(columns.summaries, place)
        if (columns.realizations // self.SIZE != number).any():
            raise DamagedRecordError(f"{place} holds other realizations than its name says.")
        return columns

    def _is_ours(self, record: Record) -> bool:
        return may_belong(record.scene, self._scene) and is_sound(summarize(record))
