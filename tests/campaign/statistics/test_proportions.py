"""Probabilities: exact where a number is asked for sure, and bounded where realizations cannot be counted."""

import math

import numpy as np
import pytest
from scipy import stats
from tallies import summary_of

from campaign.record import Status
from campaign.statistics.outcomes import outcomes_of
from campaign.statistics.proportions import (
    exact_interval,
    exceedance,
    exceedance_given_sliding,
    failure_bounds,
    slide_probability,
)
from campaign.statistics.wording import chance_of_slide, estimated_chance


def contains(interval, truth):
    return interval.lower <= truth <= interval.upper


def test_no_slide_in_forty_leaves_nearly_nine_per_cent():
    assert exact_interval(0, 40, 0.95) == (0.0, 0.0, pytest.approx(0.0881, abs=5e-5), 40, False)
    assert exact_interval(40, 40, 0.95) == (1.0, pytest.approx(0.9119, abs=5e-5), 1.0, 40, False)


@pytest.mark.parametrize("n", [1, 7, 40, 1000])
def test_the_exact_interval_is_scipys(n):
    for successes in {0, 1, n // 3, n - 1, n}:
        expected = stats.binomtest(successes, n).proportion_ci(0.9, method="exact")
        assert exact_interval(successes, n, 0.9)[1:3] == pytest.approx((expected.low, expected.high), abs=1e-12)


@pytest.mark.parametrize("n", [10, 50, 125])
def test_the_exact_interval_holds_for_every_probability(n):
    """Exact coverage, summed over the binomial distribution: never below 95 %."""
    truths = np.linspace(0.001, 0.999, 333)
    intervals = [exact_interval(k, n, 0.95) for k in range(n + 1)]
    coverage = [sum(stats.binom.pmf(k, n, p) for k, each in enumerate(intervals) if contains(each, p)) for p in truths]
    assert min(coverage) >= 0.95


def test_failure_bounds_by_hand():
    assert failure_bounds(exceeding=40, valid=80, failed=20) == (0.4, 0.6)
    assert failure_bounds(exceeding=40, valid=80, failed=0) == (0.5, 0.5)
    assert all(map(math.isnan, failure_bounds(0, 0, 0)))


def outcomes(**runouts):
    """Return outcomes by status, with the run-outs of each."""
    given = [(runout, Status[name]) for name, values in runouts.items() for runout in values]
    return outcomes_of([summary_of(k, runout, status) for k, (runout, status) in enumerate(given)], "mass")


def test_a_slope_that_stays_has_a_run_out_of_zero():
    given = outcomes(slid=[8.0, 10.0, 12.0], not_settled=[11.0], no_slide=[0.4, 0.9], crashed=[math.nan])
    assert (given.realizations, given.usable, given.slides) == (7, 6, 4)
    assert slide_probability(given, 0.95)[::3] == (4 / 6, 6)
    assert exceedance(given, 9.0, 0.95)[::3] == (3 / 6, 6)
    assert exceedance_given_sliding(given, 9.0, 0.95)[::3] == (3 / 4, 4)
    assert exceedance(given, 0.2, 0.95).estimate == 4 / 6


@pytest.mark.parametrize("cause", ["reached_wall", "not_settled"])
def test_slides_cut_short_bound_the_exceedance(cause):
    """Of 20 slides 5 run beyond 9 m for sure, and 4 that were cut short at 8 m may have done so."""
    given = outcomes(**{"slid": [7.0] * 11 + [10.0] * 4, cause: [8.0] * 4 + [9.5]})
    found = exceedance(given, 9.0, 0.95)
    assert found.estimate == 5 / 20
    assert found.lower == exact_interval(5, 20, 0.95).lower
    assert found.upper == exact_interval(9, 20, 0.95).upper
    assert found.is_least
    assert estimated_chance(found) == "at least 25 %"
    assert not exceedance(given, 7.5, 0.95).is_least  # which all that were cut short have passed
    none_yet = exceedance(given, 12.0, 0.95)
    assert (estimated_chance(none_yet), chance_of_slide(none_yet)) == ("at most 49 %", "0 to 49 %")
    assert slide_probability(given, 0.95).estimate == 1.0


def test_without_threshold_or_slide_there_is_no_share():
    assert not exceedance(outcomes(slid=[1.0, 2.0]), math.nan, 0.95).is_known
    assert not exceedance_given_sliding(outcomes(no_slide=[0.0]), 1.0, 0.95).is_known
    assert not slide_probability(outcomes(crashed=[math.nan]), 0.95).is_known
