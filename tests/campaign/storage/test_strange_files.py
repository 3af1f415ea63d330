"""What a sync client or a bad disk puts into a results directory is left alone, refused or set aside."""

import contextlib
import json
import os
import socket
import subprocess

import h5py
import numpy as np
import pytest
from records import GROUND, assert_same, make_record

from campaign.errors import DamagedRecordError, RefusalError
from campaign.record import Record, Status
from campaign.running.level import Level
from campaign.running.standing import status
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.storage import manifest, pack_format, record_format, salvage
from campaign.storage.attempts import Attempts
from campaign.storage.columns import columns_of
from campaign.storage.packs import Packs

SCENE = load_scene("ma2023", ["campaign.realizations=8"])


@pytest.fixture
def level(tmp_path, monkeypatch):
    """A campaign with four realizations in a pack, two loose ones and the baseline."""
    monkeypatch.setattr(Packs, "SIZE", 4)
    manifest.begin(tmp_path, SCENE, 1, allow_drift=False)
    made = Level(SCENE, tmp_path)
    made.open()
    for realization in (BASELINE, *range(6)):
        made.store.write(make_record(realization))
    made.store.pack()
    return Level(SCENE, tmp_path)


def test_foreign_files_are_left_alone_everywhere(level, tmp_path):
    names = ["(conflicted copy).h5", ".DS_Store", ".nfs00000001", "._realization-000001.h5", "Icon\r", "rank-000x"]
    strange = [tmp_path / room / name for room in (".", "records", "packs", "attempts") for name in names]
    strange += [tmp_path / room / ".sync" / "inside" for room in (".", "records", "packs", "attempts")]
    for path in strange:
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(b"\xff\x00?")
    assert level.open() == []
    level.fit(GROUND)
    assert level.tally().done == 6
    assert "6/8 done" in status(tmp_path)
    assert all(path.exists() for path in strange)


@pytest.mark.parametrize("room", ["records/realization-000004.h5", "packs/p00000.h5"])
def test_a_directory_in_the_place_of_a_file_is_no_file(level, tmp_path, room):
    (tmp_path / room).unlink()
    (tmp_path / room).mkdir()
    assert level.open() == []
    assert level.tally().done in (2, 5)
    assert "failed" in status(tmp_path)


@pytest.mark.parametrize("garbage", [b"\xff\xfe", b"", b"3", b"three\nfell over", b"9" * 5000 + b"\nx", b"\n\n\n"])
def test_garbage_among_the_attempts_is_held_against_nobody(tmp_path, garbage):
    attempts = Attempts(tmp_path)
    attempts.create()
    for name in ("rank-0000", "crashes"):
        (attempts.directory / name).write_bytes(garbage)
    assert attempts.given_up() == {}


def test_crashes_are_counted_beside_garbage(tmp_path):
    attempts = Attempts(tmp_path)
    attempts.create()
    for _ in range(2):
        (attempts.directory / "rank-0001").write_text("3\nFatal Python error: Bus error\n\nThread 1\n")
        found = attempts.given_up()
        crashes = attempts.directory / "crashes"
        crashes.write_text(f"{crashes.read_text()}\x00\n{{}}\n4 \n")
    assert found == {3: "took the process down 2 times: Fatal Python error: Bus error"}


def test_a_file_in_the_place_of_the_attempts_is_refused(level, tmp_path):
    (tmp_path / "attempts").rmdir()
    (tmp_path / "attempts").write_text("?")
    with pytest.raises(OSError, match="attempts"):  # told in a sentence where the directory is opened
        level.open()


@pytest.mark.parametrize("change", [{"starts": []}, {"starts": 3}, {"starts": [{}]}, {"identity": []}, {"end": 1}])
def test_a_manifest_of_another_make_is_refused(level, tmp_path, change):
    path = tmp_path / "manifest.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | change))
    with pytest.raises(RefusalError, match=f"is damaged \\({next(iter(change))}"):
        manifest.read(tmp_path)


@pytest.mark.parametrize("content", [b"\xff\xfe", b"[" * 100_000, None])
def test_what_is_no_manifest_is_refused(level, tmp_path, content):
    path = tmp_path / "manifest.json"
    path.unlink()
    path.mkdir() if content is None else path.write_bytes(content)
    with pytest.raises(RefusalError, match="is damaged"):
        manifest.begin(tmp_path, SCENE, 1, allow_drift=False)


