"""Campaigns of the stand-in (`stand_in.py`) under the environment's own mpirun."""

import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import fields
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from campaign.record import Quantity
from campaign.simulation.quantities import QUANTITIES
from campaign.storage.lock import DirectoryLock
from campaign.storage.provenance import source_hashes

MPIRUN = Path(sys.prefix) / "bin" / "mpirun"
NEEDS_MPIRUN = pytest.mark.skipif(not MPIRUN.exists(), reason="needs the mpich extra")
COUNT = 24
"""Realizations of a campaign of which nothing else is asked."""

PATIENCE = 120.0
"""Seconds after which what is awaited does not come, however busy the machine is."""

STAND_IN = Path(__file__).parent / "stand_in.py"


@cache
def is_open_mpi():
    version = subprocess.run([MPIRUN, "--version"], capture_output=True, text=True, check=True).stdout
    return "Open MPI" in version


def lets_ranks_end(number):
    """Whether mpirun hands a signal on and waits for its ranks.

    Open MPI's ends them within two seconds of TERM and INT, whatever they do, and its own exit code is 1.
    """
    return number == signal.SIGUSR1 or not is_open_mpi()


def code_after(number):
    """The exit code of mpirun when ranks were asked to stop by this signal."""
    return 75 if lets_ranks_end(number) else 1


@cache
def kept_file():
    """A file with the table of quantities, without the functions that compute them, and the hashes of the sources."""
    table = {
        name: Quantity(*(getattr(row, field.name) for field in fields(Quantity))) for name, row in QUANTITIES.items()
    }
    path = Path(tempfile.mkdtemp()) / "kept"
    path.write_bytes(pickle.dumps((table, source_hashes())))
    return path


def start(directory, realizations=COUNT, ranks=2, overrides=(), **faults):
    settings = {"kept": kept_file()} | faults
    environment = os.environ | {f"STAND_IN_{name.upper()}": str(value) for name, value in settings.items()}
    command = [MPIRUN, "-n", str(ranks), sys.executable, STAND_IN, directory, str(realizations), *overrides]
    return subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )


def campaign(directory, realizations=COUNT, ranks=2, overrides=(), **faults):
    process = start(directory, realizations, ranks, overrides, **faults)
    output, _ = process.communicate(timeout=PATIENCE)
    return process.returncode, output


def dataset_of(directory, realizations=COUNT, ranks=1, overrides=(), **faults):
    """Return the dataset of a campaign that must come to its end."""
    code, output = campaign(directory, realizations, ranks, overrides, **faults)
    assert code == 0, output
    return dataset(directory)


def dataset(directory):
    with xr.open_dataset(directory / "results.nc") as data:
        return data.load()


def assert_same(one, other):
    """Bit for bit, but for what names itself after a clock, a rank or a host."""
    assert one.variables.keys() == other.variables.keys()
    for name in one.variables:
        if not any(word in name for word in ("wall", "rank", "host")):
            np.testing.assert_array_equal(one[name].values, other[name].values, err_msg=name, strict=True)


def wait_for(condition, otherwise):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, otherwise
        time.sleep(0.02)


def records_in(directory):
    return len(list(directory.glob("records/realization-*.h5")))


def wait_for_records(directory, count):
    wait_for(lambda: records_in(directory) >= count, "no records appear")


def wait_for_more_records(directory, count):
    """For a campaign that has just been started again."""
    wait_for_records(directory, records_in(directory) + count)


def wait_for_the_end(directory):
    """Ranks outlive a killed mpirun by a moment."""
    wait_for(lambda: not DirectoryLock(directory).is_held(), "rank 0 lives on")


def wait_for_attempts(directory):
    """Not those of an earlier start."""
    now = time.time()

    def is_begun(attempt):
        with suppress(FileNotFoundError):
            return attempt.stat().st_mtime > now and attempt.read_text()

    wait_for(lambda: any(map(is_begun, (directory / "attempts").glob("rank-*"))), "no realization is begun")
