"""Records survive whatever happens to the process and the disk, or are recognised as damaged."""

import errno
import os
from dataclasses import replace

import h5py
import numpy as np
import pytest
from records import SIZES, assert_same, make_record

from campaign.errors import DamagedRecordError
from campaign.record import Status, missing_values, summarize
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.quantities import QUANTITIES, UNITS
from campaign.statistics.discretisation import with_half_cell
from campaign.storage import pack_summary
from campaign.storage.columns import columns_of
from campaign.storage.packs import Packs
from campaign.storage.record_store import RecordStore


@pytest.fixture
def store(tmp_path):
    made = RecordStore(tmp_path)
    made.create()
    return made


def test_a_record_comes_back_as_it_was_written(store):
    record = make_record(123, Status.diverged, "the speed is not a number – at step 7")
    store.write(record)
    assert_same(store.read(123), record)
    assert (store.records / "realization-000123.h5").exists()


def test_the_baseline_has_a_name_of_its_own(store):
    store.write(make_record(BASELINE))
    assert (store.records / "baseline.h5").exists()
    assert store.finished() == {BASELINE}


def test_every_float_in_a_record_file_has_a_unit(store):
    store.write(make_record(0))
    with h5py.File(store.records / "realization-000000.h5") as file:
        assert {name: file[name].attrs["units"] for name in file} == UNITS


def test_missing_values_are_nan():
    values = missing_values(QUANTITIES, SIZES)
    assert np.isnan(values["final_runout"])
    assert np.isnan(values["runout"]).all()
    assert values["displaced"].shape == (SIZES["particle"],)


@pytest.mark.parametrize("size", [0, 7, 1000])
def test_a_truncated_record_is_set_aside_and_its_id_is_free_again(store, size):
    for realization in range(3):
        store.write(make_record(realization))
    path = store.records / "realization-000001.h5"
    os.truncate(path, size)
    with pytest.raises(DamagedRecordError, match="realization-000001"):
        store.read(1)
    (sentence,) = store.recover()
    assert "realization 1 is run again" in sentence
    assert store.finished() == {0, 2}
    assert path.with_name(path.name + ".damaged").exists()


def test_an_altered_number_does_not_pass_the_checksum(store):
    store.write(make_record(0))
    with h5py.File(store.records / "realization-000000.h5", "r+") as file:
        file["final_runout"][()] += 1e-9
    with pytest.raises(DamagedRecordError, match="checksum"):
        store.read(0)


def test_a_full_disk_leaves_no_trace(store, monkeypatch):
    def full(_descriptor):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        store.write(make_record(0))
    assert list(store.records.iterdir()) == []


def test_what_a_killed_process_was_writing_is_cleared(store):
    (store.records / ".realization-000005.h5.host.99").write_bytes(b"half a rec")
    assert store.recover() == []
    assert list(store.records.iterdir()) == []


@pytest.fixture
def packed(store, monkeypatch):
    monkeypatch.setattr(Packs, "SIZE", 4)
    for realization in (BASELINE, *range(10)):
        store.write(make_record(realization))
    store.pack()
    return RecordStore(store.records.parent)


def pack_path(store, number):
    return store.packs.path(number)


def test_packing_keeps_every_record(packed):
    assert sorted(path.name for path in packed.packs.directory.iterdir()) == ["p00000.h5", "p00001.h5"]
    assert len(list(packed.records.iterdir())) == 3
    for realization in (BASELINE, *range(10)):
        assert_same(packed.read(realization), make_record(realization))


def test_the_columns_of_a_campaign_hold_each_realization_once(packed):
    rows = [record for block in packed.columns(9) for record in block.records()]
    assert sorted(record.realization for record in rows) == list(range(9))
    for record in rows:
        assert_same(record, make_record(record.realization))


def test_a_kill_between_packing_and_removing_does_no_harm(packed):
    packed.write(make_record(2))
    assert packed.recover() == []
    assert packed.finished() == {BASELINE, *range(10)}
    packed.pack()
    assert len(list(packed.records.iterdir())) == 3


def test_a_loose_record_takes_precedence_over_a_packed_one(packed):
    packed.write(make_record(2, Status.crashed, "again"))
    assert packed.summaries()[0][2].status is Status.crashed
    assert [record.reason for block in packed.columns(9) for record in block.records() if record.realization == 2] == [
        "again"
    ]
    packed.pack()
    assert RecordStore(packed.records.parent).read(2).reason == "again"


def test_the_whole_records_of_a_damaged_pack_are_saved(packed):
    with h5py.File(pack_path(packed, 0), "r+") as file:
        file["values/runout"][2, 0] += 1
    (sentence,) = packed.recover()
    assert "1 of its realizations" in sentence
    assert packed.finished() == {BASELINE, *range(10)} - {2}
    assert_same(packed.read(3), make_record(3))


def test_damage_to_the_summary_of_a_pack_is_noticed_and_costs_no_record(packed):
    path = pack_path(packed, 0)
    path.write_bytes(path.read_bytes().replace(b'{"rows": 4', b'{"rows": 3'))
    assert "does not match its checksum" in RecordStore(packed.records.parent).summaries()[1][0]
    (sentence,) = packed.recover()
    assert "0 of its realizations" in sentence
    assert packed.finished() == {BASELINE, *range(10)}


