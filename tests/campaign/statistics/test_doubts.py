"""Doubts: raised for runaway realizations, silent for harmless samples."""

import numpy as np
import pytest

from campaign.statistics.doubts import detached_fronts, doubts


def normal_runouts(seed, n):
    return np.random.default_rng(seed).normal(10.8, 0.51, n)


@pytest.mark.parametrize("n", [0, 1, 4, 30, 100, 1000])
def test_normal_run_outs_raise_no_doubt(n):
    """20 campaigns of each size.

    A share of 20/n (n < 100) or 20 % (n >= 100) is a value beyond 4.4 standard deviations: false alarm below 0.03 at
    n = 100, the worst size, and below 1e-3 elsewhere.
    """
    assert not any(doubts(normal_runouts(seed, n)) for seed in range(20))


def test_three_per_cent_of_runaways_are_noticed():
    values = normal_runouts(1, 1000)
    values[::33] += 10
    (doubt,) = doubts(values)
    assert "(their kurtosis is 2" in doubt


def test_one_runaway_is_named_by_its_realization():
    """The id is the place among all realizations, the unusable ones included."""
    values = normal_runouts(2, 200)
    values[::7] = np.nan
    values[143] = 25.0
    tail, single = doubts(values)
    assert "kurtosis" in tail
    assert single.startswith("Realization 143 alone, with a run-out of 25 m, makes 8")


def test_equal_run_outs_are_suspicious():
    (doubt,) = doubts(np.full(50, 10.8))
    assert doubt.startswith("All 50 run-outs are equal")


def test_a_front_that_has_come_apart_is_told():
    runouts = np.array([7.0, 8.0, 9.0, 10.0])
    apart = np.array([0.0, 0.1, 0.2, 0.0])
    assert detached_fronts(np.zeros(4), runouts, 0.25, "tip") == []
    (doubt,) = detached_fronts(apart, runouts, 0.25, "tip")
    assert doubt.startswith("In 2 of 4 slides the front-most ground has come apart")
    assert doubt.endswith('Use slide.front = "mass" (8.50 m on average).')


def test_the_mass_front_does_not_care_about_less_debris_than_lies_ahead_of_it():
    assert detached_fronts(np.array([0.0, 0.1, 0.2, 0.0]), np.full(4, 8.0), 0.25, "mass") == []


def test_debris_larger_than_the_mass_front_is_told():
    apart = np.array([0.0, 0.1, 0.25, 3.0])
    (doubt,) = detached_fronts(apart, np.full(4, 8.0), 0.25, "tip")
    assert doubt.endswith("in any of them: in 2 there is more debris than the front leaves ahead.")
    (doubt,) = detached_fronts(apart, np.full(4, 8.0), 0.25, "mass")
    assert doubt.startswith("In 2 of 4 slides more ground than slide.front_area has come apart")
    assert doubt.endswith('Use slide.front_area = "3.1 m^2", more than has come apart in any of them.')
