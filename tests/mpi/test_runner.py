"""The dataset does not know how many ranks computed it, nor how often they were killed.

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
    NEEDS_MPIRUN,
    PATIENCE,
    STAND_IN,
    assert_same,
    campaign,
    code_after,
    dataset,
    dataset_of,
    lets_ranks_end,
    records_in,
    start,
    wait_for_attempts,
    wait_for_more_records,
    wait_for_records,
    wait_for_the_end,
)

from campaign.exit_codes import ExitCode
from campaign.running.standing import conclusion, status

pytestmark = NEEDS_MPIRUN


@pytest.mark.parametrize("ranks", [pytest.param(2, marks=pytest.mark.slow), 3])
def test_the_number_of_ranks_leaves_no_trace(alone, tmp_path, ranks):
    assert_same(dataset_of(tmp_path / "out", ranks=ranks, seconds=0.01), alone)


def test_without_mpi_threads_rank_0_answers_between_its_steps(alone, tmp_path, monkeypatch):
    monkeypatch.setenv("MPI4PY_RC_THREAD_LEVEL", "funneled")
    assert_same(dataset_of(tmp_path / "out", ranks=3, seconds=0.01), alone)


def test_a_kill_in_the_middle_leaves_no_trace(alone, tmp_path):
    directory = tmp_path / "out"
    process = start(directory, ranks=2, seconds=0.1)
    wait_for_records(directory, 8)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    wait_for_the_end(directory)
    assert not (directory / "results.nc").exists()
    assert "killed; give the same command again" in status(directory)
    code, output = campaign(directory, ranks=3)
    assert code == 0, output
    assert "stopped at the maximum of 24 realizations" in status(directory)
    assert_same(dataset(directory), alone)


def test_convergence_stops_every_number_of_ranks_at_the_same_realization(tmp_path):
    loose = (
        "campaign.minimum=20",
        "campaign.block=10",
        "campaign.variance_tolerance=0.6",
        "campaign.mean_tolerance=0.05",
    )
    sets = []
    for ranks in (1, 3):
        directory = tmp_path / str(ranks)
        code, output = campaign(directory, 300, ranks, loose, seconds=0.002)
        assert code == 0, output
        assert "converged at" in output
        sets.append(dataset(directory))
    assert sets[0].sizes["realization"] < 300
    assert_same(*sets)


def test_more_realizations_extend_a_campaign(alone, tmp_path):
    assert campaign(tmp_path / "out", 10)[0] == 0
    assert_same(dataset_of(tmp_path / "out"), alone)


def test_too_many_failures_have_their_own_exit_code(tmp_path):
    code, output = campaign(tmp_path / "out", 4, 1, **{"raise": 2})
    assert code == 3
    assert "1 of 4 realizations failed" in output
    assert dataset(tmp_path / "out").sizes["realization"] == 4


def test_an_exception_in_the_runner_ends_all_ranks_at_once(tmp_path):
    process = start(tmp_path / "out", raise_in_prepare=1)
    assert any("the runner itself is broken" in line for line in process.stdout)
    begin = time.monotonic()
    process.communicate(timeout=PATIENCE)
    assert process.returncode == 70
    assert time.monotonic() - begin < 15


def test_each_signal_ends_a_campaign_so_that_it_can_go_on(alone, tmp_path):
    directory = tmp_path / "out"
    for number in (signal.SIGUSR1, signal.SIGTERM, signal.SIGINT):
        process = start(directory, ranks=2, seconds=0.5)
        wait_for_more_records(directory, 3)
        os.kill(process.pid, number)
        output, _ = process.communicate(timeout=PATIENCE)
        assert process.returncode == code_after(number), output
        assert conclusion(directory) is ExitCode.RESUMABLE
        if lets_ranks_end(number):
            assert "same command again" in output
            assert dataset(directory).sizes["realization"] < COUNT
        wait_for_the_end(directory)
    assert_same(dataset_of(directory), alone)


def test_a_realization_that_takes_the_process_down_twice_is_skipped(tmp_path):
    directory = tmp_path / "out"
    for _ in range(2):
        assert campaign(directory, crash=3)[0] != 0
    code, output = campaign(directory, ranks=1, crash=3)
    assert code == 0, output
    assert "Realization 3 is recorded as crashed" in output
    assert "Segmentation fault" in str(dataset(directory).reason[3].values)


def test_a_kill_from_outside_is_not_held_against_a_realization(alone, tmp_path):
    directory = tmp_path / "out"
    for _ in range(2):
        process = start(directory, ranks=2, seconds=2)
        wait_for_attempts(directory)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
    assert_same(dataset_of(directory), alone)


def test_a_full_disk_ends_in_a_sentence_and_costs_nothing_finished(alone, tmp_path, monkeypatch):
    """And nothing is begun that the job has no time for: of 25 s the last 20 are kept free, and 6 s are left to do."""
    directory = tmp_path / "out"
    code, output = campaign(directory, full_disk=12)
    assert code == 75
    assert "cannot be kept" in output or "cannot be written" in output
    assert "Traceback" not in output
    assert records_in(directory) < 14
    monkeypatch.setenv("SLURM_JOB_END_TIME", str(time.time() + 25))
    code, output = campaign(directory, seconds=1)
    assert code == 75, output
    assert "the job's time is nearly over" in output
    monkeypatch.delenv("SLURM_JOB_END_TIME")
    assert_same(dataset_of(directory), alone)


def test_an_unwritable_directory_is_refused(tmp_path):
    (tmp_path / "file").write_text("in the way")
    code, output = campaign(tmp_path / "file" / "out", ranks=1)
    assert code == 2
    assert "cannot be written" in output
    assert "Traceback" not in output


def test_a_directory_of_another_scene_is_refused_with_the_keys_that_differ(tmp_path):
    assert campaign(tmp_path / "out", 4, 1)[0] == 0
    before = (tmp_path / "out" / "results.nc").read_bytes()
    code, output = campaign(tmp_path / "out", 4, 1, ["numerics.cell=0.5 m", "campaign.seed=9"])
    assert code == 2
    assert re.search(r"campaign.seed is 9 here but 2023 .*numerics.cell is 0.5 m here but 1 m", output)
    assert (tmp_path / "out" / "results.nc").read_bytes() == before
    assert not (tmp_path / "out" / "lock").exists()


PAIRS = "campaign.discretisation_pairs=6"


def in_one_line(text):
    return " ".join(text.split())


@pytest.fixture(scope="module")
def paired(tmp_path_factory):
    return dataset_of(tmp_path_factory.mktemp("paired") / "out", 20, 1, [PAIRS])


def test_half_the_cell_tells_the_discretisation_error(paired):
    """The stand-in's run-outs fall by 2 (1 + k / 10) for each metre of cell, which is 1 m: 1 + k / 10 at half of it."""
    np.testing.assert_allclose(paired.paired_difference, [1.0, 1.1, 1.2, 1.3, 1.4, 1.5])
    assert float(paired.discretisation_error) == pytest.approx(1.25)
    assert float(paired.deterministic_paired_difference) == pytest.approx(0.9)


