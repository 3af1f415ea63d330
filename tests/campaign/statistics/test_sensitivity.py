"""The ranking of properties finds what was put in, with intervals that hold as often as they say."""

import numpy as np
import pytest
from scipy.stats import binom, spearmanr

from campaign.statistics import sensitivity
from campaign.statistics.sensitivity import (
    means_over,
    moving_ground,
    rank_correlations,
    ranking,
    standardised_regression,
)

MIXED = np.array([[1.0, 0.0], [-0.5, np.sqrt(0.75)]])
"""Makes two properties with a correlation of -0.5 of independent ones."""

COEFFICIENTS = np.array([-0.6, 0.2])
UNEXPLAINED = 1 - COEFFICIENTS @ (MIXED @ MIXED.T) @ COEFFICIENTS


def sample(n, seed):
    """Return means of two properties and an outcome, all of variance one."""
    rng = np.random.default_rng(seed)
    means = rng.normal(size=(n, 2)) @ MIXED.T
    return means, means @ COEFFICIENTS + np.sqrt(UNEXPLAINED) * rng.normal(size=n)


def test_rank_correlations_are_spearmans():
    means, outcome = sample(40, 1)
    outcome = np.round(outcome)  # with ties
    expected = [spearmanr(mean, outcome).statistic for mean in means.T]
    np.testing.assert_allclose(rank_correlations(means, outcome), expected, rtol=1e-12)


def test_regression_tells_properties_apart_that_are_correlated():
    """The second raises the outcome, and yet goes with a low one, as it is low where the first is high."""
    means, outcome = sample(20_000, 2)
    np.testing.assert_allclose(standardised_regression(means, outcome), COEFFICIENTS, atol=0.03)
    found = ranking(means[:2000], outcome[:2000], 0.95)
    assert found.explained == pytest.approx(1 - UNEXPLAINED, abs=0.06)


def test_units_do_not_matter():
    means, outcome = sample(100, 3)
    one, other = ranking(means, outcome, 0.95), ranking(means * [3.0, 0.1] + 7.0, 5.0 * outcome - 2.0, 0.95)
    np.testing.assert_allclose(one.regression, other.regression, rtol=1e-9)
    np.testing.assert_allclose(one.correlation, other.correlation, rtol=1e-9)


@pytest.mark.parametrize("threshold", [None, 0.8])
def test_intervals_hold_as_often_as_they_say(monkeypatch, threshold):
    """In 100 samples of 60 intervals of 90 % hold in 87 to 90 %, as percentiles of few resamples do; false alarm: 1 %.

    The same of an outcome that is only whether a threshold is passed, as sliding is, by a fifth of the realizations.
    """
    monkeypatch.setattr(sensitivity, "RESAMPLES", 100)
    means, outcome = sample(400_000, 4)
    truth = standardised_regression(means, passed(outcome, threshold))
    hits = np.zeros(2)
    for seed in range(100):
        means, outcome = sample(60, 100 + seed)
        found = ranking(means, passed(outcome, threshold), 0.9)
        hits += [each.lower <= true <= each.upper for each, true in zip(found.regression, truth, strict=True)]
    least, most = binom.ppf([0.0025, 0.9975], 100, [0.87, 0.90])
    assert ((least <= hits) & (hits <= most)).all(), hits


def passed(outcome, threshold):
    return outcome if threshold is None else (outcome > threshold).astype(float)


def test_ground_that_never_moves_does_not_count():
    field_map = np.arange(24.0).reshape(2, 1, 3, 4)
    field_map[:, :, 2, 3] = np.nan
    weights = np.zeros((3, 4))
    weights[0, 1], weights[1, 1], weights[2, 3] = 1.0, 3.0, 100.0
    np.testing.assert_allclose(means_over(field_map, weights), [[(1 + 3 * 5) / 4], [(13 + 3 * 17) / 4]])


def test_a_particle_counts_in_its_box_by_how_often_it_moves():
    boxes = np.array([1.0, 3.0, 5.0]), np.array([1.0, 3.0])
    places = np.array([0.1, 1.9, 2.1, 5.9]), np.array([0.1, 0.1, 3.9, 2.1])
    share = np.array([1.0, 0.5, 0.25, 0.125])
    np.testing.assert_allclose(moving_ground(places, boxes, share), [[1.5, 0.0, 0.0], [0.0, 0.25, 0.125]])
