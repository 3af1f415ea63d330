"""The account of a campaign does not depend on the order in which realizations finish."""

import numpy as np
import pytest

from campaign.record import Status
from campaign.running.dispatcher import Dispatcher
from campaign.seeds import BASELINE
from campaign.statistics.convergence import Rule
from campaign.statistics.tally import Outcome, Report, Tally

RULE = Rule(mean_tolerance=0.05, variance_tolerance=0.5, confidence=0.95, minimum=20, block=10)
RUNOUTS = np.random.default_rng(1).normal(10, 0.5, 200)


def outcome(realization, status=Status.slid):
    return Outcome(realization, status, RUNOUTS[realization], 1.0)


def filled(order, maximum=200, failing=()):
    tally = Tally(maximum, RULE, max_failed_fraction=0.1)
    for k in order:
        tally.add(outcome(k, Status.crashed if k in failing else Status.slid))
    return tally


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
    tally.add(outcome(15))
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


def test_missing_ids_are_handed_out_once_and_the_baseline_first():
    dispatcher = Dispatcher(filled([0, 2], maximum=5), lambda _longest: "")
    assert [dispatcher.exchange(Report(None)) for _ in range(5)] == [BASELINE, 1, 3, 4, None]
    assert dispatcher.stopped == ""


def test_a_problem_on_one_rank_stops_all():
    dispatcher = Dispatcher(filled([], maximum=5), lambda _longest: "")
    assert dispatcher.exchange(Report(None, "the disk is full")) is None
    assert dispatcher.exchange(Report(None)) is None
    assert dispatcher.stopped == "the disk is full"


def test_nothing_is_started_that_does_not_fit_into_the_job():
    dispatcher = Dispatcher(filled([BASELINE, 0]), lambda longest: "no time" if longest >= 1.0 else "")
    assert dispatcher.exchange(Report(None)) is None