def test_the_other_release_tells_what_the_protocol_changes(paired):
    """The stand-in runs 0.6 m farther when gravity is raised while the ground yields."""
    change = float(paired.other_release_final_runout_mass - paired.deterministic_final_runout_mass)
    assert change == pytest.approx(0.6)


def test_a_kill_in_the_other_release_leaves_no_trace(paired, tmp_path):
    directory = tmp_path / "out"
    process = start(directory, 20, 2, [PAIRS], seconds_beside=5)
    wait_for_attempts(directory / "other-release")
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate(timeout=PATIENCE)
    wait_for_the_end(directory)
    assert not list(directory.glob("other-release/records/*.h5"))
    code, output = campaign(directory, 20, 3, [PAIRS], seconds=0.01)
    assert code == 0, output
    assert "Release protocol: the deterministic run again" in output
    assert "changed by cells of 0.5 m: +1.25 m (+1.05 to +1.45 m), n = 6" in in_one_line(output)
    assert_same(dataset(directory), paired)
    assert "Release protocol:" not in campaign(directory, 20, 1, [PAIRS])[1]


def test_a_stable_slope_ends_early_on_every_number_of_ranks(tmp_path):
    sets = []
    for ranks in (1, 3):
        directory = tmp_path / str(ranks)
        code, output = campaign(directory, 300, ranks, [PAIRS], stable=1, seconds=0.002)
        assert code == 0, output
        assert "It does not slide: 0 of 50 realizations slid" in output
        assert "50 realizations" in status(directory)
        sets.append(dataset(directory))
    assert sets[0].sizes["realization"] == 50
    assert_same(*sets)


