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
from campaign.storage.pack_summary import PackSummary, summary_of
from campaign.storage.salvage import salvaged
from campaign.storage.soundness import (
    Shape,
    check_owner,
    check_sound,
    is_sound,
    may_belong,
    misfit,
    not_fitting,
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
        self._known: dict[int, PackSummary] = {}

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
        columns = pack_format.read(self.path(number))
        self._check_own(number, summary_of(columns))
        return columns

    def summaries(self, number: int) -> list[RealizationSummary]:
        """Return the part of each record that decisions rest on; raises like `read`.

        Records that follow are not looked at, unless the pack is an older one. The file is read once.
        """
        if number not in self._known:
            self._keep(number, pack_format.read_summary(self.path(number)))
        return self._known[number].realizations

    def check_shapes(self, number: int, wanted: Mapping[str, Shape]) -> str:
        """Set a pack aside whose quantities have not the shapes `wanted`; returns a sentence when it was, else ""."""
        name = misfit(self._known[number].shapes, wanted) if number in self._known else ""
        return not_fitting(self.path(number), name, "its realizations are") if name else ""

    def write(self, number: int, columns: Columns) -> None:
        """Keep a pack for good; raises OSError, leaving the old one, when the disk is full or not writable."""
        ours = replace(columns, scene=self._scene)
        write_atomically(self.path(number), pack_format.to_bytes(ours))
        self._known[number] = summary_of(ours)

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
            self._keep(number, pack_format.verify(path))
        except DamagedRecordError as error:
            whole = [record for record in salvaged(path) if self._is_ours(record)]
            lost, aside = self.SIZE - len(whole), set_aside(path)
            return whole, f"{error} It is set aside as {aside.name}, and {lost} of its realizations are run again."
        if not pack_format.is_current(path):
            self.write(number, self.read(number))
        return [], ""

    def _keep(self, number: int, known: PackSummary) -> None:
        self._check_own(number, known)
        self._known[number] = known

    def _check_own(self, number: int, known: PackSummary) -> None:
        """Make sure that a pack can be this campaign's; raises DamagedRecordError if not."""
        place = f"The pack {self.path(number)}"
        check_owner(known.scene, self._scene, place)
        check_sound(known.realizations, place)
        if any(each.realization // self.SIZE != number for each in known.realizations):
            raise DamagedRecordError(f"{place} holds other realizations than its name says.")

    def _is_ours(self, record: Record) -> bool:
        return may_belong(record.scene, self._scene) and is_sound(summarize(record))
