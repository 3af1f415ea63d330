"""Records survive whatever happens to the process and the disk, or are recognised as damaged."""

import errno
import os

import h5py
import numpy as np
import pytest
from records import SIZES, assert_same, make_record

from campaign.errors import DamagedRecordError
from campaign.record import QUANTITIES, Status, missing_values
from campaign.seeds import BASELINE
from campaign.storage import record_store as store_module
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
        assert {name: file[name].attrs["units"] for name in file} == {n: q.units for n, q in QUANTITIES.items()}


def test_missing_values_are_nan():
    values = missing_values(SIZES)
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
    monkeypatch.setattr(store_module, "PACK_SIZE", 4)
    for realization in (BASELINE, *range(10)):
        store.write(make_record(realization))
    store.pack()
    return store


def test_packing_keeps_every_record(packed):
    assert sorted(path.name for path in packed.packs.iterdir()) == ["p00000.h5", "p00001.h5"]
    assert len(list(packed.records.iterdir())) == 3
    for expected, record in zip((BASELINE, *range(10)), packed.read_all(), strict=True):
        assert_same(record, make_record(expected))


def test_a_kill_between_packing_and_removing_does_no_harm(packed):
    packed.write(make_record(2))
    assert packed.recover() == []
    assert packed.finished() == {BASELINE, *range(10)}


def test_the_whole_records_of_a_damaged_pack_are_saved(packed):
    with h5py.File(packed.packs / "p00000.h5", "r+") as file:
        file["realization-000002/runout"][0] += 1
    (sentence,) = packed.recover()
    assert "1 of its realizations" in sentence
    assert packed.finished() == {BASELINE, *range(10)} - {2}
    assert_same(packed.read(3), make_record(3))


def test_a_pack_that_cannot_be_opened_frees_its_ids(packed):
    os.truncate(packed.packs / "p00001.h5", 100)
    assert len(packed.recover()) == 1
    assert packed.finished() == {BASELINE, 0, 1, 2, 3, 8, 9}
