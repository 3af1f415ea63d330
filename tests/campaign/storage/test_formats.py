"""What one version has kept, others read: older files wholly, newer ones not at all, and each says why."""

import h5py
import numpy as np
import old_layout
import pytest
import xarray as xr
from records import GROUND, SIZES, assert_same, make_record

from campaign.errors import DamagedRecordError, RefusalError
from campaign.record import Record, Status
from campaign.results import dataset
from campaign.results.results import open_results
from campaign.running.level import Level
from campaign.running.standing import status
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.quantities import QUANTITIES
from campaign.storage import formats, manifest, seal
from campaign.storage.access import Access, judge
from campaign.storage.columns import columns_of
from campaign.storage.packs import Packs
from campaign.storage.record_store import RecordStore

SCENE = load_scene("ma2023", ["campaign.realizations=8"])


@pytest.fixture(autouse=True)
def small_packs(monkeypatch):
    monkeypatch.setattr(Packs, "SIZE", 4)


@pytest.fixture
def old(tmp_path):
    """A campaign of six realizations, four of them packed, by version 0.1.0."""
    old_layout.write_manifest(tmp_path, SCENE)
    old_layout.write_records(tmp_path, [make_record(k) for k in (BASELINE, 4, 5)], [make_record(k) for k in range(4)])
    return tmp_path


def results_of(store, tally):
    return dataset.build(GROUND, store.columns(tally.prefix), store.read(BASELINE), tally.history(), {})


def test_a_directory_of_the_first_version_is_read(old):
    assert judge(old).access is Access.READABLE
    assert "6/8 done, 0 failed" in status(old)
    store = RecordStore(old)
    for realization in (BASELINE, *range(6)):
        assert_same(store.read(realization), old_layout.kept(make_record(realization)))


def test_a_directory_of_the_first_version_goes_on(old, tmp_path_factory):
    """And ends with the dataset of one that was new all along."""
    sets = []
    for directory in (old, tmp_path_factory.mktemp("new")):
        assert manifest.begin(directory, SCENE, 2, allow_drift=False) == []
        level = Level(SCENE, directory)
        assert level.open() == []
        tally = level.tally()
        for realization in {BASELINE, *range(8)} - set(tally.summaries):
            level.store.write(old_layout.kept(make_record(realization)))
        sets.append(results_of(level.store, level.tally()))
    xr.testing.assert_identical(*sets)
    assert manifest.read(old)["format"] == formats.FORMAT


def test_an_old_pack_is_brought_up_to_date_at_the_next_start(old):
    Level(SCENE, old).open()
    with h5py.File(old / "packs" / "p00000.h5") as file:
        assert file["values/runout"].shape == (4, SIZES["time"])
    assert_same(RecordStore(old).read(2), old_layout.kept(make_record(2)))


def test_damage_to_an_old_record_is_found(old):
    with h5py.File(old / "records" / "realization-000004.h5", "r+") as file:
        file["runout"][0] += 1
    with pytest.raises(DamagedRecordError, match="checksum"):
        RecordStore(old).read(4)
    with h5py.File(old / "packs" / "p00000.h5", "r+") as file:
        file["realization-000002/runout"][0] += 1
    assert len(RecordStore(old).recover()) == 2
    assert RecordStore(old).finished() == {BASELINE, 0, 1, 3, 5}


def test_a_quantity_that_old_records_lack_is_missing_from_the_dataset(tmp_path):
    old_layout.write_records(
        tmp_path,
        [make_record(k) for k in (BASELINE, 4)],
        [make_record(k) for k in range(4)],
        without=["detached_volume", "deposit_surface", "steps"],
    )
    level = Level(SCENE, tmp_path)
    assert level.open() == []
    level.store.write(make_record(5))
    built = results_of(level.store, level.tally())
    assert np.isnan(built.detached_volume[:5]).all()
    assert np.isnan(built.deposit_surface[:5]).all()
    assert (built.steps[:5] == 0).all()
    assert float(built.detached_volume[5]) == make_record(5).values["detached_volume"]
    assert float(built.final_runout[2]) == make_record(2).values["final_runout"]