@pytest.mark.parametrize("strange", [np.zeros(3), 1.0, np.array([b"a"] * 5)])
def test_records_of_another_shape_are_run_again(level, tmp_path, capsys, strange):
    for realization in (2, 5):
        values = make_record(realization).values | {"runout": strange}
        level.store.write(Record(realization, Status.slid, "", values))
    level = Level(SCENE, tmp_path)
    assert level.open() == []
    level.fit(GROUND)
    assert sorted({BASELINE, *range(6)} - level.store.finished()) == [5]
    assert_same(level.store.read(2), make_record(2))  # the packed one stands
    assert capsys.readouterr().out.count("runout differs in shape") == 2


def test_a_pack_of_another_shape_is_run_again(level, tmp_path):
    values = [make_record(k).values | {"runout": np.zeros(3)} for k in range(4)]
    level.store.packs.write(0, columns_of([Record(k, Status.slid, "", values[k]) for k in range(4)]))
    level = Level(SCENE, tmp_path)
    level.open()
    level.fit(GROUND)
    assert level.store.finished() == {BASELINE, 4, 5}


def mutated(content, rng):
    """Return bytes of which one to four, next to each other, are others."""
    place, changed = rng.integers(len(content)), bytearray(content)
    changed[place : place + rng.integers(1, 5)] = rng.bytes(len(changed[place : place + rng.integers(1, 5)]))
    return bytes(changed)


def test_mutated_bytes_are_damage_or_change_nothing():
    """In a thousand files; HDF5 does not see those bytes."""
    record, rng = make_record(0), np.random.default_rng(1)
    content, found = record_format.to_bytes(record), {"damaged": 0, "refused": 0, "same": 0}
    for _ in range(1000):
        try:
            assert_same(record_format.from_bytes(mutated(content, rng), "a file"), record)
            found["same"] += 1
        except DamagedRecordError:
            found["damaged"] += 1
        except RefusalError:  # the mutated format is a newer one
            found["refused"] += 1
    assert found["damaged"] > 900
    assert found["refused"] < 10


def test_a_first_line_that_is_no_text_is_damage():
    content = record_format.to_bytes(make_record(0)).replace(b"read by 0", b"read by \x92")
    with pytest.raises(DamagedRecordError, match="does not begin as it was written"):
        record_format.from_bytes(content, "a file")


def test_mutated_packs_give_whole_records_or_none(tmp_path, monkeypatch):
    """Without a process for each: what it does is done here. A byte that no record rests on may be any."""
    monkeypatch.setattr(Packs, "SIZE", 4)
    records = [make_record(k) for k in range(4)]
    content, rng = pack_format.to_bytes(columns_of(records)), np.random.default_rng(2)
    path, whole = tmp_path / "p00000.h5", 0
    for _ in range(100):
        path.write_bytes(mutated(content, rng))
        for read in (pack_format.read, pack_format.read_summary, pack_format.verify):
            with contextlib.suppress(DamagedRecordError):
                read(path)
        if rng.random() < 0.1:
            for record in salvage.salvaged(path):
                assert_same(record, make_record(record.realization))
                whole += 1
    assert whole > 4


def test_rows_of_a_pack_whose_units_are_damaged_are_not_whole(tmp_path):
    path, content = tmp_path / "p00000.h5", pack_format.to_bytes(columns_of([make_record(k) for k in range(4)]))
    path.write_bytes(content)
    assert len(pack_format.whole_records(path)) == 4
    with h5py.File(path, "r+") as file:
        file["values/runout"].attrs["units"] = "s"
    assert pack_format.whole_records(path) == []


def test_a_pack_on_which_the_library_does_not_end_is_given_up(level, tmp_path, monkeypatch):
    def too_long(command, timeout, **_options):
        raise subprocess.TimeoutExpired(command, timeout)

    path = tmp_path / "packs" / "p00000.h5"
    path.write_bytes(path.read_bytes()[:-1] + b"!")
    monkeypatch.setattr(subprocess, "run", too_long)
    (sentence,) = level.open()
    assert "4 of its realizations are run again" in sentence
    assert level.tally().done == 2


def test_what_a_killed_process_was_writing_is_cleared_and_nothing_else(level, tmp_path):
    rooms = (tmp_path, tmp_path / "records", tmp_path / "packs", tmp_path / "attempts")
    killed = [room / name for room in rooms for name in (".results.nc.a.host.with.dots.99", ".x.h5.elsewhere.1")]
    at_work = [room / f".report.html.{socket.gethostname()}.{os.getpid()}" for room in rooms]
    for path in killed + at_work:
        path.touch()
    assert level.open() == []
    assert [path.exists() for path in killed + at_work] == [False] * 8 + [True] * 4
