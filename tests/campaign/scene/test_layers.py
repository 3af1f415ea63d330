"""Layers below [soil]: what they leave out is as there, they are cut by what lies above, and mistakes have a place."""

import numpy as np
import pytest
from scene_complaints import EXAMPLE, UNDRAINED, complaint, complaints, line_of

from campaign.scene import differences, load_scene, scene_of
from campaign.scene.complaints import sentences
from campaign.scene.cost import time_step
from campaign.scene.first_look import look_at
from campaign.scene.foresight import warnings
from campaign.scene.inputs import inputs_of, raised, with_more
from campaign.scene.layer_table import layer_rows
from campaign.scene.layers import interfaces_of, layer_at, lower_of
from campaign.scene.variant import with_stiffness
from campaign.scene.writing import toml_of
from solver.surface import Surface

CLAY = """
[[layer]]
name = "clay"
top = "6 m"
[layer.cohesion]
mean = "15 kPa"

[[layer]]
name = "rock"
depth = "12 m"
unit_weight = "24 kN/m^3"
young_modulus = "1 GPa"
"""


def layered(*overrides, text=CLAY):
    return scene_of(EXAMPLE.text + text, overrides)


def written(directory, text):
    path = directory / "slope.toml"
    path.write_text(EXAMPLE.text + text, "utf-8")
    return path


def test_what_a_layer_leaves_out_is_as_in_soil_even_where_that_is_changed():
    soil, clay, rock = layered("soil.cohesion.residual=8 kPa", "soil.cohesion.mean=30 kPa").soils
    assert (clay.cohesion.mean, clay.cohesion.cov, clay.cohesion.residual) == (15e3, 0.1, 8e3)
    assert rock.cohesion == soil.cohesion
    assert (rock.unit_weight, rock.friction_angle) == (24e3, soil.friction_angle)


def test_a_layer_may_have_what_soil_says_in_other_terms():
    """A slip to residual strength in place of a rate, residual strength without scatter, a law without friction."""
    own = "layer.1.softening.slip_to_residual=0.3 m", "layer.1.cohesion.residual_cov=0", "layer.2.law=tresca"
    soil, clay, rock = layered("soil.cohesion.residual_cov=0.1", "soil.dilation_angle=1 deg", *own).soils
    assert (soil.softening.rate, clay.softening.rate, clay.softening.slip_to_residual) == (0.189, None, 0.3)
    assert (soil.cohesion.residual_cov, clay.cohesion.residual_cov) == (0.1, None)
    assert (rock.friction_angle, rock.dilation_angle) == (None, 0.0)


def test_scenes_without_layers_are_what_they_were():
    assert load_scene("ma2023").digest().startswith("0bc3855b45b5a83d")
    assert load_scene("bui2008").digest().startswith("70cfea13150e7126")


def test_the_identity_of_a_layer_holds_all_of_its_soil():
    here = layered()
    assert here.identity()["layer.0.cohesion.residual"] == 10e3
    assert layered("layer.1.cohesion.cov=0.1").digest() == here.digest()
    assert differences(layered("layer.1.cohesion.mean=12 kPa").identity(), here.identity()) == [
        "layer.1.cohesion.mean is 12 kPa here but 15 kPa in the results directory"
    ]
    assert scene_of(toml_of(layered("layer.2.depth=11 m"))).digest() == layered("layer.2.depth=11 m").digest()


def test_tops_are_cut_by_the_surface_and_by_those_before():
    """The clay begins at 6 m; the rock 12 m below the surface, or at the clay where that is lower."""
    clay, rock = interfaces_of(layered())
    x = np.array([10.0, 26.0, 30.0, 50.0])
    np.testing.assert_allclose(clay.height_at(x), [6.0, 6.0, 6.0, 4.0])
    np.testing.assert_allclose(rock.height_at(x), [6.0, 1.0, -3.0, -8.0])
    assert layer_at((clay, rock), x, np.array([5.0, 5.0, 7.0, 3.0])).tolist() == [2, 1, 0, 1]


