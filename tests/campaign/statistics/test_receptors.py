"""Probabilities and effects at a place, from made-up outcomes counted by hand."""

import math

import numpy as np
import pytest
import xarray as xr
from scipy import special

from campaign.record import Status
from campaign.statistics.receptors import EFFECTS, reach_probability, receptor_estimates

CONFIDENCE = 0.95


PLACE = 20.0  # m: the near end of the receptor


def dataset(front, moved, statuses, depth, stop=0.0, farther=np.nan):
    """Return the variables of one receptor, by realization; `stop` is where fronts end (m)."""
    effects = {name: (("realization", "receptor"), np.array(depth)[:, None], {"units": "m"}) for name in EFFECTS}
    reaches = {"front_reaches": front, "moved_ground_reaches": moved}
    flags = {name: (("realization", "receptor"), np.array(values)[:, None]) for name, values in reaches.items()}
    status = {"status": ("realization", np.array([int(status) for status in statuses]))}
    fronts = {
        "front_position": (
            ("realization", "time"),
            np.tile(np.reshape(stop, (-1, 1)), (len(statuses) // np.size(stop), 2)),
        ),
        "farther_advance": ("realization", np.broadcast_to(farther, len(statuses))),
        "settle_time": ("realization", np.full(len(statuses), 5.0)),
    }
    bounds = {"receptor_x_bounds": (("receptor", "bounds"), [[PLACE, PLACE + 4.0]])}
    return xr.Dataset(effects | flags | status | fronts, {"receptor": ["road"], **bounds})


def test_the_interval_is_that_of_clopper_and_pearson():
    """3 of 20: the bounds are quantiles of beta distributions, 0.0321 and 0.3789 in the tables."""
    reaches = np.array([1.0] * 3 + [0.0] * 17)
    interval, bounds = reach_probability(reaches, np.zeros(20, dtype=bool), CONFIDENCE)
    assert interval.estimate == 0.15
    assert interval.lower == pytest.approx(special.betaincinv(3, 18, 0.025)) == pytest.approx(0.0321, abs=5e-5)
    assert interval.upper == pytest.approx(special.betaincinv(4, 17, 0.975)) == pytest.approx(0.3789, abs=5e-5)
    assert bounds == (0.15, 0.15)


def test_nothing_in_forty_has_an_upper_bound():
    interval, _ = reach_probability(np.zeros(40), np.zeros(40, dtype=bool), CONFIDENCE)
    assert (interval.estimate, interval.lower) == (0.0, 0.0)
    assert interval.upper == pytest.approx(1.0 - 0.025 ** (1 / 40))


def test_failures_are_left_out_and_bounded_and_so_is_what_still_moves():
    """Of ten, two reach, one failed, and one that has not reached it still moves: 2 of 9, and 2 to 4 of 10."""
    reaches = np.array([1.0, 1.0, np.nan, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    may_come = np.array([True, False, False, True, *[False] * 6])
    interval, bounds = reach_probability(reaches, may_come, CONFIDENCE)
    assert (interval.estimate, interval.n) == (2 / 9, 9)
    assert interval.lower == pytest.approx(special.betaincinv(2, 8, 0.025))
    assert interval.upper == pytest.approx(special.betaincinv(4, 6, 0.975))
    assert bounds == (0.2, 0.4)


def test_without_a_result_nothing_is_known():
    interval, bounds = reach_probability(np.full(3, np.nan), np.zeros(3, dtype=bool), CONFIDENCE)
    assert not interval.is_known
    assert interval.n == 0
    assert np.isnan(bounds).all()


def test_a_stable_slope_counts_as_not_reached_and_effects_are_of_those_reached():
    """8 of 16 are reached, 4 more only pushed, 3 do not slide, 1 crashed; depths of the reached are 1, 2, ..., 8 m."""
    front = [1.0] * 8 + [0.0] * 7 + [np.nan]
    moved = [1.0] * 12 + [0.0] * 3 + [np.nan]
    statuses = [Status.slid] * 12 + [Status.no_slide] * 3 + [Status.crashed]
    depth = [*np.arange(1.0, 9.0), 0.3, 0.3, 0.3, 0.3, 0.0, 0.0, 0.0, np.nan]
    estimates = receptor_estimates(dataset(front, moved, statuses, depth), CONFIDENCE)
    by_quantity = {estimate.quantity: estimate for estimate in estimates}
    assert {estimate.receptor for estimate in estimates} == {"road"}
    assert by_quantity["probability that the slide's front reaches it"].interval.estimate == 8 / 15
    assert by_quantity["probability that any moved ground reaches it"].interval.estimate == 12 / 15
    assert by_quantity["probability that any moved ground reaches it"].open_bounds == (12 / 16, 13 / 16)
    median = by_quantity["median of the largest flow depth, where reached"]
    assert (median.interval.estimate, median.interval.n, median.unit) == (4.5, 8, "m")
    assert (median.interval.lower, median.interval.upper) == (1.0, 8.0)
    assert math.isnan(by_quantity["95 % quantile of the largest flow depth, where reached"].interval.upper)


def test_a_place_that_nothing_reaches_has_probabilities_alone():
    estimates = receptor_estimates(dataset([0.0] * 5, [0.0] * 5, [Status.no_slide] * 5, [0.0] * 5), CONFIDENCE)
    assert [estimate.interval.is_known for estimate in estimates] == [True, True] + [False] * (2 * len(EFFECTS))


def test_without_receptors_there_is_nothing_to_say():
    assert receptor_estimates(xr.Dataset({"runout": ("time", [0.0])}), CONFIDENCE) == []


def test_what_a_wall_has_stopped_is_bounded():
    """Of four slides one reaches the place, and one that a wall has stopped before it might have: 1 to 2 of 4."""
    statuses = [Status.slid, Status.slid, Status.reached_wall, Status.slid]
    reaches = [1.0, 0.0, 0.0, 0.0]
    first = receptor_estimates(dataset(reaches, reaches, statuses, [1.0, 0.0, 0.0, 0.0]), CONFIDENCE)[0]
    assert first.open_bounds == (1 / 4, 2 / 4)
    assert first.interval.lower == pytest.approx(special.betaincinv(1, 4, 0.025))
    assert first.interval.upper == pytest.approx(special.betaincinv(3, 2, 0.975))


def test_a_slide_that_still_moves_gets_no_farther_than_friction_lets_it():
    """Of four that still move, one may come 1 m farther and is 0.5 m short, one is 31 m short, one has no bound."""
    statuses = [Status.not_settled] * 4
    stop, farther = np.array([21.0, PLACE - 0.5, PLACE - 31.0, 5.0]), np.array([1.0, 1.0, 1.0, np.nan])
    reaches = [1.0, 0.0, 0.0, 0.0]
    front, moved = (
        each
        for each in receptor_estimates(dataset(reaches, reaches, statuses, reaches, stop, farther), CONFIDENCE)
        if "probability" in each.quantity
    )
    assert front.open_bounds == (1 / 4, 3 / 4)
    assert moved.open_bounds == (1 / 4, 1.0)