def test_a_summary_says_what_the_records_say_and_a_pack_without_one_is_read_whole(packed, monkeypatch):
    """As older packs are."""
    known = packed.packs.summaries(0)
    monkeypatch.setattr(pack_summary, "to_bytes", lambda _known: b"")
    packed.packs.write(0, packed.packs.read(0))
    assert pack_path(packed, 0).read_bytes()[512:516] == b"\x89HDF"
    older = RecordStore(packed.records.parent)
    assert older.packs.summaries(0) == known == [summarize(make_record(realization)) for realization in range(4)]
    assert older.recover() == []
    assert older.check_shapes({"runout": (3,)})[0].startswith(str(pack_path(packed, 0)))


def test_damage_to_a_compressed_row_stays_in_the_row(packed):
    path = pack_path(packed, 0)
    with h5py.File(path) as file:
        _, chunk = file["values/displaced"].id.read_direct_chunk((1, 0))
    content = path.read_bytes()
    path.write_bytes(content.replace(chunk, bytes(len(chunk))))
    (sentence,) = packed.recover()
    assert "1 of its realizations" in sentence
    assert packed.finished() == {BASELINE, *range(10)} - {1}


def test_a_pack_that_cannot_be_opened_frees_its_ids(packed):
    os.truncate(pack_path(packed, 1), 100)
    assert len(packed.recover()) == 1
    assert packed.finished() == {BASELINE, 0, 1, 2, 3, 8, 9}


def test_files_of_other_names_are_left_alone(packed):
    strange = packed.records / "realization-000003 (conflicted copy).h5"
    strange.write_bytes(b"?")
    (packed.records / ".sync").mkdir()
    assert packed.recover() == []
    assert packed.finished() == {BASELINE, *range(10)}
    assert strange.exists()


def test_a_record_under_the_name_of_another_is_set_aside(store):
    store.write(make_record(4))
    (store.records / "realization-000004.h5").rename(store.records / "realization-000005.h5")
    (sentence,) = store.recover()
    assert "is that of realization 4" in sentence
    assert store.finished() == set()


@pytest.mark.parametrize("place", [0, 40, 300, 600, 3000, -1])
def test_a_flipped_bit_anywhere_is_noticed_before_the_library_reads_on(store, place):
    """Also where HDF5 has nothing; only the padding of the first line decides nothing."""
    store.write(make_record(0))
    path = store.records / "realization-000000.h5"
    content = bytearray(path.read_bytes())
    content[place] ^= 1
    path.write_bytes(content)
    if 200 < place < 512:
        assert_same(store.read(0), make_record(0))
    else:
        with pytest.raises(DamagedRecordError):
            store.read(0)


OURS = load_scene("ma2023")
OTHERS = {
    "scene": load_scene(OURS, ["soil.cohesion.mean=21 kPa"]).digest(),
    "seed": load_scene(OURS, ["campaign.seed=7"]).digest(),
    "cell": with_half_cell(OURS, 6).digest(),
}


def kept(directory, owner, is_packed):
    """Return how many of four foreign records are taken for ours, and what is said."""
    theirs = RecordStore(directory, owner)
    theirs.create()
    for realization in range(4):
        theirs.write(make_record(realization))
    if is_packed:
        theirs.pack()
    ours = RecordStore(directory, OURS.digest())
    said = ours.summaries()[1]
    assert len(ours.recover()) == len(said)
    assert not ours.summaries()[1]
    return len(ours.finished()), said


@pytest.mark.parametrize("is_packed", [False, True])
@pytest.mark.parametrize("owner", OTHERS.values(), ids=OTHERS.keys())
def test_records_of_another_campaign_are_set_aside_and_run_again(tmp_path, monkeypatch, owner, is_packed):
    monkeypatch.setattr(Packs, "SIZE", 4)
    taken, said = kept(tmp_path, owner, is_packed)
    assert taken == 0
    assert all("belongs to another scene, seed or cell" in each for each in said)
    assert len(said) == (1 if is_packed else 4)


@pytest.mark.parametrize("is_packed", [False, True])
@pytest.mark.parametrize("owner", ["", OURS.digest()])
def test_records_of_this_campaign_are_taken_and_older_ones_that_do_not_say_whose(
    tmp_path, monkeypatch, owner, is_packed
):
    monkeypatch.setattr(Packs, "SIZE", 4)
    assert kept(tmp_path, owner, is_packed) == (4, [])


def test_whose_a_packed_record_is_stands_under_its_checksum(packed):
    """A damaged pack whose owner was changed gives no record away."""
    with h5py.File(pack_path(packed, 0), "r+") as file:
        file.attrs["scene"] = "b" * 64
    assert packed.recover()
    assert packed.finished() == {BASELINE, *range(4, 10)}


def test_a_pack_under_the_name_of_another_is_set_aside(packed):
    pack_path(packed, 1).rename(pack_path(packed, 7))
    (sentence,) = packed.recover()
    assert "other realizations than its name says" in sentence
    assert packed.finished() == {BASELINE, *range(10)}


@pytest.mark.parametrize("is_packed", [False, True])
@pytest.mark.parametrize("runout", [np.nan, np.inf])
def test_a_slide_without_a_runout_is_no_record(store, monkeypatch, runout, is_packed):
    monkeypatch.setattr(Packs, "SIZE", 4)
    records = [make_record(realization) for realization in range(4)]
    records[2] = replace(records[2], values=records[2].values | {"final_runout": runout})
    if is_packed:
        store.packs.write(0, columns_of(records))
    for record in () if is_packed else records:
        store.write(record)
    (sentence,) = RecordStore(store.records.parent).recover()
    assert "realization 2 slid, and its run-out is not a number" in sentence
    assert RecordStore(store.records.parent).finished() == {0, 1, 3}
