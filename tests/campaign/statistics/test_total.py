"""One interval for sampling and mesh, which holds the limit of small cells."""

import math

import numpy as np
import pytest

from campaign.statistics.discretisation import Discretisation
from campaign.statistics.intervals import Interval, mean_interval
from campaign.statistics.total import total_interval

MEAN = Interval(11.0, 10.8, 11.2, 100)


def pairs(*differences):
    return Discretisation(1.0, np.array(differences, dtype=float), 0.0, 0.95)


def test_sampling_of_both_and_the_change_itself():
    """Three equal pairs have no scatter: 11 - 0.6 +- (0.2 + 0.6). With scatter, sqrt(0.2^2 + b^2) + |c|."""
    assert total_interval(MEAN, pairs(-0.6, -0.6, -0.6))[:3] == pytest.approx((10.4, 9.6, 11.2))
    scattered = pairs(-0.2, -0.6, -1.0)
    half_width = math.hypot(0.2, scattered.interval.half_width) + 0.6
    assert total_interval(MEAN, scattered)[:3] == pytest.approx((10.4, 10.4 - half_width, 10.4 + half_width))


def test_the_arms_of_a_quantile_stay_apart():
    """12 m, 11 to 15 m, and three equal pairs: 12 + 0.6, less 1 + 0.6 and more 3 + 0.6. An unknown bound stays so."""
    found = pairs(0.6, 0.6, 0.6)
    assert total_interval(Interval(12.0, 11.0, 15.0, 40), found)[:3] == pytest.approx((12.6, 11.0, 16.2))
    half_known = total_interval(Interval(12.0, 11.0, np.nan, 40), found)
    assert half_known.lower == pytest.approx(11.0)
    assert math.isnan(half_known.upper)


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0, 4.0])
@pytest.mark.parametrize("sign", [-1, 1])
def test_the_limit_lies_within_at_every_order_of_one_or_more(order, sign):
    """M(h) = 10 + 1.5 h^p, counted with h = 1 m without scatter: the limit is 10 m."""
    coarse, fine = (10.0 + sign * 1.5 * h**order for h in (1.0, 0.5))
    total = total_interval(Interval(coarse, coarse, coarse, 100), pairs(*[fine - coarse] * 4))
    assert total.lower <= 10.0 + 1e-12
    assert total.upper >= 10.0 - 1e-12


@pytest.mark.parametrize("found", [None, pairs(), pairs(np.nan, np.nan), pairs(0.5)])
def test_without_two_pairs_it_is_the_sampling_interval(found):
    assert total_interval(MEAN, found) == MEAN


def test_no_slide_runs_less_than_nothing():
    assert total_interval(Interval(1.0, 0.9, 1.1, 50), pairs(-0.7, -0.7)).lower == 0.0


@pytest.mark.parametrize(("order", "measured"), [(1.0, 0.918), (1.5, 0.983), (2.0, 0.992)])
def test_it_holds_the_limit_as_often_as_it_says(order, measured):
    """Run-outs with a standard deviation of 1 m; half the cell changes them by -0.5 m, with scatter 0.3 m in 4 pairs.

    Measured with 3000 campaigns; at first order an error of the change counts twice. 400 here: standard error at most
    1.4 %, a share lower by 5 % is a false alarm with probability below 1e-3.
    """
    rng, limit = np.random.default_rng(11), 10.0 - 0.5 * (1 + 1 / (2**order - 1))
    totals = [
        total_interval(mean_interval(rng.normal(10.0, 1.0, 100), 0.95), pairs(*rng.normal(-0.5, 0.3, 4)))
        for _ in range(400)
    ]
    assert np.mean([each.lower <= limit <= each.upper for each in totals]) > measured - 0.05
