"""Slopes that slide sometimes, seldom or never: what the stopping rule asks of them, and when it is content."""

import numpy as np
import pytest
from tallies import summary_of

from campaign.record import Status
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.statistics.stopping import StoppingRule, too_few
from campaign.statistics.tally import Tally

RULE = StoppingRule(0.02, 0.4, 0.95, 100, 25, 0.1)


def campaign(statuses, rule=RULE, runouts=None, baseline=9.0):
    """Return the account of realizations that end so."""
    runouts = np.random.default_rng(7).normal(9.0, 0.5, len(statuses)) if runouts is None else runouts
    tally = Tally(len(statuses), rule, 0.1, "mass")
    tally.add(summary_of(BASELINE, baseline, Status.slid if baseline else Status.no_slide))
    for k, (runout, status) in enumerate(zip(runouts, statuses, strict=True)):
        tally.add(summary_of(k, runout, status))
    return tally


def asked(*overrides):
    """Return what a scene asks of its campaign."""
    return load_scene("ma2023", ["campaign.minimum=100", "campaign.block=25", *overrides]).campaign


def slides(probability, count, seed=3):
    """Draw which of `count` realizations slide."""
    slid = np.random.default_rng(seed).random(count) < probability
    return [Status.slid if each else Status.no_slide for each in slid]


def test_without_a_slide_a_campaign_ends_as_soon_as_that_is_an_answer():
    """Upper bounds of 0 of n at 95 % confidence, 1 - 0.025^(1/n): 13.7 % at 25, 7.1 % at 50."""
    tally = campaign([Status.no_slide] * 1000)
    assert tally.size == 50
    history = tally.history()
    assert (history.converged_at, history.slide_probability[-1]) == (50, 0.0)
    assert history.slide_probability_ci[-1].tolist() == [0.0, pytest.approx(1 - 0.025 ** (1 / 50))]
    assert history.verdict == (
        "sampling converged at 50 realizations: none slid, the probability of a slide is at most 7.1 %, at 95 % "
        "confidence"
    )


def test_a_finer_tolerance_is_asked_of_a_stable_slope_too():
    """Half of 1 - 0.025^(1/n) is at most 1 % from 183 on: the next multiple of 25 is 200."""
    assert campaign([Status.no_slide] * 1000, StoppingRule(0.02, 0.4, 0.95, 100, 25, 0.01)).size == 200


def test_failures_do_not_count_as_stable():
    """Of 50 realizations 5 failed: 0 of 45 is at most 7.9 %. Of 50 all but 30 failed: 0 of 30 is at most 11.6 %."""
    assert campaign([*[Status.no_slide] * 45, *[Status.timeout] * 5, *[Status.no_slide] * 50]).size == 50
    assert campaign([*[Status.no_slide] * 30, *[Status.timeout] * 20]).history().converged_at is None


def test_one_slide_in_the_first_block_asks_for_the_minimum():
    statuses = [Status.slid, *[Status.no_slide] * 999]
    assert campaign(statuses).size == 125


@pytest.mark.parametrize("seed", range(20))
def test_a_slope_of_one_per_cent_ends_without_mean_and_variance(seed):
    """4 slides of 100 are still at most 9.9 %, and 5 of 125 at most 9.1 %: more come in 2e-3 of the campaigns."""
    tally = campaign(slides(0.01, 1000, seed))
    assert tally.size is not None
    assert tally.size <= 150
    assert tally.history().verdict.startswith("sampling converged at")
    assert tally.history().slide_probability_ci[-1, 1] <= 0.1


def test_the_verdict_on_few_slides_says_why_there_is_no_mean():
    verdict = campaign([Status.slid, *[Status.no_slide] * 999]).history().verdict
    assert verdict == (
        "sampling converged at 125 realizations: 1 slid, the probability of a slide is 0.02 to 4.4 %, and too few "
        "slide for a mean and a variance, at 95 % confidence"
    )


