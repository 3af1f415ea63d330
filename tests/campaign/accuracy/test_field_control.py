"""The field as the cheapest model: less scatter, the same mean."""

import numpy as np
import pytest

from campaign.accuracy.field_control import controlled, deviations
from campaign.fields.marginals import Lognormal
from campaign.scene import load_scene

PLACES = 40


def campaigns(count, n, noise=0.5):
    """Yield outcomes and fields of campaigns whose outcome has mean 2 and variance 1 + noise^2."""
    rng = np.random.default_rng(3)
    weights = rng.normal(size=PLACES)
    weights /= np.linalg.norm(weights)
    for _ in range(count):
        field = rng.normal(size=(n, PLACES))
        yield 2.0 + field @ weights + noise * rng.normal(size=n), field


def test_what_the_field_foretells_no_longer_scatters():
    outcomes, field = next(campaigns(1, 400))
    assert np.var(controlled(outcomes, field)) < 0.35 * np.var(outcomes)  # 0.25 of 1.25, and what is not known of it


def test_the_mean_stays_unbiased_and_its_error_is_as_large_as_the_scatter_says():
    """Of 300 campaigns: a bias of 3 standard errors has a false alarm of 1 in 400, the ratio's band of 1 in 1000."""
    found = [controlled(*each) for each in campaigns(300, 120)]
    errors = np.array([each.mean() - 2.0 for each in found])
    expected = np.sqrt(np.mean([np.var(each, ddof=1) / 120 for each in found]))
    assert abs(errors.mean()) < 3 * expected / np.sqrt(300)
    assert errors.std() == pytest.approx(expected, rel=0.15)


@pytest.mark.parametrize(
    ("outcomes", "field"),
    [
        (np.arange(20.0), np.ones((20, 3))),
        (np.ones(100), np.random.default_rng(0).normal(size=(100, 3))),
        (np.arange(100.0), np.empty((100, 0))),
        (np.random.default_rng(1).normal(size=60), np.random.default_rng(2).normal(size=(60, 3))),
    ],
    ids=["few", "all alike", "no map", "unrelated"],
)
def test_outcomes_that_it_does_not_foretell_stay_as_they_are(outcomes, field):
    np.testing.assert_array_equal(controlled(outcomes, field), outcomes)


def test_deviations_have_mean_zero_and_are_in_standard_deviations():
    scene = load_scene("ma2023")
    law = Lognormal(scene.soil.cohesion.mean, scene.soil.cohesion.cov)
    angle = Lognormal(scene.soil.friction_angle.mean, scene.soil.friction_angle.cov)
    gaussian = np.random.default_rng(4).normal(size=(20_000, 1, 2))
    maps = np.stack([np.log(law(gaussian)), np.log(angle(-gaussian))], axis=1)
    maps[:, :, :, 1] = np.nan  # no ground there
    found = deviations(maps, scene)
    assert found.shape == (20_000, 2)
    np.testing.assert_allclose(found[:, 0], gaussian[:, 0, 0], atol=1e-12)
    np.testing.assert_allclose(found[:, 1], -gaussian[:, 0, 0], atol=1e-12)


def test_where_nothing_is_random_there_are_no_deviations():
    certain = load_scene("ma2023", ["soil.cohesion.cov=0", "soil.friction_angle.cov=0"])
    assert deviations(np.empty((5, 0, 0, 0)), certain).shape == (5, 0)
