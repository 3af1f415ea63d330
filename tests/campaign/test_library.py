"""What README shows of the library works, and leaves the process as it was."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

import campaign

README = Path(__file__).parents[2] / "README.md"

STATE = """
import os, signal, sys, threading
import numba
def state():
    handlers = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1)]
    environment = {key: value for key, value in os.environ.items() if key != "HDF5_PLUGIN_PATH"}  # netCDF4 sets it
    return handlers, sys.excepthook, threading.excepthook, environment, numba.config.CACHE_DIR
before = state()
"""


def lines_of(name):
    """Return the code block behind the marker <!-- test: NAME --> in README."""
    behind = README.read_text().partition(f"<!-- test: {name} -->")[2]
    return behind.split("```python\n", 1)[1].split("```", 1)[0]


def run_program(text, directory):
    command = [sys.executable, "-W", "error", "-c", text]
    return subprocess.run(command, cwd=directory, capture_output=True, text=True, timeout=300, check=False)


@pytest.fixture(scope="module")
def notebook(tmp_path_factory):
    directory = tmp_path_factory.mktemp("notebook")
    program = f"import matplotlib\nmatplotlib.use('agg')\n{STATE}{lines_of('notebook')}\nprint(state() == before)"
    return directory, run_program(program, directory)


def test_the_lines_of_readme_run(notebook):
    directory, result = notebook
    assert result.returncode == 0, result.stderr
    assert len(re.findall(r"^slid [\d.]+$", result.stdout, re.MULTILINE)) == 1
    with xr.open_dataset(directory / "stronger" / "results.nc", decode_timedelta=False) as data:
        assert data.sizes["realization"] == 10


def test_the_lines_that_analyse_results_run(notebook):
    directory, _ = notebook
    lines = lines_of("analysis").replace("campaign-ma2023", "stronger")
    result = run_program(f"import matplotlib\nmatplotlib.use('agg')\n{lines}", directory)
    assert result.returncode == 0, result.stderr
    with xr.open_dataset(directory / "stronger" / "results.nc") as data:
        beyond = (data.final_runout_mass[data.slid] > 12).sum() / data.usable.sum()
    assert f"{float(beyond):.0%} of all realizations run farther than 12 m" in result.stdout


def test_they_leave_the_process_as_it_was(notebook):
    assert notebook[1].stdout.splitlines()[-1] == "True"


def test_every_name_is_there():
    assert all(getattr(campaign, name) is not None for name in campaign.__all__)
    assert set(campaign.__all__) <= set(dir(campaign))
    with pytest.raises(AttributeError, match="no attribute 'runn'"):
        campaign.runn  # noqa: B018


def test_the_import_loads_nothing_heavy(tmp_path):
    heavy = ("numpy", "numba", "xarray", "pydantic", "mpi4py", "matplotlib")
    result = run_program(f"import sys, campaign; print([m for m in {heavy} if m in sys.modules])", tmp_path)
    assert result.stdout.strip() == "[]"
