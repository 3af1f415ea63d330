"""The sensitivity map finds where strength counts, and is silent where nothing does."""

import math

import numpy as np
import pytest
from layered_soil import maps, runouts, slopes
from scipy.stats import binom

from campaign.statistics.sensitivity import means_over
from campaign.statistics.sensitivity_map import sensitivity_map

PER_TENTH = math.log(1.1)


@pytest.fixture(scope="module")
def found():
    field_map = maps(300, 1)
    return sensitivity_map(field_map, runouts(field_map, 0.3, 2), 0.95)


def test_the_map_finds_where_strength_counts(found):
    truth = PER_TENTH * slopes()
    assert np.corrcoef(np.nan_to_num(found.change).ravel(), truth.ravel())[0, 1] > 0.85
    assert np.sign(found.change[found.is_clear & (truth != 0)]) == pytest.approx(
        np.sign(truth[found.is_clear & (truth != 0)])
    )
    assert found.is_clear[truth != 0].mean() > 0.6


def test_there_is_nothing_where_there_is_no_ground(found):
    assert np.isnan(found.change[:, -1, -3:]).all()
    assert np.isfinite(found.change).sum() == 2 * (5 * 8 - 3)
    assert not found.is_clear[:, -1, -3:].any()


def test_it_explains_what_is_no_noise(found):
    signal = np.var(runouts(maps(3000, 3), 0.0, 4))
    assert found.explained == pytest.approx(signal / (signal + 0.3**2), abs=0.12)


def test_the_sum_over_the_boxes_is_the_effect_everywhere():
    """95 % intervals hold in 90 % of campaigns or more, less the bias of the penalty; false alarm in 40: 1e-3."""
    truth = PER_TENTH * slopes().sum(axis=(1, 2))
    hits = np.zeros(2)
    for seed in range(40):
        field_map = maps(150, 10 + seed)
        everywhere = sensitivity_map(field_map, runouts(field_map, 0.3, 500 + seed), 0.95).everywhere
        hits += [each.lower <= true <= each.upper for each, true in zip(everywhere, truth, strict=True)]
    assert (hits >= binom.ppf(5e-4, 40, 0.9)).all(), hits


def test_without_any_effect_hardly_a_map_has_a_clear_box():
    """Of 60 maps of pure noise at most 5 % have one; false alarm: 1e-3."""
    rng = np.random.default_rng(5)
    field_map = maps(100, 6)
    clear = [sensitivity_map(field_map, rng.normal(10.0, 1.0, 100), 0.95).is_clear.any() for _ in range(60)]
    assert np.sum(clear) <= binom.ppf(0.999, 60, 0.05)


def test_a_property_that_is_random_in_a_part_of_the_ground_counts_there_alone(found):
    """The second property, which changes nothing, left out of the upper rows: the first one is found as before."""
    field_map = maps(300, 1)
    field_map[:, 1, 2:] = np.nan
    partly = sensitivity_map(field_map, runouts(field_map, 0.3, 2), 0.95)
    assert np.isnan(partly.change[1, 2:]).all()
    assert np.isfinite(partly.change[1, :2]).all()
    truth = PER_TENTH * slopes()[0]
    assert np.corrcoef(np.nan_to_num(partly.change[0]).ravel(), truth.ravel())[0, 1] > 0.85
    assert len(partly.everywhere) == 2
    assert partly.everywhere[0].estimate == pytest.approx(float(np.nansum(partly.change[0])))


def test_means_over_moving_ground_take_each_property_where_it_is_random():
    field_map = maps(3, 1)
    field_map[:, 1, 2:] = np.nan
    weights = np.ones(field_map.shape[2:])
    means = means_over(field_map, weights)
    np.testing.assert_allclose(means[:, 0], np.nanmean(field_map[:, 0], axis=(1, 2)))
    np.testing.assert_allclose(means[:, 1], np.nanmean(field_map[:, 1], axis=(1, 2)))
    weights[:2] = 0.0
    np.testing.assert_allclose(means_over(field_map, weights)[:, 1], means[:, 1])  # it does not move: all the same
