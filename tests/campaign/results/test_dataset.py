"""The dataset is what design and CF promise, and opens with xarray alone."""

import netCDF4
import numpy as np
import pytest
import xarray as xr
from records import GROUND, SIZES, make_record
from tallies import prefixes_of, summary_of

from campaign.record import FAILED, Status, summarize
from campaign.results import dataset
from campaign.seeds import BASELINE
from campaign.simulation.quantities import QUANTITIES
from campaign.statistics.convergence import convergence_history
from campaign.statistics.discretisation import Discretisation
from campaign.statistics.release import ReleaseComparison
from campaign.statistics.stopping import StoppingRule
from campaign.storage.columns import columns_of

STATUSES = [Status.slid, Status.no_slide, Status.crashed, *[Status.slid] * 65, Status.not_settled, Status.reached_wall]
RECORDS = [make_record(k, status, "no mass" if status is Status.crashed else "") for k, status in enumerate(STATUSES)]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    prefixes = prefixes_of([summarize(record) for record in RECORDS])
    estimates = convergence_history(prefixes, StoppingRule(0.01, 0.1, 0.95, 20, 25, 0.1), 10.0)
    pairs = Discretisation(1.0, np.array([-0.5, np.nan, -1.5]), 0.25, 0.95, 3, 1)
    release = ReleaseComparison("ramp", summary_of(BASELINE, 11.0))
    about = {"seed": "7", "scene": "title = 'é'\n"}
    blocks = [columns_of(RECORDS[:30]), columns_of(RECORDS[30:])]
    built = dataset.build(GROUND, blocks, make_record(BASELINE), estimates, about, pairs, release)
    target = tmp_path_factory.mktemp("results") / "results.nc"
    dataset.write(built, target)
    return target


@pytest.fixture
def opened(path):
    with xr.open_dataset(path) as data:
        yield data


def test_time_stays_a_number_of_seconds(opened):
    """Also where xarray decodes time: only spelled-out units such as "seconds" become a timedelta."""
    assert opened.time.dtype == opened.settle_time.dtype == opened.wall_time.dtype == np.float64
    assert opened.time.attrs["units"] == "s"


def test_dimensions_are_those_of_the_table(opened):
    for name, quantity in QUANTITIES.items():
        if name != "displaced":
            assert opened[name].dims == ("realization", *quantity.dims)
    assert opened.influence_probability.dims == ("particle",)
    assert opened.deterministic_runout.dims == ("time",)
    assert opened.runout_mean_ci.dims == ("checkpoint", "bound")


def test_every_float_has_a_unit_and_every_variable_a_name(opened):
    bounds = {variable.attrs.get("bounds") for variable in opened.variables.values()}
    for name, variable in opened.variables.items():
        if name in bounds:  # after CF they have unit and name of what they bound, and nothing is missing
            assert (variable.attrs, variable.encoding.get("_FillValue")) == ({}, None)
            continue
        assert "long_name" in variable.attrs, name
        assert variable.dtype.kind != "f" or "units" in variable.attrs, name


def test_values_are_exact(opened):
    np.testing.assert_array_equal(opened.runout, np.stack([record.values["runout"] for record in RECORDS]))
    for name in ("runout", "final_runout", "final_runout_mass"):
        np.testing.assert_array_equal(opened[f"deterministic_{name}"], make_record(BASELINE).values[name])


def test_influence_is_a_share_of_the_realizations_that_did_not_fail(opened):
    kept = [record.values["displaced"] for record in RECORDS if record.status is not Status.crashed]
    np.testing.assert_array_equal(opened.influence_probability, np.mean(kept, axis=0))


def test_status_flags_follow_cf(opened):
    meanings = opened.status.attrs["flag_meanings"].split()
    assert [meanings[flag] for flag in opened.status.values[:3]] == ["slid", "no_slide", "crashed"]
    assert opened.status.attrs["flag_values"].dtype == opened.status.dtype
    assert opened.reason.values[2] == "no mass"