def test_a_slope_of_45_per_cent_goes_on_until_enough_have_slid():
    """At least 100 slides, which is 222 realizations on average with a standard deviation of 16."""
    tally = campaign(slides(0.45, 1000))
    history = tally.history()
    assert history.converged_at is not None
    assert 100 <= history.n_slides[-2] <= history.n_slides[-1]
    assert 222 - 5 * 16 < history.converged_at < 222 + 5 * 16 + 50


def test_the_slides_needed_are_forecast_from_the_share_that_slides():
    """100 slides at 45 % are 222 realizations: seen at 225 and confirmed at 250, give or take what 100 tell of 45 %."""
    statuses = [Status.slid if k % 20 in (0, 2, 4, 6, 8, 10, 12, 14, 16) else Status.no_slide for k in range(100)]
    assert campaign(statuses).history().predicted_n[-1] == 250


@pytest.mark.parametrize(
    ("sliding", "looked_at", "stop"),
    [(range(0), 25, 50), (range(10, 400, 100), 90, 125), (range(0, 400, 2), 90, 225)],
    ids=["none", "one per cent", "half"],
)
def test_the_rule_stops_where_it_was_forecast_if_all_stays_the_same(sliding, looked_at, stop):
    statuses = [Status.slid if k in sliding else Status.no_slide for k in range(400)]
    assert campaign(statuses[:looked_at]).history().predicted_n[-1] == stop
    assert campaign(statuses).size == stop


def test_the_probability_of_a_slide_alone_can_hold_a_campaign_back():
    """Half of 200 realizations slide: known to 7.1 %."""
    statuses = [Status.slid, Status.no_slide] * 100
    tally = campaign(statuses, StoppingRule(0.5, 5.0, 0.95, 50, 25, 0.02))
    assert tally.history().verdict == (
        "not converged after 200 realizations: the probability of a slide is known to ±7.13 %, ±2 % was asked"
    )


def test_exceedance_is_of_all_realizations():
    """45 of 100 slide and 35 run beyond 9 m: 35 %, though 78 % of the slides do."""
    runouts = np.full(100, 0.5)
    runouts[:45] = np.r_[np.full(35, 9.5), np.full(10, 8.0)]
    history = campaign([Status.slid] * 45 + [Status.no_slide] * 55, runouts=runouts).history()
    assert history.exceedance[-1] == 0.35
    assert history.exceedance_given_sliding[-1] == pytest.approx(35 / 45)


def test_beyond_a_deterministic_run_that_stays_are_all_slides():
    history = campaign([Status.slid] * 45 + [Status.no_slide] * 55, baseline=0.0).history()
    assert history.exceedance[-1] == history.slide_probability[-1] == 0.45


@pytest.mark.parametrize(
    ("count", "words"),
    [
        (20, "at most 17 %; 36 without a slide bound it by 10 %, which is asked for"),
        (40, "at most 8.8 %, as asked for; whether that is enough is decided every 25 realizations"),
    ],
)
def test_a_slope_that_stands_is_not_asked_for_mean_and_variance(count, words):
    """Of 20 the bound is 1 - 0.025^(1/20) = 17 %; 36 is the least n with 0.025^(1/n) >= 0.9."""
    verdict = campaign([Status.no_slide] * count).history().verdict
    assert verdict == f"not converged after {count} realizations: none slid, so the probability of a slide is {words}"


def test_too_few_realizations_are_told_before_they_are_computed():
    """Two looks in a row, at 100 and at 125; an accuracy is reached without the rule."""
    assert too_few(asked("campaign.realizations=125")) == ""
    assert too_few(asked("campaign.realizations=124", "campaign.accuracy=3 %")) == ""
    assert too_few(asked("campaign.realizations=124")) == (
        "At most 124 realizations cannot converge where the slope slides: campaign.minimum = 100 and campaign.block = "
        "25 ask for 125 or more."
    )
