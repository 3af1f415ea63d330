"""Intervals against SciPy, published examples and their own promise: to contain the truth as often as they say."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from campaign.statistics.intervals import (
    Interval,
    kurtosis,
    mean_interval,
    quantile_interval,
    variance_interval,
)

# Bonett (2006), section 5.
BONETT_DATA = np.array([15.83, 16.01, 16.24, 16.42, 15.33, 15.44, 16.88, 16.31])

REPEATS = 1500


def contains(interval, truth):
    return interval.lower <= truth <= interval.upper


def lognormal(rng, size, coefficient_of_variation):
    """Draw a lognormal sample of mean 1."""
    variance = math.log1p(coefficient_of_variation**2)
    return rng.lognormal(-variance / 2, math.sqrt(variance), size)


def test_mean_interval_is_students():
    values = np.random.default_rng(1).normal(10.8, 0.51, 37)
    expected = stats.ttest_1samp(values, 0).confidence_interval(0.9)
    interval = mean_interval(values, 0.9)
    assert (interval.lower, interval.upper) == pytest.approx((expected.low, expected.high), rel=1e-12)
    assert (interval.estimate, interval.n) == (pytest.approx(values.mean()), 37)


@pytest.mark.parametrize(
    ("confidence", "lower", "upper"), [(0.90, 0.3592, 0.9359), (0.95, 0.3263, 1.0841), (0.99, 0.2607, 1.5109)]
)
def test_variance_interval_reproduces_the_published_example(confidence, lower, upper):
    """Standard deviation 0.5168 and its intervals as printed by Bonett (2006)."""
    interval = variance_interval(BONETT_DATA, confidence)
    assert math.sqrt(interval.estimate) == pytest.approx(0.5168, abs=5e-5)
    assert math.sqrt(interval.lower) == pytest.approx(lower, abs=5e-5)
    assert math.sqrt(interval.upper) == pytest.approx(upper, abs=5e-5)


def test_kurtosis_of_a_symmetric_sample_is_the_plain_moment_ratio():
    half = np.random.default_rng(2).normal(size=50)
    values = 3 + np.concatenate([half, -half])
    assert kurtosis(values) == pytest.approx(stats.kurtosis(values, fisher=False), rel=1e-12)


def test_kurtosis_of_a_skewed_sample_by_hand():
    """Five values are trimmed to their median 0: 5 * 10^4 / (4 * 2^2 + 8^2)^2."""
    assert kurtosis(np.array([0.0, 0.0, 0.0, 0.0, 10.0])) == pytest.approx(7.8125)


def test_median_of_ten_lies_between_the_second_and_the_ninth():
    """The classical ranks at 95 %: P(2 <= B(10, 1/2) <= 8) = 0.979, and one rank less on either side gives 0.891."""
    interval = quantile_interval(np.arange(1.0, 11.0), 0.5, 0.95)
    assert interval == Interval(estimate=5.5, lower=2.0, upper=9.0, n=10)


@pytest.mark.parametrize("n", [1, 5, 6, 71, 72, 300])
@pytest.mark.parametrize("probability", [0.05, 0.5, 0.95])
def test_the_quantile_interval_is_scipys(n, probability):
    values = np.random.default_rng(n).lognormal(size=n)
    expected = stats.quantile_test(values, p=probability).confidence_interval(0.95)
    np.testing.assert_array_equal(quantile_interval(values, probability, 0.95)[1:3], (expected.low, expected.high))


@pytest.mark.parametrize(
    "interval",
    [
        mean_interval(np.array([10.8]), 0.95),
        mean_interval(np.array([]), 0.95),
        variance_interval(np.arange(4.0), 0.95),
        variance_interval(np.array([]), 0.95),
        variance_interval(np.full(100, 10.8), 0.95),
        variance_interval(np.arange(5.0), 1 - 1e-9),
        quantile_interval(np.arange(5.0), 0.5, 0.95),
        quantile_interval(np.array([]), 0.5, 0.95),
    ],
)
def test_too_small_a_sample_gives_no_interval(interval):
    assert not interval.is_known


def test_an_estimate_outlives_its_interval():
    assert mean_interval(np.array([10.8]), 0.95).estimate == 10.8
    assert variance_interval(np.array([1.0, 2.0, 3.0]), 0.95).estimate == 1.0


def test_mean_and_variance_intervals_cover_for_normal_run_outs():
    """95 % of the intervals from 100 normal run-outs contain the truth.

    1500 repeats: standard error 0.6 %; a deviation of 3 % is a false alarm with probability below 1e-4.
    """
    samples = np.random.default_rng(3).normal(10.8, 0.51, (REPEATS, 100))
    assert np.mean([contains(mean_interval(x, 0.95), 10.8) for x in samples]) == pytest.approx(0.95, abs=0.03)
    assert np.mean([contains(variance_interval(x, 0.95), 0.51**2) for x in samples]) == pytest.approx(0.95, abs=0.03)


def test_variance_interval_covers_skewed_run_outs_where_chi_square_does_not():
    """Lognormal run-outs, coefficient of variation 0.5, n = 1000: Bonett's interval covers 94 %, chi-square 73 %.

    1500 repeats: standard errors 0.6 % and 1.1 %; false alarm below 1e-4 for either bound.
    """
    samples = lognormal(np.random.default_rng(4), (REPEATS, 1000), 0.5)
    chi_square = np.sum((samples - samples.mean(axis=1, keepdims=True)) ** 2, axis=1) / 0.25
    low, high = stats.chi2.interval(0.95, 999)
    assert np.mean((low < chi_square) & (chi_square < high)) < 0.80
    assert np.mean([contains(variance_interval(x, 0.95), 0.25) for x in samples]) > 0.90


def test_quantile_interval_covers_at_least_as_promised():
    """90 % intervals of the upper decile of an exponential sample of 80, whatever the distribution.

    800 repeats: standard error 1.1 %; 85 % is missed by chance with probability below 1e-5.
    """
    samples = np.random.default_rng(5).exponential(size=(800, 80))
    covered = [contains(quantile_interval(x, 0.9, 0.9), math.log(10)) for x in samples]
    assert np.mean(covered) > 0.85


@settings(deadline=None, max_examples=30)
@given(
    seed=st.integers(0, 2**32 - 1),
    n=st.integers(5, 60),
    scale=st.floats(0.01, 100),
    shift=st.floats(-100, 100),
)
def test_intervals_do_not_depend_on_the_unit(seed, n, scale, shift):
    """Run-out in other units from another origin: the mean moves along, the variance scales with the square."""
    values = np.random.default_rng(seed).normal(size=n)
    moved = scale * values + shift
    mean, variance = np.array(mean_interval(values, 0.95)[:3]), np.array(variance_interval(values, 0.95)[:3])
    np.testing.assert_allclose(mean_interval(moved, 0.95)[:3], scale * mean + shift, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(variance_interval(moved, 0.95)[:3], scale**2 * variance, rtol=1e-6)


def test_the_interval_of_a_quantile_holds_however_far_lower_bounds_are_off():
    """Of 100 values the interval of the median is from the 40th to the 61st; six lower bounds count as above it."""
    values, is_least = np.arange(1.0, 101.0), np.zeros(100, dtype=bool)
    is_least[:6] = True
    assert quantile_interval(values, 0.5, 0.95)[1:3] == (40.0, 61.0)
    assert quantile_interval(values, 0.5, 0.95, is_least)[1:3] == (40.0, 67.0)
    is_least[:40] = True
    assert quantile_interval(values, 0.5, 0.95, is_least)[1:3] == (40.0, math.inf)
