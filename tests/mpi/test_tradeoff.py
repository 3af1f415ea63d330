"""A study of settings runs the same realizations, however many ranks share them and however often it is stopped."""

import signal
import time

import numpy as np
import pytest
import xarray as xr
from stand_in_campaign import NEEDS_MPIRUN, PATIENCE, campaign, start

pytestmark = NEEDS_MPIRUN


def runouts(directory):
    with xr.open_dataset(directory / "tradeoff.nc") as data:
        return data["final_runout"].load()


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    directory = tmp_path_factory.mktemp("undisturbed")
    code, output = campaign(directory, 5, 1, tradeoff=1)
    assert code == 0, output
    return runouts(directory)


def assert_same(one, other):
    """What single settings gave; which of them are tried together depends on their times."""
    single = [name for name in other["setting"].values if name in one["setting"].values]
    assert len(single) > 10
    assert np.array_equal(one.sel(setting=single), other.sel(setting=single), equal_nan=True)


def test_a_study_that_is_stopped_goes_on_where_it_was(undisturbed, tmp_path):
    """Stopped by the signal that every launcher hands on, once the second variant is under way."""
    process = start(tmp_path, 5, 3, tradeoff=1, seconds=0.3)
    while len([*(tmp_path / "variants").glob("*/records/*.h5")]) < 6:
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGUSR1)
    output, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 75, output
    assert "Give the same command again to continue." in output
    kept = {path: path.stat().st_mtime_ns for path in (tmp_path / "variants").glob("*/records/*.h5")}
    code, output = campaign(tmp_path, 5, 1, tradeoff=1)
    assert code == 0, output
    assert_same(runouts(tmp_path), undisturbed)
    assert all(path.stat().st_mtime_ns == when for path, when in kept.items() if path.exists())
