"""What can be run but hardly be meant is said with key, value and remedy; a sound scene gets no warning."""

import re

import pytest

from campaign.scene import load_scene, scene_of
from campaign.scene.complaints import sentences
from campaign.scene.document import read_document
from campaign.scene.first_look import look_at
from campaign.scene.foresight import expected_of_slides, warnings
from campaign.scene.front import front_of_particles

PROFILE = 'geometry={surface=[["0 m","19 m"],["20 m","19 m"],["35 m","4 m"],["45 m","4 m"]]}'

BENCHED = 'geometry={surface=[["0 m","25 m"],["36 m","24 m"],["42 m","19 m"],["46 m","18.6 m"],["53 m","13 m"],'
BENCHED += '["57 m","12.6 m"],["64 m","7 m"],["125 m","5 m"]]}'
UPPER = 'geometry={surface=[["0 m","30 m"],["20 m","30 m"],["30 m","16 m"],["50 m","16 m"],["62 m","10 m"],'
UPPER += '["99 m","10 m"]]}'
MIRRORED = 'geometry={surface=[["0 m","10 m"],["20 m","4 m"],["40 m","4 m"],["55 m","19 m"],["75 m","19 m"]]}'
WALL = (
    'geometry={surface=[["0 m","19 m"],["20 m","19 m"],["35 m","4 m"],["50 m","4 m"],["50 m","7 m"],["50.5 m","7 m"],'
)
WALL += '["50.5 m","4 m"],["75 m","4 m"]]}'
SLOT = 'geometry={surface=[["0 m","19 m"],["10 m","19 m"],["10 m","16.5 m"],["10.6 m","16.5 m"],["10.6 m","19 m"],'
SLOT += '["20 m","19 m"],["35 m","4 m"],["75 m","4 m"]]}'
ABOVE_SEA = 'geometry={surface=[["0 m","319 m"],["20 m","319 m"],["35 m","304 m"],["75 m","304 m"]]}'


def warned(*overrides, source="ma2023"):
    scene = load_scene(source, overrides)
    look = look_at(scene)
    return sentences([*warnings(scene, look), *expected_of_slides(scene, look)], scene)


@pytest.mark.parametrize("source", ["ma2023", "ma2023-printed", "bui2008"])
def test_the_built_in_scenes_are_sound(source):
    assert warned(source=source) == []


@pytest.mark.parametrize(
    ("overrides", "sentence"),
    [
        (["soil.cohesion.mean=25 MPa"], '--set soil.cohesion.mean is "25 MPa", but the factor of safety is then 479'),
        (["numerics.end_time=1 s"], "but half of comparable slides take more than 10 s to come to rest"),
        (["numerics.gravity=ramp"], "after the ramp of 2 s to come to rest"),
        (["geometry.slope.plain=3 m"], '--set geometry.slope.plain is "3 m", but slides of 15 m mostly run out'),
        ([PROFILE], "the wall 10 m beyond the toe would hold them back; continue the ground to x = 57 m or farther"),
        (["geometry.slope.crest=4 m", "soil.cohesion.residual=4 kPa"], "begins at the wall on the left"),
        (["soil.friction_angle.mean=0.1 deg", "soil.friction_angle.residual=0 deg", "geometry.slope.angle=25 deg"],
         "m below the fixed base if there was soil, and the base then holds the slope; if there is no rock, deepen"),
        (["geometry.slope.foundation=2 m", "soil.friction_angle.mean=3 deg", "soil.friction_angle.residual=0.5 deg",
          "soil.cohesion.mean=35 kPa"], "the critical slip circle comes down to 0.65 m above the fixed base, and the"),
        (["geometry.slope.foundation=2 m"], "comes out at the toe, 2 m above the fixed base, and a band of 1.25 m may"),
        (["soil.cohesion.mean=1 kPa", "soil.cohesion.residual_share=1", "soil.friction_angle.mean=30 deg"],
         "badly; use "),
        (["numerics.output_interval=1e-4 s"], 'need 100,000 steps instead of 3,508; use "0.029 s" or more'),
        (["numerics.flip=0.999"], "--set numerics.flip is 0.999, but this damping takes about 0.8 % of the work"),
        (["campaign.realization_timeout=1 s", "numerics.cell=0.5 m"],
         'may take 5 s; use at least "0.0029 h", or larger cells'),
        (["campaign.discretisation_pairs=2"], "is 2, but so few pairs hardly bound what half the cell changes"),
        (["campaign.realizations=1000000000"], "core-hours; use fewer, or larger cells"),
        (["slide.front_area=0.1 m^2"], 'leaves 0.1 m2 ahead of it, 0.4 particles of 0.25 m2, and'),
        (["soil.softening.slip_to_residual=0.3 m"], 'decide the run-out; use "1 m^2" or more, or smaller cells'),
        ([BENCHED, "geometry.toe=53 m"], 'comes out at x = 64 m, below the toe at elevation 13 m'),
        ([BENCHED, "geometry.toe=20 m"], 'use geometry.toe = "64 m"'),
        ([UPPER, "geometry.toe=62 m"], "high above the toe: a slide that stops before the toe, x = 62 m, runs 0 m"),
        (["slide.front_area=100 m^2"], "the front is to leave 1e+02 m2 of it ahead; use "),
        (["soil.unit_weight=20 N/m^3"], 'is "20 N/m^3", but soils have 5 to 40 kN/m^3; check the number and the unit.'),
        (["soil.young_modulus=1 Pa"], "but soils have 0.1 MPa (very soft) to 100 GPa"),
        (["soil.cohesion.cov=10.0", "soil.cohesion.residual_share=0.5"], "but soils have 0.1 to 0.6"),
        ([MIRRORED], "falls by 15 m towards the left and by 6 m towards the right, where slides go; if"),
        ([ABOVE_SEA], "the ground goes 304 m below the foot of a slope of 15 m, and what lies deeper than one height"),
        ([WALL], "around x = 50 m it has a wall or a slot 3 m high that is narrower than a cell of 1 m"),
        ([SLOT], "it has a wall or a slot 2.5 m high that is narrower than a cell of 1 m"),
        (["soil.cohesion.residual=16 kPa"],
         'in 1.4 % of the ground the peak cohesion that is drawn is below it and is raised to it, which makes the '
         'ground stronger and less variable than it is written; give residual_share = 0.8 in its place, a share of the '
         'peak at each place, or at most "15 kPa".'),
        (["soil.tension_cutoff=0 kPa"], "gaps that open stay open when the ground is compressed again"),
        (["soil.softening.rate=1e14"], "but soils have about 0.1 to 10"),
    ],
)  # fmt: skip
def test_what_can_hardly_be_meant_is_said_with_its_remedy(overrides, sentence):
    found = warned(*overrides)
    assert any(sentence in text for text in found), found


