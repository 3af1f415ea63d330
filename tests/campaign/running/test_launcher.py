"""A launcher of another MPI is noticed."""

import pytest

from campaign.errors import RefusalError
from campaign.running.launcher import mismatch, refuse_several


@pytest.mark.parametrize(
    ("size", "environment", "refused"),
    [
        (1, {}, False),
        (4, {"PMI_SIZE": "4"}, False),
        (1, {"PMI_SIZE": "1", "SLURM_STEP_NUM_TASKS": "2"}, False),
        (1, {"SLURM_NTASKS": "4"}, False),
        (1, {"PMI_SIZE": "2"}, True),
        (1, {"SLURM_STEP_NUM_TASKS": "4"}, True),
    ],
)
def test_a_lone_rank_of_many_is_noticed(size, environment, refused):
    """Under hydra in a batch job SLURM_STEP_NUM_TASKS counts nodes: the launcher's own count comes first."""
    assert bool(mismatch(size, environment)) is refused


@pytest.mark.parametrize(("number", "words"), [("0", "start it without mpirun or srun"), ("1", "^$")])
def test_what_is_not_shared_is_refused_by_all_and_told_by_one(number, words):
    with pytest.raises(RefusalError, match=words):
        refuse_several("report", {"PMI_SIZE": "2", "PMI_RANK": number})


@pytest.mark.parametrize("environment", [{}, {"PMI_SIZE": "1"}, {"SLURM_NTASKS": "8"}])
def test_one_process_carries_out_any_command(environment):
    refuse_several("report", environment)