def test_masks_choose_what_statistics_count(opened):
    """Whoever asks `status == 0` loses the slides that are lower bounds."""
    assert opened.usable.dtype == opened.slid.dtype == bool
    usable = opened.where(opened.usable, drop=True)
    assert usable.sizes["realization"] == opened.n[-1] == 69
    assert [k for k, status in enumerate(STATUSES) if status in FAILED] == np.flatnonzero(~opened.usable).tolist()
    slides = opened.sel(realization=opened.slid)
    assert slides.sizes["realization"] == opened.n_slides[-1] == 68
    assert float(slides.final_runout_mass.mean()) == pytest.approx(float(opened.runout_mean[-1]))
    beyond = (slides.final_runout_mass > 10.0).sum()
    assert float(beyond / 69) == opened.exceedance[-1]
    assert float(beyond / 68) == opened.exceedance_given_sliding[-1]


def test_no_name_hides_a_method(opened):
    assert not [name for name in opened.variables if hasattr(xr.Dataset, str(name))]


def test_the_other_release_and_the_total_are_there(opened):
    assert float(opened.other_release_final_runout_mass) == 11.0
    assert opened.runout_mean_total_ci.dims == ("bound",)
    assert float(opened.runout_mean_total) == pytest.approx(float(opened.runout_mean[-1]))
    assert float(opened.runout_mean_total_ci[0]) < float(opened.runout_mean_ci[-1, 0])


def test_checkpoints_are_labelled_by_realizations(opened):
    np.testing.assert_array_equal(opened.checkpoint, [20, 45, 70])
    assert (opened.n.sel(checkpoint=45), opened.n_slides.sel(checkpoint=45)) == (44, 43)


def test_the_discretisation_error_comes_with_its_pairs(opened):
    error = opened.discretisation_error
    assert (float(error), error.attrs["units"], error.attrs["half_cell"], error.attrs["pairs"]) == (1.0, "m", 0.5, 2)
    np.testing.assert_array_equal(opened.paired_difference, [-0.5, np.nan, -1.5])
    assert (opened.paired_difference.attrs["repeated"], opened.paired_difference.attrs["standing"]) == (3, 1)
    assert float(opened.discretisation_change) == -1.0
    assert opened.discretisation_change_ci.dims == ("bound",)


def test_attributes(opened):
    assert opened.attrs["Conventions"] == "CF-1.11"
    assert (opened.attrs["n_particles"], opened.attrs["toe_x"]) == (SIZES["particle"], 35.0)
    assert opened.attrs["scene"] == "title = 'é'\n"


def test_storage_is_chunked_compressed_and_extensible(path):
    with netCDF4.Dataset(path) as file:
        assert file.dimensions["realization"].isunlimited()
        assert file["runout"].chunking() == [64, SIZES["time"]]
        assert file["runout"].filters()["zlib"]
        assert file["runout"].filters()["shuffle"]


def test_a_write_that_fails_keeps_the_old_file(path, monkeypatch):
    before = path.read_bytes()

    def fail(*_arguments, **_keywords):
        raise OSError("No space left on device")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", fail)
    with pytest.raises(OSError, match="No space"):
        dataset.write(xr.Dataset(), path)
    assert path.read_bytes() == before
    assert list(path.parent.iterdir()) == [path]


def test_receptors_are_found_by_their_names_and_have_their_ends(opened):
    street = opened.sel(receptor="Straße")
    kept = np.array([record.values["front_reaches"][1] for record in RECORDS])
    np.testing.assert_array_equal(street.front_reaches, kept)
    assert float(street.receptor_x) == 46.0
    assert opened.receptor_x.attrs["bounds"] == "receptor_x_bounds"
    np.testing.assert_array_equal(street.receptor_x_bounds, [45.0, 47.0])
    assert opened.receptor_depth.dims == ("realization", "receptor", "time")


def test_the_initial_surface_lies_over_the_deposits_place(opened):
    assert opened.initial_surface.dims == ("x",)
    assert opened.initial_surface.attrs["units"] == "m"
    assert opened.deposit_surface.dims[1:] == opened.initial_surface.dims