def test_a_cutoff_beyond_the_apex_opens_nothing():
    """c cot(phi) is 113 kPa; a layer that takes it over is not told again."""
    layer = 'layer=[{name="clay", top="3 m", cohesion={mean="30 kPa"}}]'
    assert not [text for text in warned("soil.tension_cutoff=114 kPa") if "gaps" in text]
    assert len([text for text in warned("soil.tension_cutoff=112 kPa", layer) if "gaps" in text]) == 1


def test_steep_faces_benches_and_ditches_of_a_cell_are_seen():
    points = [(0, 19), (20, 19), (20, 16), (22, 16), (30, 5), (31, 5), (32, 3), (33, 3), (34, 5), (75, 5)]
    ground = f"geometry={{surface={[[f'{x} m', f'{y} m'] for x, y in points]}}}"
    assert not any("wall or a slot" in text for text in warned(ground))


def test_where_no_slide_is_expected_what_would_stop_one_is_told_as_an_if():
    ground, run = warned("soil.cohesion.mean=45 kPa", "geometry.slope.plain=5 m", "numerics.end_time=2 s")[::-1]
    assert "but no slide is expected, but should there be one, half of comparable" in run
    assert "but no slide is expected, but should there be one, slides of 15 m" in ground


def test_a_slope_that_cannot_slide_is_not_asked_for_a_longer_run():
    assert len(warned("soil.cohesion.mean=25 MPa", "numerics.end_time=1 s", "geometry.slope.plain=3 m")) == 1


def test_the_toe_of_a_benched_slope_is_where_its_critical_circle_comes_out():
    look = look_at(load_scene("ma2023", [BENCHED]))
    assert look.surface.toe_x == 64.0
    assert look.peak.exit == pytest.approx(64.0, abs=1.0)
    assert not [text for text in warned(BENCHED) if "toe" in text]


def test_a_toe_that_is_not_the_slopes_is_told_and_not_the_front_that_follows_from_it():
    """By default the area ahead of the front grows with the height above the toe, which is 1 m on a bench here."""
    points = [(0, 14), (10, 14), (12, 13), (60, 13), (75, 4), (95, 4)]
    bench = f"geometry={{surface={[[f'{x} m', f'{y} m'] for x, y in points]}}}"
    text = re.sub(r"(?m)^front_area.*\n", "", read_document("ma2023").text)
    scene = scene_of(text, [bench, "geometry.toe=12 m"])
    look = look_at(scene)
    assert front_of_particles(scene, look) is not None
    assert [complaint.key for complaint in warnings(scene, look)] == ["geometry.toe"]


def test_realizations_that_are_all_the_same_are_foretold():
    certain = ["soil.cohesion.cov=0", "soil.friction_angle.cov=0"]
    (told,) = [text for text in warned(*certain) if "coefficient of variation" in text]
    assert "all realizations are the same, and 1 is enough" in told
    assert not [text for text in warned(certain[0]) if "coefficient of variation" in text]
