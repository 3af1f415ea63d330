"""A file system without locks holds a campaign as well as any."""

import os
import shutil
import subprocess
import sys

import pytest

NO_LOCKS = """
#include <errno.h>
int flock(int descriptor, int operation) { (void)descriptor; (void)operation; errno = ENOLCK; return -1; }
"""

WRITE = """
from pathlib import Path
from campaign import cli
cli.main(["scenes"])
import xarray as xr
from campaign.results import dataset
dataset.write(xr.Dataset({"a": ("realization", [1.0])}), Path("results.nc"))
assert xr.open_dataset("results.nc").a == 1.0
"""


@pytest.mark.skipif(shutil.which("cc") is None or sys.platform != "linux", reason="needs a C compiler and Linux")
def test_results_are_written_where_files_cannot_be_locked(tmp_path):
    (tmp_path / "no_locks.c").write_text(NO_LOCKS)
    subprocess.run(["cc", "-shared", "-fPIC", "-o", "no_locks.so", "no_locks.c"], cwd=tmp_path, check=True)
    environment = {name: value for name, value in os.environ.items() if name != "HDF5_USE_FILE_LOCKING"}
    environment["LD_PRELOAD"] = str(tmp_path / "no_locks.so")
    result = subprocess.run(
        [sys.executable, "-c", WRITE], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stderr
