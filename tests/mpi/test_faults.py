"""A fault of the machine costs no realization its place in the data, and nothing hangs.

Campaigns run under the environment's own mpirun, with a stand-in for the solver (`helpers/stand_in.py`).
"""

import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from stand_in_campaign import (
    COUNT,
    MPIRUN,
    NEEDS_MPIRUN,
    PATIENCE,
    assert_same,
    campaign,
    code_after,
    dataset,
    dataset_of,
    lets_ranks_end,
    records_in,
    start,
    wait_for,
    wait_for_records,
)

from campaign.exit_codes import ExitCode
from campaign.running.standing import conclusion, status

pytestmark = NEEDS_MPIRUN


def test_a_sick_rank_takes_no_more_work_and_leaves_no_trace(alone, tmp_path):
    code, output = campaign(tmp_path / "out", ranks=3, sick=1)
    assert code == 0, output
    assert "No more work for rank 1 on" in output
    assert "it fails before its first realization: OSError: [Errno 28] No space left" in output
    assert_same(dataset(tmp_path / "out"), alone)


@pytest.mark.parametrize("ranks", [pytest.param(1, marks=pytest.mark.slow), 2])
def test_what_the_machine_lacks_is_no_status(alone, tmp_path, ranks):
    """What one realization lacks lets it be handed out last again; then the campaign ends so that it can go on.

    Where nothing works, nothing is recorded.
    """
    code, output = campaign(tmp_path / "out", ranks=1, sick=0)
    assert code == 75, output
    assert not list(tmp_path.glob("out/records/*.h5"))
    code, output = campaign(tmp_path / "out", ranks=ranks, memory=3)
    assert code == 75, output
    assert "realization 3 ended in MemoryError: 64 GiB are wanted" in output
    assert "Traceback" not in output
    assert records_in(tmp_path / "out") == COUNT - 1
    assert_same(dataset_of(tmp_path / "out"), alone)


def test_a_ground_that_cannot_be_prepared_for_want_of_memory_can_be_later(tmp_path):
    code, output = campaign(tmp_path / "out", 4, ranks=2, no_memory_to_prepare=1)
    assert code == 75, output
    assert "the ground could not be prepared: MemoryError: 64 GiB are wanted" in output
    assert "Traceback" not in output
    assert conclusion(tmp_path / "out") is ExitCode.RESUMABLE


def test_an_exception_in_a_realization_is_a_status_and_is_run_again_when_asked_for(alone, tmp_path):
    directory = tmp_path / "out"
    code, output = campaign(directory, **{"raise": 7})
    assert code == 0, output
    result = dataset(directory)
    meanings = result.status.attrs["flag_meanings"].split()
    assert meanings[int(result.status[7])] == "crashed"
    assert "a particle has no mass" in str(result.reason[7].values)
    assert int(np.isfinite(result.final_runout).sum()) == COUNT - 1
    assert np.isnan(dataset_of(directory).final_runout[7])
    assert_same(dataset_of(directory, retry="crashed timeout"), alone)


def test_what_takes_too_long_is_a_status_even_if_it_is_the_baseline_and_runs_again_with_a_raised_timeout(tmp_path):
    directory = tmp_path / "out"
    code, output = campaign(directory, 4, overrides=["campaign.realization_timeout=0.05 s"], seconds=0.3)
    assert code == 3, output
    assert "No answer: 4 realizations, and none with a result." in output
    assert "probability of a slide: no realization with a result" in output
    result = dataset(directory)
    assert (result.status == result.deterministic_status).all()
    assert "realization_timeout" in str(result.reason[0].values)
    assert campaign(directory, 4, 1, ["campaign.realization_timeout=0.04 s"])[0] == 3
    assert_same(dataset_of(directory, 4), dataset_of(tmp_path / "alone", 4, 1))


