"""A restart reads each record once, whoever asks for it afterwards."""

from collections import Counter
from pathlib import Path

import pytest
from records import GROUND, make_record

from campaign.record import summarize
from campaign.results import dataset
from campaign.running.level import Level
from campaign.running.standing import status
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.storage import manifest, pack_format, packs, record_format
from campaign.storage.layout import PACKS, RECORDS
from campaign.storage.packs import Packs
from campaign.storage.record_store import RecordStore

SCENE = load_scene("ma2023", ["campaign.realizations=30"])


@pytest.fixture(autouse=True)
def small_packs(monkeypatch):
    monkeypatch.setattr(Packs, "SIZE", 4)


@pytest.fixture
def killed(tmp_path):
    """A campaign of 22 realizations in three packs and ten loose files, and the baseline."""
    manifest.begin(tmp_path, SCENE, 1, allow_drift=False)
    store = RecordStore(tmp_path)
    store.create()
    for realization in (BASELINE, *range(12)):
        store.write(make_record(realization))
    store.pack()
    for realization in (*range(12, 15), *range(16, 19), *range(20, 24)):
        store.write(make_record(realization))
    return tmp_path


@pytest.fixture
def reads(monkeypatch):
    """Which files were read, and how often."""
    counted = Counter()
    whole = Path.read_bytes

    def counting(path):
        counted[path.relative_to(path.parents[1]).as_posix()] += 1
        return whole(path)

    monkeypatch.setattr(Path, "read_bytes", counting)
    return counted


def resume(directory):
    level = Level(SCENE, directory)
    assert level.open() == []
    level.fit(GROUND)
    return level, level.tally()


def test_a_restart_reads_each_record_once(killed, reads):
    _, tally = resume(killed)
    assert tally.done == 22
    assert set(reads.values()) == {1}
    assert len(reads) == 3 + 10 + 1


def test_the_dataset_asks_for_no_loose_record_again(killed, reads):
    level, tally = resume(killed)
    dataset.build(GROUND, level.store.columns(tally.prefix), level.store.read(BASELINE), tally.history(), {})
    assert tally.prefix == 15
    assert {count for name, count in reads.items() if name.startswith(RECORDS)} == {1}
    assert {count for name, count in reads.items() if name.startswith(PACKS)} <= {1, 2}


def test_a_restart_packs_what_a_kill_has_left(killed):
    resume(killed)
    assert len(list((killed / PACKS).iterdir())) == 4
    assert len(list((killed / RECORDS).iterdir())) == 1 + 6


def test_rank_0_packs_while_the_campaign_runs(tmp_path):
    level = Level(SCENE, tmp_path)
    level.open()
    tally = level.tally()
    tidy = level.tidier(tally)
    loose = []
    for realization in (BASELINE, *range(30)):
        level.store.write(make_record(realization))
        tally.add(summarize(make_record(realization)))
        tidy()
        loose.append(len(level.store.loose.ids()))
    assert max(loose) <= 1 + 4


def test_a_full_disk_does_not_stop_a_campaign_that_could_pack(killed, monkeypatch):
    def full(*_arguments):
        raise OSError("No space left on device")

    monkeypatch.setattr(packs, "write_atomically", full)
    _, tally = resume(killed)
    assert tally.done == 22


def test_the_status_reads_no_whole_record(killed, monkeypatch):
    def whole(*_arguments):
        raise AssertionError("a whole record was read")

    monkeypatch.setattr(pack_format, "read", whole)
    monkeypatch.setattr(record_format, "from_bytes", whole)
    assert "22/30 done, 0 failed" in status(killed)


def test_the_status_names_what_it_cannot_read(killed):
    (killed / RECORDS / "realization-000013.h5").write_bytes(b"")
    (killed / PACKS / "p00001.h5").write_bytes(b"x" * 1000)
    said = status(killed)
    assert "17/30 done" in said
    assert "realization-000013.h5" in said
    assert "p00001.h5" in said
