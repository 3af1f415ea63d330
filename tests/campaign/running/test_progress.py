"""Progress and status say what the report says, and count what it counts."""

import numpy as np
import pytest
from tallies import filled, summary_of

from campaign.record import Status
from campaign.running.beyond_sampling import repeated_words
from campaign.running.progress import Progress, state_line
from campaign.running.workload import seconds_beyond_sampling
from campaign.scene import load_scene
from campaign.seeds import BASELINE


def test_the_probability_of_a_slide_comes_before_the_run_out():
    tally = filled([BASELINE, *range(12)])
    line = state_line(tally)
    assert line.startswith("12/200 done, 0 failed | 12 of 12 slid, P(slide) at least 74 % | run-out 10.12 +- 0.19 m")


def test_a_few_realizations_have_no_probability():
    assert "1 of 1 slid |" in f"{state_line(filled([BASELINE, 0]))} |"


def test_without_a_slide_there_is_a_probability_all_the_same():
    tally = filled([BASELINE])
    for k in range(11):
        tally.add(summary_of(k, 0.3, Status.no_slide))
    assert state_line(tally) == "11/200 done, 0 failed | 0 of 11 slid, P(slide) at most 28 %"
    assert "about 40 needed" in Progress(tally).line(tally)


def test_more_than_may_run_is_not_forecast_as_if_it_would():
    tally = filled([BASELINE], maximum=30)
    for k in range(11):
        tally.add(summary_of(k, 0.3, Status.no_slide))
    assert " | ends at 30, not converged: about 40 would be needed" in Progress(tally).line(tally)


@pytest.mark.parametrize("beyond", [0, 5])
def test_after_the_end_only_what_is_in_the_result_is_counted(beyond):
    """The rule stops at 70; what other ranks had begun by then is finished, and may fail."""
    tally = filled([BASELINE, *range(70 + beyond)], failing=range(70, 75))
    assert tally.size == 70
    more = f" (and {beyond} beyond the end)" if beyond else ""
    assert state_line(tally).startswith(f"70 realizations{more}, 0 failed | 70 of 70 slid")
    assert np.isclose(tally.latest().mean.estimate, tally.history().mean[-1])


def test_the_time_left_is_that_of_all_runs(monkeypatch):
    """12 of at most 200 in 6 s, so 94 s for the others; what follows is said to take 60 s."""
    times = iter([0.0, 6.0])
    monkeypatch.setattr("campaign.running.progress.time.monotonic", lambda: next(times))
    progress = Progress(filled([]), lambda _tally, rate: 30.0 * rate)
    line = progress.line(filled([BASELINE, *range(12)]))
    assert line.endswith("| at most 3 min left, 60 s of it for mesh, release and inputs")


def test_runs_beside_a_campaign_are_counted_and_estimate_nothing(monkeypatch):
    """Four slides of nine realizations are computed again; the account holds the other five as they were."""
    times = iter([0.0, 6.0])
    monkeypatch.setattr("campaign.running.progress.time.monotonic", lambda: next(times))
    tally = filled([BASELINE, 0, 2, 3, 4, 7], maximum=9)
    progress = Progress(tally, is_beside=True)
    for k in (1, 5, 6):
        tally.add(summary_of(k, 9.0, Status.slid))
    assert progress.line(tally) == "[0:00:06] 3 of 4 done, 2 s left"


@pytest.mark.parametrize(
    ("ranks", "seconds"),
    [(1, 8 * 9 + 1 + 8 * 4), (2, 8 * 5 + 1 + 8 * 2), (16, 8 + 1 + 8)],
)
def test_what_follows_is_counted_in_rounds_of_all_ranks(ranks, seconds):
    """A realization takes 1 s. Half the cell: 8 realizations and the deterministic one, 8 s each. 8 inputs, 4 each."""
    tally = filled([BASELINE, *range(30)])
    assert seconds_beyond_sampling(load_scene("ma2023"), ranks, tally, float(ranks)) == seconds


def test_what_follows_a_slope_that_seldom_slides_is_what_its_slides_take():
    """2 of 20 slid: 2 at half the cell, 1 with the other release with mean strengths, 2 with each of 8 inputs."""
    tally = filled([])
    for k in (BASELINE, *range(20)):
        tally.add(summary_of(k, 9.0, Status.slid if k in (9, 17) else Status.no_slide))
    assert seconds_beyond_sampling(load_scene("ma2023"), 1, tally, 1.0) == 2 * 8 + 1 + 2 * 8


def test_what_does_not_slide_is_not_repeated():
    """But for the deterministic run with the other release."""
    tally = filled([])
    for k in (BASELINE, *range(20)):
        tally.add(summary_of(k, 0.0, Status.no_slide))
    assert seconds_beyond_sampling(load_scene("ma2023"), 1, tally, 0.5) == 2.0


def test_what_did_not_slide_is_not_announced_to_be_repeated():
    assert repeated_words({BASELINE, *range(8)}) == "8 slides and the deterministic run"
    assert repeated_words({2}) == "1 slide"
    assert repeated_words({BASELINE}) == "the deterministic run"