@pytest.mark.parametrize("number", [pytest.param(signal.SIGKILL, marks=pytest.mark.slow), signal.SIGTERM])
def test_an_end_among_the_repeated_leaves_no_trace(paired, tmp_path, number):
    directory = tmp_path / "out"
    process = start(directory, 20, 2, [PAIRS], seconds_beside=1.5)
    wait_for_records(directory / "half-cell", 1)
    os.killpg(process.pid, number)
    output, _ = process.communicate(timeout=PATIENCE)
    if number == signal.SIGTERM and lets_ranks_end(number):
        assert process.returncode == 75, output
        assert "discretisation_error" not in dataset(directory)
    wait_for_the_end(directory)
    assert records_in(directory / "half-cell") < 6
    assert_same(dataset_of(directory, 20, 3, [PAIRS]), paired)


def test_the_slide_after_one_that_failed_is_repeated_in_its_place(tmp_path):
    code, output = campaign(tmp_path / "out", 20, 1, [PAIRS], **{"raise": 2})
    assert code == 0, output
    differences = dataset(tmp_path / "out").paired_difference
    np.testing.assert_allclose(differences, [1.0, 1.1, np.nan, 1.3, 1.4, 1.5, 1.6])
    assert re.search(r"changed by cells of 0.5 m: .*, n = 6 ", in_one_line(output))
    assert not (tmp_path / "out" / "half-cell" / "records" / "realization-000002.h5").exists()


MORE = "campaign.sensitivity_pairs=3"


@pytest.fixture(scope="module")
def with_more(tmp_path_factory):
    return dataset_of(tmp_path_factory.mktemp("with-more") / "out", 20, 1, [MORE])


def test_slides_are_repeated_with_more_of_one_input(with_more):
    """The stand-in runs 10 m farther for each unit of the softening rate, 0.189 m for 10 %; it has no other input."""
    effects = dict(zip(with_more.input.values, with_more.input_effect.values, strict=True))
    assert effects.pop("soil.softening.rate") == pytest.approx(0.189)
    assert len(effects) == 7
    np.testing.assert_allclose(list(effects.values()), 0.0, atol=1e-12)
    np.testing.assert_array_equal(with_more.input_pair, [0, 1, 2])
    assert with_more.input_difference.dims == ("input", "input_pair")


@pytest.mark.parametrize("number", [signal.SIGKILL, pytest.param(signal.SIGTERM, marks=pytest.mark.slow)])
def test_an_end_among_the_changed_inputs_leaves_no_trace(with_more, tmp_path, number):
    directory = tmp_path / "out"
    process = start(directory, 20, 2, [MORE], seconds_beside=0.5)
    wait_for_records(directory / "changed-inputs" / "soil.cohesion.mean", 1)
    os.killpg(process.pid, number)
    output, _ = process.communicate(timeout=PATIENCE)
    if number == signal.SIGTERM and lets_ranks_end(number):
        assert process.returncode == 75, output
        assert "soil.unit_weight" not in dataset(directory).input
    wait_for_the_end(directory)
    code, output = campaign(directory, 20, 3, [MORE])
    assert code == 0, output
    assert "more softening rate" not in output
    assert "more unit weight, 22 kN/m^3" in output
    assert "24 repeated with more of one input" in status(directory)
    assert_same(dataset(directory), with_more)
    assert "more unit weight, 22" not in campaign(directory, 20, 1, [MORE])[1]


def test_inputs_that_cannot_be_more_are_left_out(tmp_path):
    code, output = campaign(tmp_path / "out", 20, 1, [MORE, "soil.cohesion.cov=0.02", "soil.cohesion.residual=19 kPa"])
    assert code == 0, output
    assert "What more mean residual cohesion changes cannot be estimated." in output
    assert "soil.cohesion.residual" not in dataset(tmp_path / "out").input


def test_a_slope_that_stands_has_no_slides_to_repeat(tmp_path):
    code, output = campaign(tmp_path / "out", 60, 1, [MORE], stable=1)
    assert code == 0, output
    assert "Inputs:" not in output
    assert "input_effect" not in dataset(tmp_path / "out")


@pytest.mark.parametrize("variable", ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"])
def test_a_launcher_of_another_mpi_is_found_out(tmp_path, variable):
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMI_", "SLURM_"))
    }
    program = f"import os; from mpi4py import MPI; os.environ[{variable!r}] = '4'; import runpy, sys; "
    program += (
        f"sys.argv = ['x', {str(tmp_path / 'out')!r}, '4']; runpy.run_path({str(STAND_IN)!r}, run_name='__main__')"
    )
    result = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert result.returncode == 2, result.stderr
    assert f"started 4 processes ({variable})" in result.stderr
    assert not (tmp_path / "out").exists()
