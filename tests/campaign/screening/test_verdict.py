"""The law by which a modelling choice is kept or dropped."""

import math

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.screening.effects import Realizations, effects_of
from campaign.screening.verdict import MOST, Verdict, deciding_number, judge, verdict_of
from campaign.statistics.intervals import Interval, unknown


def interval(lower, upper):
    return Interval((lower + upper) / 2, lower, upper, 40)


@pytest.mark.parametrize(
    ("lower", "upper", "verdict"),
    [
        (-0.4, 0.4, Verdict.DROP),
        (0.1, 0.5, Verdict.DROP),
        (0.1, 0.6, Verdict.OPEN),
        (-0.6, 0.6, Verdict.OPEN),
        (0.51, 0.9, Verdict.KEEP),
        (-0.9, -0.51, Verdict.KEEP),
    ],
)
def test_an_interval_within_the_tolerance_drops_and_one_beyond_it_keeps(lower, upper, verdict):
    assert judge([(interval(lower, upper), 0.5)]) is verdict


def test_all_intervals_have_to_be_within_and_one_beyond_is_enough():
    inside, across, beyond = ((interval(*bounds), 0.5) for bounds in ((-0.1, 0.1), (0.4, 0.6), (0.6, 0.7)))
    assert judge([inside, across]) is Verdict.OPEN
    assert judge([inside, across, beyond]) is Verdict.KEEP


def test_nothing_is_dropped_that_nothing_is_known_of():
    assert judge([]) is Verdict.OPEN
    assert judge([(unknown(0.0, 1), 0.5)]) is Verdict.OPEN


WIGGLE = np.tile([1.0, 1.0, -1.0, -1.0], 10) / math.sqrt(40 / 39)
"""Forty numbers with a standard deviation of 1."""

RUNOUTS = 10 + 2 * np.tile([1.0, -1.0], 20) / math.sqrt(40 / 39)
"""Of a mean of 10 m and a standard deviation of 2 m, so that 5 % of the mean is 0.5 m."""


def realizations(runouts, has_slid=None):
    slid = np.ones(len(runouts), dtype=bool) if has_slid is None else has_slid
    return Realizations(np.asarray(runouts), slid, np.isnan(runouts), np.empty((0, len(runouts)), dtype=bool), 1.0)


def test_the_change_of_the_mean_is_that_of_pairs():
    """t of 39 degrees is 2.0227: 0.3 +- 2.0227 * 1 / sqrt(40)."""
    mean = effects_of(small_scene(), realizations(RUNOUTS), realizations(RUNOUTS + 0.3 + WIGGLE))[0]
    assert mean.difference.interval[:3] == pytest.approx((0.3, 0.3 - 0.3198, 0.3 + 0.3198), abs=1e-4)
    assert mean.tolerance == pytest.approx(0.5)
    assert mean.share == pytest.approx(0.6)


def test_pairs_that_lack_a_run_out_are_left_out():
    there = np.where(np.arange(40) < 2, math.nan, RUNOUTS + 0.3)
    mean = effects_of(small_scene(), realizations(RUNOUTS), realizations(there))[0]
    assert mean.difference.interval[:4] == pytest.approx((0.3, 0.3, 0.3, 38))


def test_an_accuracy_of_the_scene_is_the_tolerance():
    mean, std, slide = effects_of(small_scene("campaign.accuracy=0.2 m"), realizations(RUNOUTS), realizations(RUNOUTS))
    assert (mean.tolerance, std.tolerance, slide.tolerance) == (0.2, 0.2, 0.05)


def test_a_probability_that_never_changes_takes_73_realizations_to_be_known_to_5_points():
    """z^2 / (n + z^2) <= 0.05 with z^2 = 3.8415 gives n >= 72.99."""
    effects = effects_of(small_scene(), realizations(RUNOUTS), realizations(RUNOUTS))
    assert verdict_of(effects) is Verdict.OPEN
    assert deciding_number(effects) == 73


def test_the_deciding_number_of_a_mean_follows_from_the_width_of_its_interval():
    """0.3198 m from 40 are to become 0.2 m: 40 (0.3198 / 0.2)^2 = 102.3."""
    effects = effects_of(small_scene(), realizations(RUNOUTS), realizations(RUNOUTS + 0.3 + WIGGLE))
    assert deciding_number(effects[:1]) == 103


def test_what_would_be_kept_is_decided_as_well():
    """A difference of 0.7 m, known to 0.2 m."""
    effects = effects_of(small_scene(), realizations(RUNOUTS), realizations(RUNOUTS + 0.7 + WIGGLE))
    assert verdict_of(effects) is Verdict.OPEN
    assert deciding_number(effects[:1]) == 103


def test_a_difference_of_just_the_tolerance_is_never_decided():
    effects = effects_of(small_scene(), realizations(RUNOUTS), realizations(RUNOUTS + 0.5 + WIGGLE))
    assert deciding_number(effects[:1]) is None or deciding_number(effects[:1]) > MOST


def test_a_slope_that_stands_without_the_choice_has_lost_its_run_out():
    """Eight of forty stand: 20 points fewer slide, and the mean falls by an eighth of ten."""
    stands = np.arange(40) < 8
    there = realizations(np.where(stands, 0.0, RUNOUTS), ~stands)
    mean, _, slide = effects_of(small_scene(), realizations(RUNOUTS), there)
    assert slide.difference.interval.estimate == pytest.approx(-0.2)
    assert mean.difference.interval.estimate == pytest.approx(-RUNOUTS[:8].sum() / 40)
    assert verdict_of([mean, slide]) is Verdict.KEEP
