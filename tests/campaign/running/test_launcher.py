"""A launcher of another MPI is noticed."""

import pytest

from campaign.running.launcher import mismatch


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
