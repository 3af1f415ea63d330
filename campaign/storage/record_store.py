"""The records of a campaign on disk: one file a realization, later packed by the hundred.

A loose record takes precedence over a packed one. Any rank may write records; only rank 0, which holds the directory's
lock, recovers and packs.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from campaign.errors import DamagedRecordError
from campaign.files import clear_temporaries
from campaign.record import RealizationSummary, Record
from campaign.seeds import BASELINE
from campaign.storage.columns import Columns, columns_of
from campaign.storage.loose_records import LooseRecords
from campaign.storage.packs import Packs
from campaign.storage.soundness import Shape


class RecordStore:
    """The finished realizations of the campaign in `directory`.

    `recover` reads each record once. What the campaign asks for next is then in memory: a summary of each, and the
    whole record where it is not packed. `scene` is the SHA-256 of the scene that the records belong to, "" for any.
    """

    def __init__(self, directory: Path, scene: str = "") -> None:
        self.loose = LooseRecords(directory, scene)
        self.packs = Packs(directory, scene)
        self.records = self.loose.directory

    def create(self) -> None:
        """Make the directories; raises OSError where that is not allowed."""
        self.loose.directory.mkdir(parents=True, exist_ok=True)
        self.packs.directory.mkdir(parents=True, exist_ok=True)

    def write(self, record: Record) -> None:
        """Keep a record for good; raises OSError, leaving no trace, when the disk is full or not writable."""
        self.loose.write(record)

    def read(self, realization: int) -> Record:
        """Return a finished realization's record.

        Raises
        ------
        KeyError
            When there is none.
        DamagedRecordError
            When its file is truncated or altered.
        RefusalError
            When only a newer version of the program can read it.
        """
        try:
            return self.loose.read(realization)
        except FileNotFoundError:
            return self._read_packed(realization)

    def columns(self, count: int) -> Iterator[Columns]:
        """Yield the records of realizations 0 to `count` - 1, in any order; raises like `read`.

        What is not packed is asked for by name: on a network file system, the list of a directory in which another
        node has written is up to a minute old.
        """
        loose, missing = self.loose.ids(), set(range(count))
        for number in self.packs.numbers():
            packed = self.packs.read(number)
            wanted = (packed.realizations < count) & ~np.isin(packed.realizations, list(loose))
            missing -= set(packed.realizations[wanted].tolist())
            yield packed.take(wanted)
        for realization in sorted(missing):
            yield columns_of([self.read(realization)])

    def finished(self) -> set[int]:
        """Return the ids that have a readable record, the baseline's included."""
        return set(self.summaries()[0])

    def summaries(self) -> tuple[dict[int, RealizationSummary], list[str]]:
        """Return what decisions rest on, by id, and a sentence for each file that cannot be read.

        Loose records are looked at first: one that a campaign at work packs meanwhile is found in its pack.
        """
        found: dict[int, RealizationSummary] = {}
        damaged: list[str] = []
        for realization in sorted(self.loose.ids()):
            try:
                found[realization] = self.loose.summary(realization)
            except DamagedRecordError as error:
                damaged.append(str(error))
            except FileNotFoundError:
                continue
        for number in self.packs.numbers():
            try:
                for each in self.packs.summaries(number):
                    found.setdefault(each.realization, each)
            except DamagedRecordError as error:
                damaged.append(str(error))
        return found, damaged

    def recover(self) -> list[str]:
        """Clear what a killed campaign left behind, and set damaged files aside so that their ids are run again.

        Returns
        -------
        list of str
            A sentence for each damaged file, which is kept under the name `*.damaged`.
        """
        for directory in (self.loose.directory, self.packs.directory):
            clear_temporaries(directory)
        sentences = [self._check_pack(number) for number in self.packs.numbers()]
        sentences += [self.loose.check(realization) for realization in sorted(self.loose.ids())]
        return [sentence for sentence in sentences if sentence]

    def check_shapes(self, wanted: Mapping[str, Shape]) -> list[str]:
        """Set files aside whose quantities have not the shapes `wanted`, so that their ids are run again.

        Returns
        -------
        list of str
            A sentence for each.
        """
        sentences = [self.packs.check_shapes(number, wanted) for number in self.packs.numbers()]
        sentences += [self.loose.check_shapes(realization, wanted) for realization in sorted(self.loose.ids())]
        return [sentence for sentence in sentences if sentence]

    def pack(self) -> None:
        """Move complete runs of `Packs.SIZE` loose records into packs; raises OSError when the disk is full."""
        size, loose = self.packs.SIZE, self.loose.ids() - {BASELINE}
        for number in sorted({realization // size for realization in loose}):
            block = set(range(number * size, (number + 1) * size))
            try:
                if block <= loose | self._packed(number):
                    self._pack(number, block & loose)
            except (DamagedRecordError, ValueError, TypeError):  # the next start sets a damaged one aside
                continue

    def _pack(self, number: int, loose: set[int]) -> None:
        """Merge loose records into a pack; raises ValueError or TypeError when they are not of one shape."""
        packed = self.packs.read(number).records() if self._packed(number) else []
        records = {record.realization: record for record in packed}
        records |= {realization: self.loose.read(realization) for realization in loose}
        self.packs.write(number, columns_of([records[realization] for realization in sorted(records)]))
        for realization in loose:
            self.loose.remove(realization)

    def _packed(self, number: int) -> set[int]:
        """Return the ids in a pack; raises like `Packs.summaries`."""
        exists = self.packs.path(number).exists()
        return {each.realization for each in self.packs.summaries(number)} if exists else set()

    def _check_pack(self, number: int) -> str:
        """Turn a damaged pack back into loose records, as far as they are whole."""
        whole, sentence = self.packs.check(number)
        loose = self.loose.ids()
        for record in whole:
            if record.realization not in loose:
                self.write(record)
        return sentence

    def _read_packed(self, realization: int) -> Record:
        number = realization // self.packs.SIZE
        if realization == BASELINE or not self.packs.path(number).exists():
            raise KeyError(realization)
        packed = self.packs.read(number)
        (rows,) = np.nonzero(packed.realizations == realization)
        if rows.size == 0:
            raise KeyError(realization)
        return packed.record(int(rows[0]))
