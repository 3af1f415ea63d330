"""The account of a campaign does not depend on the order in which realizations finish."""

import time

import numpy as np
import pytest
from tallies import filled, prefixes_of, summary, summary_of

from campaign.record import FAILED, RealizationSummary, Status
from campaign.seeds import BASELINE
from campaign.statistics.convergence import convergence_history
from campaign.statistics.stopping import StoppingRule
from campaign.statistics.tally import Tally


@pytest.mark.parametrize("seed", range(5))
def test_the_result_does_not_depend_on_the_order_of_arrival(seed):
    straight = filled([BASELINE, *range(200)])
    shuffled = filled(np.random.default_rng(seed).permutation(np.arange(-1, 200)).tolist())
    assert straight.size == shuffled.size == 70
    assert straight.history().verdict == shuffled.history().verdict


def test_nothing_is_decided_before_the_baseline():
    assert filled(range(200)).size is None


def test_a_gap_ends_the_prefix():
    tally = filled([BASELINE, *range(15), *range(16, 90)])
    assert (tally.prefix, tally.done, tally.size) == (15, 89, None)
    tally.add(summary(15))
    assert tally.size == 70


def test_the_maximum_ends_a_campaign_without_convergence():
    tally = filled([BASELINE, *range(4)], maximum=4)
    assert tally.size == 4
    assert tally.history().converged_at is None


def test_ids_beyond_the_maximum_stay_out():
    assert filled([BASELINE, 7, *range(4)], maximum=4).done == 4


def test_too_many_failures_are_noticed_at_the_first_checkpoint():
    tally = filled([BASELINE, *range(60)], failing=range(5, 8))
    assert (tally.size, tally.too_many_failed) == (20, True)


def from_scratch(tally):
    """The history as the stopping rule defines it, from all realizations at once."""
    summaries = [tally.summaries[k] for k in range(tally.prefix)]
    return convergence_history(prefixes_of(summaries), tally.rule, tally.threshold)


def slides_with(share):
    """Probability of each status, a share of them slides and 8 % failures."""
    return [0.9 * share, 0.92 - share, 0.06 * share, 0.02, 0.02, 0.02, 0.02, 0.04 * share]


@pytest.mark.parametrize("seed", range(20))
def test_the_running_account_is_that_of_all_run_outs_at_once(seed):
    """Bit for bit, at every step, with failures, slopes that stay, gaps and any order of arrival."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 160))
    minimum, block = int(rng.integers(10, 60)), int(rng.integers(1, 9))
    rule = StoppingRule(rng.uniform(0.001, 0.2), rng.uniform(0.1, 2.0), 0.95, minimum, block, rng.uniform(0.05, 0.4))
    share = rng.choice([0.0, 0.05, 0.5, 0.85])
    statuses = rng.choice(list(Status), count + 1, p=slides_with(share))
    runouts = np.where(rng.random(count + 1) < 0.02, np.nan, rng.lognormal(2, 0.3, count + 1))
    tally = Tally(count, rule, rng.uniform(0.02, 0.3), "mass")
    for k in rng.permutation(np.arange(-1, count)).tolist():
        tally.add(summary_of(k, float(runouts[k]), Status(statuses[k]), float(rng.exponential())))
        if tally.prefix:
            for name, value in vars(from_scratch(tally)).items():
                np.testing.assert_array_equal(getattr(tally.history(), name), value, err_msg=name)
    ends = [tally.summaries[k].status for k in range(tally.prefix)]
    assert tally.failed_in_prefix == sum(status in FAILED for status in ends)
    assert tally.failed == sum(tally.summaries[k].status in FAILED for k in range(count))
    assert tally.longest == max(each.wall_time for each in tally.summaries.values())


def test_a_realization_counts_once():
    tally = filled([BASELINE, *range(5)])
    tally.add(summary(3, Status.crashed))
    assert (tally.done, tally.failed, tally.summaries[3].status) == (5, 0, Status.slid)


def seconds_taken(count):
    """Return the time to add realizations, and that to tell their history afterwards."""
    tally = Tally(count, StoppingRule(1e-6, 1e-6, 0.95, 100, 25, 0.1), 0.1, "mass")
    summaries = [summary_of(k, 10.0 + k % 7) for k in range(-1, count)]
    begin = time.process_time()
    for each in summaries:
        tally.add(each)
    added = time.process_time()
    tally.history()
    return added - begin, time.process_time() - added


def test_the_account_takes_ten_times_as_long_for_ten_times_as_many():
    """Its history looks at each of ten times as many samples once, which are ten times as large."""
    short, long = (np.min([seconds_taken(count) for _ in range(3)], axis=0) for count in (1000, 10_000))
    assert long[0] < 15 * short[0]
    assert long[1] < 100 * short[1]


@pytest.mark.parametrize(("front", "mean"), [("mass", 9.0), ("tip", 12.0)])
def test_the_account_is_of_the_front_that_was_chosen(front, mean):
    tally = Tally(30, StoppingRule(0.1, 0.5, 0.95, 20, 10, 0.1), 0.1, front)
    for k in range(BASELINE, 30):
        tally.add(RealizationSummary(k, Status.slid, final_runout=12.0, final_runout_mass=9.0, wall_time=1.0))
    assert (tally.threshold, tally.latest().mean.estimate) == (mean, mean)


def test_a_campaign_of_the_deterministic_run_alone_ends_with_it():
    tally = filled([], maximum=0)
    assert tally.size is None
    tally.add(summary(BASELINE))
    assert tally.size == 0
