"""A scene is screened for the choices that it has made, each one a valid scene of its own."""

import numpy as np
import pytest

from campaign.scene import load_scene
from campaign.scene.ground_surface import surface_of
from campaign.screening.choices import choices_of
from campaign.simulation.scene_sampler import strength_sampler

ALL = [
    "field.angle=10 deg",
    "soil.dilation_angle=1 deg",
    "soil.cohesion.residual_cov=0.1",
    "soil.friction_angle.residual_cov=0.1",
    "field.pairs={cohesion = {cohesion_residual = 0.5}}",
    "field.resolution=0.5 m",
]
ROAD = 'receptor=[{name = "road", x = "46 m"}]'
BORED = [*ALL, 'boring=[{name="B1", x="70 m", cohesion=[["2 m", "20 kPa"]], cohesion_residual=[["1 m", "10 kPa"]]}]']
PROFILE = [
    'geometry={surface = [["0 m", "19 m"], ["20 m", "19 m"], ["35 m", "4 m"], ["75 m", "4 m"]]}',
    *ALL,
]


def by_name(scene):
    return {choice.name: choice for choice in choices_of(scene)}


def changed(scene, name):
    return load_scene(scene, by_name(scene)[name].changes)


def test_what_a_scene_does_not_model_is_not_screened():
    names = by_name(load_scene("ma2023"))
    assert not names.keys() & {"dilation", "rotated correlation", "random residual strength"}
    assert "softening" not in by_name(load_scene("bui2008"))
    assert "two correlation lengths" not in by_name(load_scene("ma2023", ["field.horizontal=2 m"]))
    assert "cross-correlation" not in by_name(load_scene("ma2023", ["field.cross_correlation=0"]))


def test_a_scene_with_every_choice_is_screened_for_each():
    assert len(by_name(load_scene("ma2023", ALL))) == 14


@pytest.mark.parametrize("overrides", [[], ALL, BORED, PROFILE, [*PROFILE, ROAD], [*ALL, ROAD]])
def test_every_choice_leaves_a_valid_scene_with_another_identity(overrides):
    scene = load_scene("ma2023", overrides)
    for choice in choices_of(scene):
        if not choice.why_not:
            assert load_scene(scene, choice.changes).digest() != scene.digest(), choice.name


def test_what_takes_the_place_of_a_choice():
    scene = load_scene("ma2023", ALL)
    assert changed(scene, "random peak cohesion").soil.cohesion.cov == 0.0
    assert changed(scene, "random residual strength").soil.cohesion.residual_cov is None
    assert not changed(scene, "cross-correlation").field.cross_correlations()
    isotropic = changed(scene, "two correlation lengths").field
    assert isotropic.horizontal == isotropic.vertical == pytest.approx(40**0.5, rel=1e-5)
    assert changed(scene, "modulus 100 MPa").soil.young_modulus == 25e6


def test_isotropic_fields_are_drawn_on_a_grid_as_fine():
    """Left out, it is an eighth of the shorter distance, 2 m."""
    text = load_scene("ma2023").text.replace("resolution =", "# resolution =")
    from campaign.scene import scene_of

    assert changed(scene_of(text), "two correlation lengths").field.resolution == 0.25


def test_only_what_simplifies_may_be_dropped_together_with_others():
    """A ramp models more than a release."""
    assert not by_name(load_scene("ma2023"))['gravity "release"'].simplifies
    assert by_name(load_scene("ma2023", ["numerics.gravity=ramp"]))['gravity "ramp"'].simplifies


def test_the_crest_stays_where_receptors_are_measured_from_it():
    scene = load_scene("ma2023", [ROAD])
    assert "receptors" in by_name(scene)["crest of 20 m"].why_not
    for name in ("foundation of 4 m", "plain of 40 m"):
        assert surface_of(changed(scene, name).geometry).toe_x == surface_of(scene.geometry).toe_x


def test_ground_is_not_moved_past_its_layers_and_its_water():
    """Their elevations count from the base, and the x of lines from the wall behind the crest."""
    slope, profile = by_name(load_scene("layered", ["receptor=[]"])), by_name(load_scene("drawdown"))
    assert slope["foundation of 6 m"].why_not == "left out: it would move the ground past each layer's top"
    assert slope["crest of 25 m"].why_not == "left out: it would move the ground past layer.1.top"
    assert not slope["plain of 40 m"].why_not
    assert "water.table and water.level" in profile["foundation of 5 m"].why_not
    by_depth = load_scene("ma2023", ['layer=[{name="clay", depth="3 m"}]'])
    assert not any(choice.why_not for choice in choices_of(by_depth))


def test_a_profile_loses_half_its_foundation_and_half_its_plain():
    scene = load_scene("ma2023", PROFILE)
    own = surface_of(scene.geometry)
    lower, shorter = (surface_of(changed(scene, name).geometry) for name in ("foundation of 4 m", "plain of 40 m"))
    assert np.array_equal(lower.y, own.y - 2)
    assert (shorter.width, shorter.toe_x) == (55, 35)
    assert shorter.height_at(np.array([30.0])) == own.height_at(np.array([30.0]))


def gaussians(scene, x, above_base):
    """Return the standard Gaussian fields behind what is random in realization 0, by distances from the toe (m)."""
    surface = surface_of(scene.geometry)
    sampler = strength_sampler(scene, surface.width, surface.top)
    drawn, laws = sampler.draw(scene.campaign.seed, 0).at(x + surface.toe_x, above_base), sampler.layers[0].marginals
    return {name: (np.log(drawn[name]) - laws[name].log_mean) / laws[name].sigma for name in drawn}


def test_realizations_have_the_same_fields_but_where_a_choice_says_otherwise():
    """Seen from the toe; the foundation's is seen from the base, below which there is as much ground less.

    Of the first property that is random: a peak cohesion that no longer is leaves the friction angle as it was.
    """
    scene = load_scene("ma2023", ALL)
    x, y = np.random.default_rng(0).uniform([[-20.0], [0.5]], [[10.0], [3.5]], (2, 200))
    own = gaussians(scene, x, y)
    for choice in choices_of(scene):
        there = gaussians(load_scene(scene, choice.changes), x, y)
        first = next(iter(there))
        assert np.allclose(there[first], own[first], atol=1e-5) != choice.redraws, choice.name


def test_choices_of_layered_ground_change_every_layer_that_has_its_own():
    scene = load_scene("layered")
    found = {choice.name: choice for choice in choices_of(scene)}
    assert load_scene(scene, found["layers"].changes).layer == ()
    assert {soil.softening.law for soil in load_scene(scene, found["softening"].changes).soils} == {"none"}
    certain = load_scene(scene, found["random peak cohesion"].changes)
    assert {soil.cohesion.cov for soil in certain.soils} == {0.0}
    softer = load_scene(scene, found["modulus 40 MPa"].changes)
    assert [soil.young_modulus for soil in softer.soils] == [10e6, 3.75e6, 20e6]
