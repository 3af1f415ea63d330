"""Borings in a scene: data that cannot be are refused with their place, and unlikely ones are told."""

import pytest
from scene_complaints import complaint

from campaign.scene import load_scene
from campaign.scene.boring_data import boring_words, measured_in, unlikely_data

LAYER = 'layer=[{name="clay", top="7 m", cohesion={cov=0}}]'


def boring(keys='cohesion=[["2 m", "18 kPa"]]', x="10 m"):
    return f'boring=[{{name="B1", x="{x}", {keys}}}]'


def test_data_are_values_at_places_in_layers():
    """The crest is at 19 m; a depth counts from the surface at the boring."""
    keys = 'cohesion=[["2 m", "18 kPa"], ["13 m", "25 kPa"]], friction_angle=[["1 m", "11 deg"]], noise=0.1'
    found = measured_in(load_scene("ma2023", ['layer=[{name="clay", top="7 m"}]', boring(keys, "25 m")]))
    assert [(each.name, each.y, each.layer) for each in found] == [
        ("cohesion", 12.0, 0),
        ("cohesion", 1.0, 1),
        ("friction_angle", 13.0, 0),
    ]
    (low,) = measured_in(load_scene("ma2023", [boring('by="elevation", cohesion=[["2 m", "18 kPa"]]')]))
    assert (low.x, low.y, low.value, low.noise) == (10.0, 2.0, 18e3, 0.0)


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        ([boring(x="90 m")], "the ground goes from 0 m to 75 m; move it, or leave it out"),
        ([boring(x="-1 m")], "the ground goes from 0 m to 75 m; move it, or leave it out"),
        ([boring("noise=0.1")], "nothing was measured there; give a value of one of cohesion, friction_angle"),
        ([boring('cohesion=[["-2 m", "18 kPa"]]')], "2 m above the surface there is no ground"),
        ([boring('cohesion=[["20 m", "18 kPa"]]')], "1 m below the fixed base there is no ground; the ground is 19 m"),
        ([boring('cohesion=[["2 m", "18 kPa"], ["2 m", "19 kPa"]]')], "it has two values at x = 10 m, elevation 17 m"),
        ([boring('cohesion=[["2 m", "0 kPa"]]')], "each value must be above 0; leave out what was not found"),
        ([boring('friction_angle=[["2 m", "95 deg"]]')], "each value must be above 0 and below 90 deg"),
        ([boring('cohesion=[["18 kPa", "2 m"]]')], "that is a pressure, and a length is needed"),
        ([boring('cohesion="18 kPa"')], "it must be pairs of a depth or an elevation and a value, for instance"),
        ([boring('cohesion_residual=[["2 m", "9 kPa"]]')], "the residual cohesion is not random; give soil.cohesion"),
        ([boring('cohesion_residual=[["2 m", "9 kPa"]]'), "soil.cohesion.residual_share=0.5"],
         "the residual cohesion is a share of the peak; give values of the peak in their place, or leave the data out"),
        ([LAYER, boring('cohesion=[["13 m", "9 kPa"]]')], "the peak cohesion is not random in clay; give"),
        ([boring('cohesion=[["0 m", "9 kPa"]]'), "soil.cohesion.gradient=2 kPa/m", "soil.cohesion.mean=0 kPa",
          "soil.cohesion.residual=0 kPa"], "the mean is 0 at elevation 19 m"),
        ([boring('noise=-1, cohesion=[["2 m", "18 kPa"]]')], "it must not be negative"),
        ([boring('by="level", cohesion=[["2 m", "18 kPa"]]')], 'it must be "depth" or "elevation"'),
        (['boring={x="3 m"}'], "it must be written under a line [[boring]], with two brackets, once for each boring"),
    ],
)  # fmt: skip
def test_data_that_cannot_be_are_refused(overrides, expected):
    message = complaint(*overrides)
    assert expected in message
    assert message.startswith("--set boring")


def test_residuals_are_not_read_where_nothing_softens():
    """With a correlation of a residual, too, that is random by its keys."""
    random = ["soil.cohesion.residual_cov=0.2", "field.pairs.cohesion.cohesion_residual=0.5"]
    keys = 'cohesion=[["2 m", "18 kPa"]], cohesion_residual=[["2 m", "9 kPa"]]'
    soft, hard = (
        load_scene("ma2023", [*random, boring(keys), f"soil.softening.law={law}"]) for law in ("linear", "none")
    )
    assert [each.name for each in measured_in(soft)] == ["cohesion", "cohesion_residual"]
    assert [each.name for each in measured_in(hard)] == ["cohesion"]


def test_two_borings_have_two_names():
    two = f'boring=[{{name="B", x="1 m", {"cohesion=[]"}}}, {{name="B", x="2 m"}}]'
    assert "boring 1 has that name, too" in complaint(two)


def test_what_is_far_from_the_mean_is_told():
    """85 kPa where 20 kPa is the mean and 10 % the variation: ln 4.25 / 0.1 is 14 standard deviations."""
    ((key, text),) = unlikely_data(load_scene("ma2023", [boring('cohesion=[["2 m", "85 kPa"], ["4 m", "21 kPa"]]')]))
    assert key == "boring.0.cohesion"
    assert "a value lies 15 standard deviations from the mean peak cohesion; check its unit" in text
    assert boring_words(load_scene("ma2023", [boring()])).startswith("1, with 1 of peak cohesion. Every field honours")
    assert boring_words(load_scene("ma2023")) is None
