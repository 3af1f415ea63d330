"""A replayed realization is the recorded one, and its file is what VTKHDF 2.0 asks for."""

import re

import h5py
import numpy as np
import pytest
from records import make_record
from small_campaign import run, small_scene

from campaign.errors import RefusalError
from campaign.record import Status
from campaign.results import replay as replaying
from campaign.results.replay import comparison, replay
from campaign.seeds import BASELINE
from campaign.storage.record_store import RecordStore
from campaign.storage.vtkhdf import ParticleFile


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    directory = tmp_path_factory.mktemp("campaign")
    ground, records = run(directory, small_scene("campaign.realizations=2"))
    return directory, ground, records


@pytest.fixture(scope="module")
def path(campaign):
    return replay(campaign[0], 1)


@pytest.mark.parametrize("realization", [BASELINE, 0])
def test_the_result_is_the_recorded_one_bit_for_bit(campaign, realization, capsys):
    replay(campaign[0], realization)
    assert "is the recorded one, bit for bit" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "sentence"),
    [("final_runout", "its final run-out is [0-9.]+ m, recorded"), ("energy_error", "run-out is still .* bit for bit")],
)
def test_another_last_bit_is_noticed(campaign, name, sentence):
    record = RecordStore(campaign[0]).read(1)
    changed = {name: np.nextafter(record.values[name], np.inf), "wall_time": 0.0}
    other = type(record)(1, record.status, "", record.values | changed)
    assert re.search(f"NOT the recorded one in {name}; .*{sentence}", comparison(other, record))


def test_the_file_has_the_structure_of_the_format(path, campaign):
    """Attributes, datasets and lengths after the specification of VTKHDF 2.0, sections Unstructured grid and Steps."""
    n = campaign[1].n_particles
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        assert list(root.attrs["Version"]) == [2, 0]
        assert root.attrs["Type"] == b"UnstructuredGrid"
        assert root.attrs.get_id("Type").get_type().get_cset() == h5py.h5t.CSET_ASCII
        assert not root.attrs.get_id("Type").get_type().is_variable_str()
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
            np.testing.assert_array_equal(root[name], [n])
        assert (root["Offsets"].shape, root["Connectivity"].shape, root["Types"].dtype) == ((n + 1,), (n,), np.uint8)
        steps, count = root["Steps"], int(root["Steps"].attrs["NSteps"])
        assert root["Points"].shape == (count * n, 3)
        np.testing.assert_array_equal(steps["PointOffsets"], n * np.arange(count))
        assert steps["CellOffsets"].shape == steps["ConnectivityIdOffsets"].shape == (count, 1)
        assert steps["Values"].shape == steps["PartOffsets"].shape == steps["NumberOfParts"].shape == (count,)
        for name, values in root["PointData"].items():
            offsets = steps["PointDataOffsets"][name][:]
            assert offsets.shape == (count,)
            assert offsets[-1] + n == values.shape[0]


def test_the_file_holds_the_slide(path, campaign):
    n, record = campaign[1].n_particles, campaign[2][2]
    with h5py.File(path) as file:
        data, times = file["VTKHDF/PointData"], file["VTKHDF/Steps/Values"][:]
        farthest = np.linalg.norm(data["displacement"][:].reshape(len(times), n, 3), axis=2).max(axis=1)
        np.testing.assert_allclose(farthest, record.values["max_displacement"][: len(times)], rtol=1e-6)
        assert data["cohesion"][:n] == pytest.approx(data["peak_cohesion"][:])
        assert np.all(data["cohesion"][-n:] <= data["peak_cohesion"][:])
        assert data["cohesion"][:].min() >= 10e3
        assert data["stress"].shape[1] == 6
        settled = record.values["settle_time"]
        assert times[-1] == pytest.approx(10.0 if np.isnan(settled) else settled)


@pytest.mark.parametrize(("realization", "sentence"), [(-2, "There is no realization -2"), (7, "no record to compare")])
def test_a_realization_that_the_campaign_has_not(campaign, realization, sentence, capsys):
    if realization < 0:
        with pytest.raises(RefusalError, match=sentence):
            replay(campaign[0], realization)
    else:
        replay(campaign[0], realization)
        assert sentence in capsys.readouterr().out


def test_another_reading_of_the_scene_is_refused(campaign, monkeypatch):
    about = replaying.manifest.read(campaign[0])
    monkeypatch.setattr(replaying.manifest, "read", lambda _: about | {"digest": "0" * 64})
    with pytest.raises(RefusalError, match="reads the scene of the campaign differently"):
        replay(campaign[0], 0)


def test_what_breaks_off_is_kept_as_far_as_it_got(tmp_path):
    path, points = tmp_path / "slide.vtkhdf", np.zeros((4, 3))
    with pytest.raises(ZeroDivisionError), ParticleFile(path, {"peak": np.ones(4)}) as file:  # noqa: PT012
        file.append(0.0, points, {"speed": np.zeros(4)})
        raise ZeroDivisionError
    with h5py.File(path) as file:
        assert file["VTKHDF/Steps"].attrs["NSteps"] == 1
    assert list(tmp_path.iterdir()) == [path]


def test_a_slide_that_never_began_leaves_no_file(tmp_path):
    with pytest.raises(ZeroDivisionError), ParticleFile(tmp_path / "slide.vtkhdf", {"peak": np.ones(4)}):
        raise ZeroDivisionError
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("status", "least"), [(Status.slid, ""), (Status.reached_wall, "at least ")])
def test_the_run_out_of_a_slide_cut_short_is_told_as_a_lower_bound(status, least):
    record = make_record(3, status)
    told = f"its final run-out is {least}{record.values['final_runout']:.3f} m."
    assert comparison(record, None).endswith(told)
    assert comparison(record, record).endswith(told)
