"""What is left of a job's time."""

import math

import pytest

from campaign.running import walltime


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("45", 45), ("1:30", 90), ("2:00:01", 7201), ("1-00:00:10", 86410), ("UNLIMITED", math.inf), ("", math.inf)],
)
def test_slurms_times_are_read(text, seconds):
    """Formats of squeue's %L, from its manual."""
    assert walltime.remaining(text) == seconds