def test_the_lower_of_two_lines_turns_where_they_cross_and_keeps_vertical_faces():
    step = Surface(np.array([0.0, 4.0, 4.0, 10.0]), np.array([8.0, 8.0, 2.0, 2.0]))
    rising = Surface(np.array([-1.0, 11.0]), np.array([-1.0, 11.0]))
    found = lower_of(step, rising)
    x = np.linspace(0.0, 9.99, 100)
    np.testing.assert_allclose(found.height_at(x), np.minimum(step.height_at(x), rising.height_at(x)))
    both = lower_of(step, Surface(np.array([0.0, 10.0]), np.array([9.0, 0.0])))
    assert both.height_at(np.array([80 / 9])) == pytest.approx(1.0)


def test_the_stiffest_layer_limits_the_time_step_and_softer_ground_is_softer_everywhere():
    """Waves are sqrt(E / rho) fast: 1 GPa and 24 kN/m3 instead of 100 MPa and 20 kN/m3."""
    scene, plain = layered(), load_scene("ma2023")
    assert time_step(plain) / time_step(scene) == pytest.approx(np.sqrt(10.0 * 20.0 / 24.0))
    softer = load_scene(scene, with_stiffness(scene, 0.01))
    assert [soil.young_modulus for soil in softer.soils] == [1e6, 1e6, 1e7]


def test_inputs_are_those_of_each_layer():
    scene = layered("layer.2.softening.law=none")
    rows = {row.key: row for row in inputs_of(scene)}
    assert [key for key in rows if key.startswith("layer")] == [
        "layer.1.cohesion.mean",
        "layer.2.unit_weight",
        "layer.2.young_modulus",
    ]
    assert rows["layer.1.cohesion.mean"].name == "mean peak cohesion (clay)"
    assert rows["soil.cohesion.mean"].name == "mean peak cohesion (soil, rock)"
    assert rows["soil.friction_angle.mean"].name == "mean peak friction angle"
    assert rows["soil.softening.rate"].name == "softening rate (soil, clay)"
    frictions = {row.key: row.name for row in inputs_of(layered("layer.1.law=tresca"))}
    assert frictions["soil.friction_angle.mean"] == "mean peak friction angle (soil, rock)"
    assert raised(scene, rows["layer.1.cohesion.mean"]) == pytest.approx(16.5e3)
    more = with_more(scene, rows["layer.1.cohesion.mean"])
    assert [soil.cohesion.mean for soil in more.soils] == [20e3, pytest.approx(16.5e3), 20e3]
    more = with_more(scene, rows["soil.cohesion.mean"])
    assert [soil.cohesion.mean for soil in more.soils] == [pytest.approx(22e3), 15e3, pytest.approx(22e3)]


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        ("layer.1.cohesion.residual=16 kPa", 'is "16 kPa", but it must not exceed the mean peak cohesion, 15 kPa'),
        ("layer.1.cohesion.mean=5 kPa", 'layer 1) is "10 kPa" as in [soil], but it must not exceed the mean peak'),
        ("layer.2.dilation_angle=9 deg", "must not exceed the residual friction angle, 5 deg"),
        ("layer.1.friction_angle.cov=3", "somewhere in a thousand realizations a lognormal peak friction angle"),
        ('layer.1.top=[["0 m", "3 m"], ["60 m", "2 m"]]', "it goes from x = 0 m to 60 m, and the section from 0 m to"),
        ('layer.1.top=[["0 m", "3 m"], ["90 m", "-2 m"]]', "it must lie above the base"),
        ('layer.1.top=[["9 m", "3 m"], ["0 m", "2 m"]]', "it must go from left to right, and point 2"),
        ("layer.1.top=5", 'a length needs its unit and quotes, for instance "2 m"'),
        ("layer.2.name=clay", "layer 1 has that name, too"),
        ("layer.2.name=soil", "the ground at the surface is told as soil; give another name"),
        ("layer.1.softening.internal_length=1 m", 'it belongs to another section, as "soil.softening.internal_length"'),
        ("layer.1.field=none", 'it must be "shared" or "own"'),
        ("layer.7.name=clay", "layer is a list of 2; set one key of one of them, as layer.1.name, or all of it"),
        ("layer.1.law=undrained", "it must be"),
    ],
)
def test_a_layer_that_cannot_be_is_refused_with_its_place(override, expected, tmp_path):
    message = complaint(override, source=written(tmp_path, CLAY))
    assert expected in message
    assert message.startswith(("--set layer.", "layer."))