@pytest.mark.parametrize("ranks", [pytest.param(1, marks=pytest.mark.slow), 2])
def test_a_realization_that_hangs_is_ended_and_skipped_after_the_second_time(tmp_path, ranks):
    """Also where rank 0 itself hangs, and is ended by its own thread or, if that is kept from running, by a timer."""
    directory, short = tmp_path / "out", ["campaign.realization_timeout=0.5 s"]
    code, output = campaign(directory, 12, ranks, short, hang=3, grace=3)
    assert code == 75, output
    assert re.search(r"Rank \d does not come back from realization 3, begun \d+ s ago", output), output
    assert "Traceback" not in output
    code, output = campaign(directory, 12, 1, short, hang_alone=3, grace=2)
    assert code == 75, output
    assert conclusion(directory) is ExitCode.RESUMABLE
    code, output = campaign(directory, 12, 1, short, hang_alone=3, grace=2)
    assert code == 0, output
    assert "Realization 3 is recorded as crashed: it took the process down 2 times: Timeout" in output


def test_a_rank_that_hangs_or_vanishes_leaves_no_trace(alone, tmp_path):
    """Before its first realization, which is tried out with the baseline, or whatever code the launcher ends with.

    Under MPICH that is 0 when a rank vanishes.
    """
    directory = tmp_path / "out"
    short, long = (["campaign.realization_timeout=" + limit] for limit in ("0.5 s", "1 h"))
    code, output = campaign(directory, overrides=short, hang_alone=-1, grace=2)
    assert code == 75, output
    assert re.search(r"Timeout.*in misbehave", output, re.DOTALL), output
    campaign(directory, overrides=long, seconds=0.02, vanish=9)
    assert conclusion(directory) is ExitCode.RESUMABLE
    assert_same(dataset_of(directory, overrides=long), alone)
    assert conclusion(directory) is ExitCode.DONE


@pytest.mark.parametrize("number", [signal.SIGUSR1, signal.SIGTERM])
def test_a_signal_ends_the_preparation_at_once(tmp_path, number):
    directory = tmp_path / "out"
    process = start(directory, 4, 2, prepare_seconds=100)
    wait_for(lambda: (directory / ".preparing").exists(), "nothing is begun")
    begin = time.monotonic()
    os.kill(process.pid, number)
    output, _ = process.communicate(timeout=PATIENCE)
    assert time.monotonic() - begin < 40
    assert process.returncode == code_after(number), output
    if lets_ranks_end(number):
        assert "before its first realization" in output
        assert "stopped early (asked to stop)" in status(directory)
    assert conclusion(directory) is ExitCode.RESUMABLE


def test_a_directory_that_is_moved_away_can_go_on_where_it_is(alone, tmp_path):
    process = start(tmp_path / "out", ranks=2, seconds=0.2)
    wait_for_records(tmp_path / "out", 4)
    (tmp_path / "out").rename(tmp_path / "moved")
    output, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 75, output
    assert "was moved away" in output
    assert "Traceback" not in output
    assert not (tmp_path / "out").exists()
    assert_same(dataset_of(tmp_path / "moved"), alone)


BREAKING = """
import os, sys
class Broken:
    def find_spec(self, name, path, target=None):
        rank = os.environ.get("PMI_RANK", os.environ.get("OMPI_COMM_WORLD_RANK"))
        if name == {module!r} and rank == "1":
            raise {error}
sys.meta_path.insert(0, Broken())
"""


@pytest.mark.parametrize(
    ("module", "error"),
    [
        ("numpy", "ImportError('a file is missing')"),
        ("campaign.running.runner", "SystemExit(0)"),
        ("campaign.running.mpi", "KeyboardInterrupt"),
    ],
)
def test_an_import_that_fails_on_one_rank_ends_all(tmp_path, module, error):
    (tmp_path / "sitecustomize.py").write_text(BREAKING.format(module=module, error=error))
    path = os.pathsep.join(filter(None, [str(tmp_path), os.environ.get("PYTHONPATH")]))
    command = [MPIRUN, "-n", "2", sys.executable, "-m", "campaign", "run", "ma2023", "--out", str(tmp_path / "out")]
    result = subprocess.run(
        command, env=os.environ | {"PYTHONPATH": path}, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert result.returncode == 70
    assert not list(tmp_path.glob("out/records/*.h5"))