def test_a_quantity_of_a_later_version_is_kept_and_does_no_harm(tmp_path):
    store = RecordStore(tmp_path)
    store.create()
    pressure = np.arange(3.0)
    for realization in (BASELINE, *range(4)):
        record = make_record(realization)
        later = {"pore_pressure": pressure} if realization != 1 else {}
        store.write(Record(realization, Status.slid, "", record.values | later))
    np.testing.assert_array_equal(RecordStore(tmp_path).read(0).values["pore_pressure"], pressure)
    level = Level(SCENE, tmp_path)
    assert level.open() == []
    assert list(tmp_path.glob("packs/*.h5"))
    np.testing.assert_array_equal(RecordStore(tmp_path).read(0).values["pore_pressure"], pressure)
    assert np.isnan(RecordStore(tmp_path).read(1).values["pore_pressure"]).all()
    assert "pore_pressure" not in results_of(level.store, level.tally())


def test_records_of_different_shapes_stay_loose(tmp_path):
    store = RecordStore(tmp_path)
    store.create()
    for realization in range(4):
        values = make_record(realization).values | {"pore_pressure": np.zeros(realization)}
        store.write(Record(realization, Status.slid, "", values))
    store.pack()
    assert len(list(store.records.iterdir())) == 4


@pytest.fixture
def written_by_the_next_version(tmp_path, monkeypatch):
    """A record, a pack, a manifest and results of the next format."""
    later = formats.FORMAT + 1
    with monkeypatch.context() as patch:
        for module in (formats, seal, manifest):
            patch.setattr(module, "FORMAT", later)
            patch.setattr(module, "READER", "9.1.0")
        manifest.begin(tmp_path, SCENE, 1, allow_drift=False)
        store = RecordStore(tmp_path)
        store.create()
        for realization in range(5):
            store.write(make_record(realization))
        store.pack()
    about = {"format": later, "format_reader": "9.1.0"}
    xr.Dataset(attrs=about).to_netcdf(tmp_path / "results.nc")
    return tmp_path


@pytest.mark.parametrize(
    "read",
    [
        manifest.read,
        status,
        open_results,
        lambda directory: manifest.begin(directory, SCENE, 1, allow_drift=True),
        lambda directory: RecordStore(directory).read(0),
        lambda directory: RecordStore(directory).read(4),
        lambda directory: RecordStore(directory).summaries(),
    ],
)
def test_a_newer_format_is_refused_with_the_version_it_needs(written_by_the_next_version, read):
    with pytest.raises(RefusalError, match=r"has format 3, .* reads formats up to 2\. Use runout-campaign 9\.1\.0"):
        read(written_by_the_next_version)


def test_newer_records_are_never_set_aside(written_by_the_next_version):
    before = sorted(written_by_the_next_version.rglob("*.h5"))
    with pytest.raises(RefusalError):
        RecordStore(written_by_the_next_version).recover()
    assert sorted(written_by_the_next_version.rglob("*.h5")) == before


def test_one_function_says_what_may_be_done_with_a_directory(old, tmp_path_factory, monkeypatch):
    empty = tmp_path_factory.mktemp("empty")
    start = {"realization_sha256": "f" * 64, "versions": {}}
    other = load_scene("ma2023", ["soil.cohesion.cov=0.3"])
    assert judge(empty).access is Access.VACANT
    assert judge(empty / "absent").access is Access.VACANT
    assert judge(old).access is Access.READABLE
    assert judge(old, SCENE).access is Access.CONTINUABLE
    assert judge(old, SCENE, start).access is Access.READABLE
    assert "--allow-drift" in judge(old, SCENE, start).why
    assert judge(old, SCENE, start, allow_drift=True).access is Access.CONTINUABLE
    assert judge(old, other).access is Access.READABLE
    assert "soil.cohesion.cov" in judge(old, other).why
    (old / "manifest.json").unlink()
    assert judge(old, SCENE).access is Access.REFUSED
    assert "records but no manifest.json" in judge(old, SCENE).why


@pytest.mark.parametrize("text", ["{", "[]", '{"a": 1}', '{"format": "x"}', "3"])
def test_a_manifest_that_is_none_is_refused(old, text):
    (old / "manifest.json").write_text(text)
    assert judge(old).access is Access.REFUSED
    assert "manifest.json is damaged" in judge(old).why


def test_the_version_of_this_program_reads_its_own_format():
    numbers = tuple(int(part) for part in formats.program_version().split("."))
    assert numbers >= tuple(int(part) for part in formats.READER.split("."))


def test_rows_of_columns_are_the_records():
    records = [make_record(k, Status(k % 3), f"reason {k}") for k in range(5)]
    columns = columns_of(records)
    for record, row in zip(records, columns.records(), strict=True):
        assert_same(record, row)
    assert [each.final_runout for each in columns.summaries] == [r.values["final_runout"] for r in records]
    assert columns.values.keys() == QUANTITIES.keys()