def test_a_layer_has_one_top_and_a_friction_angle_that_is_whole(tmp_path):
    path = written(tmp_path, '[[layer]]\nname = "a"\n\n[[layer]]\nname = "b"\ntop = "3 m"\ndepth = "2 m"\n')
    none, both = complaints(source=path)
    place = f"layer.top (slope.toml, line {line_of('[[layer]]', path)}, layer 1)"
    assert none.startswith(f"{place} is not given, but each layer has one; add for instance top")
    assert "the depth says the same in other terms" in both
    text = EXAMPLE.text
    for old, new in UNDRAINED:
        text = text.replace(old, new)
    sand = '\n[[layer]]\nname = "sand"\ntop = "3 m"\nlaw = "mohr-coulomb"\n'
    path.write_text(text + sand, "utf-8")
    assert "add a section [layer.friction_angle]" in complaint(source=path)
    path.write_text(f'{text}{sand}friction_angle.mean = "30 deg"\n', "utf-8")
    cov, residual = complaints(source=path)
    assert " has no cov; add it" in cov
    assert residual.startswith("layer.friction_angle.residual")
    assert "is not given, but the exponential law needs it" in residual
    path.write_text(f'{text}{sand}friction_angle = {{mean = "30 deg", cov = 0.1, residual = "20 deg"}}\n', "utf-8")
    soil, below = load_scene(path).soils
    assert (soil.friction_angle, below.friction_angle.cov) == (None, 0.1)


def test_there_are_only_so_many_layers_as_the_solver_is_compiled_for():
    """It is from 22 on that the compiler gives up."""
    many = [f'{{name="{number}", top="{15 - number} m"}}' for number in range(11)]
    assert "it must be 10 layers or fewer" in complaint(f"layer=[{', '.join(many)}]")
    assert len(load_scene("ma2023", [f"layer=[{', '.join(many[:10])}]"]).soils) == 11


def test_a_mistake_in_soil_is_told_once():
    message = complaint("soil.cohesion.residual=25 kPa", source="layered")
    assert message.startswith("--set soil.cohesion.residual")


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        (["layer.1.top=0.1 m"], "no particle lies in clay, which is at most 0.1 m thick"),
        (["layer.2.top=7 m"], "nothing is left of clay between the tops"),
        (["layer.2.top=5 m"], "clay is at most 1 m thick, less than 2 cells"),
        (["layer.2.top=4 m"], "less than a fifth of the slope, and weaker than the ground beside it"),
        (["layer.1.unit_weight=50 kN/m^3"], "soils have 5 to 40 kN/m^3"),
    ],
)
def test_odd_layers_are_warned_of(overrides, expected):
    scene = layered(*overrides, "field.resolution=1 m")
    told = sentences(warnings(scene, look_at(scene)), scene)
    assert any(expected in sentence for sentence in told), told


def test_layers_that_can_be_meant_are_not_warned_of():
    scene = load_scene("layered")
    assert sentences(warnings(scene, look_at(scene)), scene) == []


def test_correlations_are_of_the_layers_that_have_both_properties():
    """A layer without friction, or with one residual strength, has none there; too strong ones are refused."""
    pairs = "field.pairs={cohesion = {cohesion_residual = 0.5}, friction_angle = {friction_angle_residual = 0.5}}"
    random = "soil.cohesion.residual_cov=0.1", "soil.friction_angle.residual_cov=0.1"
    layered(pairs, *random, "layer.1.cohesion.residual_cov=0", "layer.2.law=tresca")
    message = complaint(
        "field.cross_correlation_of=lognormal",
        "field.cross_correlation=-0.95",
        "layer.2.cohesion.cov=0.4",
        source="layered",
    )
    assert message.startswith("--set field.cross_correlation is -0.95, but lognormal fields with these coefficients")
    assert message.endswith("(in layer 2).")


def test_the_table_of_layers_tells_both_unit_weights():
    water = ["soil.unit_weight=18.5 kN/m^3", "soil.saturated_unit_weight=20 kN/m^3"]
    clay = 'layer=[{name="clay", top="4 m", unit_weight="17 kN/m^3", saturated_unit_weight="17 kN/m^3"}]'
    weights = [row.unit_weight for row in layer_rows(load_scene("ma2023", [*water, clay]))]
    assert weights == ["18.5, wet 20 kN/m^3", "17 kN/m^3"]
