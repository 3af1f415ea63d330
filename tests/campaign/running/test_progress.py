"""Progress and status say what the report says, and count what it counts."""

import numpy as np
import pytest
from tallies import filled, summary_of

from campaign.record import Status
from campaign.running.progress import Progress, state_line
from campaign.seeds import BASELINE


def test_the_probability_of_a_slide_comes_before_the_run_out():
    tally = filled([BASELINE, *range(12)])
    line = state_line(tally)
    assert line.startswith("12/200 done, 0 failed | 12 of 12 slid, P(slide) at least 74 % | run-out 10.12 +- 0.19 m")


def test_without_a_slide_there_is_a_probability_all_the_same():
    tally = filled([BASELINE])
    for k in range(11):
        tally.add(summary_of(k, 0.3, Status.no_slide))
    assert state_line(tally) == "11/200 done, 0 failed | 0 of 11 slid, P(slide) at most 28 %"
    assert "about 40 needed" in Progress(tally).line(tally)


@pytest.mark.parametrize("beyond", [0, 5])
def test_after_the_end_only_what_is_in_the_result_is_counted(beyond):
    """The rule stops at 70; what other ranks had begun by then is finished, and may fail."""
    tally = filled([BASELINE, *range(70 + beyond)], failing=range(70, 75))
    assert tally.size == 70
    more = f" (and {beyond} beyond the end)" if beyond else ""
    assert state_line(tally).startswith(f"70 realizations{more}, 0 failed | 70 of 70 slid")
    assert np.isclose(tally.latest().mean.estimate, tally.history().mean[-1])
