"""A campaign with an accuracy as its aim runs the same models and says the same, however it is computed."""

import shutil

import pytest
from stand_in_campaign import NEEDS_MPIRUN, assert_same, campaign, dataset_of

pytestmark = NEEDS_MPIRUN

AIM = ("campaign.accuracy=20 %",)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    directory = tmp_path_factory.mktemp("undisturbed")
    return dataset_of(directory, 200, 1, AIM), directory


def test_the_dataset_says_what_was_run_and_what_came_of_it(undisturbed):
    data, directory = undisturbed
    assert data.attrs["verdict"].startswith("accuracy")
    counts = dict(zip(data["model"].values.tolist(), data["model_realizations"].values.tolist(), strict=True))
    assert counts["own"] == data.sizes["realization"]
    assert counts["half-cell"] == len([*(directory / "half-cell" / "records").glob("realization-*.h5")])
    lower, upper = data["multilevel_runout_mean_total_ci"].values
    assert lower < data["multilevel_runout_mean"] < upper


def test_ranks_do_not_change_it(undisturbed, tmp_path):
    assert_same(dataset_of(tmp_path, 200, 3, AIM), undisturbed[0])


@pytest.fixture
def copied(undisturbed, tmp_path):
    return shutil.copytree(undisturbed[1], tmp_path / "copied")


def test_what_is_lost_is_run_again_and_nothing_else_changes(copied, undisturbed):
    """Once the machine works: one that does not ends the campaign so that it can be continued."""
    lost = [copied / "half-cell/records/realization-000003.h5", copied / "records/realization-000030.h5"]
    for path in lost:
        path.unlink()
    code, output = campaign(copied, 200, 1, AIM, sick=0)
    assert code == 75, output
    assert_same(dataset_of(copied, 200, 2, AIM), undisturbed[0])
    assert all(path.exists() for path in lost)


def test_a_plain_campaign_continues_with_the_same_records(copied):
    kept = (copied / "records/realization-000007.h5").stat().st_mtime_ns
    code, output = campaign(copied, 60, 2)
    assert code == 0, output
    assert (copied / "records/realization-000007.h5").stat().st_mtime_ns == kept
