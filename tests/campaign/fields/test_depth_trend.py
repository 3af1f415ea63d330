"""Strength that grows with depth: mean and standard deviation alike, at the particle's own depth."""

import numpy as np
import pytest
from soil_fields import DEVIATIONS

from campaign.accuracy.field_control import deviations
from campaign.scene import load_scene
from campaign.scene.ground_surface import surface_of
from campaign.seeds import BASELINE
from campaign.simulation.field_summary import box_map
from campaign.simulation.ground import strengths_of

REALIZATIONS = 200
GROWING = ("numerics.cell=2 m", "field.resolution=1 m", "soil.cohesion.gradient=2 kPa/m", "soil.cohesion.cov=0.3")
CUT = 'layer=[{name="clay", top="19 m", law="tresca", cohesion={mean="0 kPa", residual="0 kPa"}}]'


def growing(*overrides):
    return load_scene("ma2023", [*GROWING, *overrides])


def test_mean_and_standard_deviation_grow_with_depth():
    """At nine depths below the crest. False alarm: 6.3e-5 for each of 18 moments, so 1 in 880."""
    scene, depth = growing(), np.arange(0.5, 18.0, 2.0)
    x, y = np.full_like(depth, 5.5), 19.0 - depth
    drawn = np.array([strengths_of(scene, k).at(x, y)["cohesion"] for k in range(REALIZATIONS)])
    relative = drawn / (20e3 + 2e3 * depth) - 1.0
    for moment, expected in ((relative, 0.0), (relative**2, 0.3**2)):
        error = moment.std(axis=0, ddof=1) / np.sqrt(REALIZATIONS)
        assert np.all(np.abs(moment.mean(axis=0) - expected) < DEVIATIONS * error)


def test_the_trend_multiplies_the_field_without_it_at_the_depth_of_the_place():
    """Two places in one cell of the field, the upper 0.1 m and the lower 0.9 m below the crest."""
    x, y = np.array([5.5, 5.5]), np.array([18.9, 18.1])
    with_trend, without = (
        strengths_of(scene, 3).at(x, y)["cohesion"] for scene in (growing(), growing("soil.cohesion.gradient=0 kPa/m"))
    )
    np.testing.assert_allclose(with_trend / without, 1.0 + 2e3 * np.array([0.1, 0.9]) / 20e3)


def test_mean_strengths_have_the_trend_below_the_slope_too():
    field = strengths_of(growing(), BASELINE)
    x, y = np.array([5.0, 27.5, 60.0]), np.array([10.0, 10.0, 3.5])
    np.testing.assert_allclose(field.at(x, y)["cohesion"], 20e3 + 2e3 * np.array([9.0, 1.5, 0.5]))
    np.testing.assert_allclose(field["cohesion"][9, 5], 20e3 + 2e3 * 9.5)


def test_strength_may_grow_from_nothing_and_without_scatter():
    certain = growing("soil.cohesion.mean=0 kPa", "soil.cohesion.residual=0 kPa", "soil.cohesion.cov=0")
    np.testing.assert_allclose(strengths_of(certain, 3).at(np.array([5.0]), np.array([10.0]))["cohesion"], 18e3)
    random = growing("soil.cohesion.mean=0 kPa", "soil.cohesion.residual=0 kPa")
    assert strengths_of(random, 3).at(np.array([5.0]), np.array([19.0]))["cohesion"] == 0.0


def test_depth_in_a_layer_counts_from_its_top_as_drawn():
    """Clay from the crest's elevation down, cut by the slope: 0 at 19 m, wherever the ground is."""
    scene = growing(CUT, "layer.1.cohesion.gradient=1 kPa/m", "soil.cohesion.gradient=0 kPa/m")
    x, y = np.array([5.0, 27.0, 60.0]), np.array([10.0, 10.0, 3.5])
    read = strengths_of(scene, BASELINE).at(x, y, np.array([1, 1, 1]))["cohesion"]
    np.testing.assert_allclose(read, [9e3, 9e3, 15.5e3])


@pytest.mark.parametrize("more", [(), (CUT, "layer.1.cohesion.gradient=1 kPa/m", "layer.1.cohesion.cov=0")])
def test_maps_are_of_the_field_without_its_trend(more):
    """So that the deviations have the mean 0 that the accuracy of a mean rests on. False alarm: 6.3e-5 a box."""
    scene = growing(*more)
    fields = [strengths_of(scene, k) for k in range(60)]
    boxes = box_map(surface_of(scene.geometry), fields[0].grid)
    found = deviations(np.array([boxes.means(field) for field in fields]), scene)
    error = found.std(axis=0, ddof=1) / np.sqrt(60.0)
    assert np.isfinite(found).all()
    assert np.mean(np.abs(found.mean(axis=0)) < DEVIATIONS * error) > 0.99
