"""Water in a scene: what it becomes in the ground, and what is refused with a remedy."""

import numpy as np
import pytest
from scene_complaints import complaint, found_in

from campaign.scene import load_scene
from campaign.scene.document import read_document
from campaign.scene.ground_water import most_carried, water_of, water_words
from campaign.scene.polylines import across, lower_of, upper_of
from solver.surface import Surface
from solver.water import NO_WATER

TABLE = 'water.table=[["0 m", "15 m"], ["20 m", "12 m"], ["35 m", "4 m"], ["75 m", "4 m"]]'


def test_a_scene_without_water_is_the_scene_that_it_was():
    dry = load_scene("ma2023")
    assert water_of(dry) == NO_WATER
    assert not any(key.startswith("water") for key in dry.identity())
    assert load_scene("ma2023", ["water.r_u=0.2"]).digest() != dry.digest()


def test_the_polyline_of_two_follows_the_lower_or_the_upper_one():
    one, other = across([[0.0, 2.0], [4.0, 2.0]], 4.0), across([[0.0, 0.0], [4.0, 4.0]], 4.0)
    x = np.linspace(0.0, 4.0, 33)
    np.testing.assert_allclose(lower_of(one, other).height_at(x), np.minimum(2.0, x))
    np.testing.assert_allclose(upper_of(one, other).height_at(x), np.maximum(2.0, x))


def test_a_table_is_cut_where_it_is_sketched_above_the_ground():
    """The face falls from 19 m at x = 20 m to 4 m at 35 m; at x = 30 m it is at 9 m, and the sketch at 9.4 m."""
    scene = load_scene("ma2023", ['water.table=[["0 m", "15 m"], ["30 m", "9.4 m"], ["35 m", "4 m"], ["75 m", "4 m"]]'])
    table = water_of(scene).table
    np.testing.assert_allclose(table.height_at(np.array([0.0, 30.0, 40.0])), [15.0, 9.0, 4.0])


def test_standing_water_is_the_least_that_the_table_can_be():
    scene = load_scene("ma2023", [TABLE, "water.level=7 m"])
    np.testing.assert_allclose(water_of(scene).table.height_at(np.array([0.0, 34.0, 60.0])), [15.0, 7.0, 7.0])
    assert water_of(scene).level == 7.0
    alone = water_of(load_scene("ma2023", ["water.level=7 m"]))
    np.testing.assert_allclose(alone.table.height_at(np.array([0.0, 60.0])), 7.0)


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        (("water.r_u=0.3", TABLE), "a water table says more than a ratio"),
        (("water.r_u=0.95",), "at most 0.9"),
        (("water.level=4 m",), "no ground lies below it, for the lowest is at 4 m"),
        (('water.table=[["0 m", "15 m"], ["40 m", "4 m"]]',), "continue it to both walls"),
        (("water.table=12 m",), "at x = 35 m it lies 8 m above the ground"),
        ((TABLE, "soil.saturated_unit_weight=19 kN/m^3"), "weighs no less than moist, 20 kN/m^3"),
        (("water.level=7 m", "soil.unit_weight=9 kN/m^3"), "the ground would float"),
    ],
)
def test_water_that_contradicts_itself_or_the_ground_is_refused(overrides, expected):
    assert expected in complaint(*overrides)


def test_a_table_of_one_elevation_may_be_level():
    load_scene("ma2023", ["water.table=4 m"])


def test_a_surface_knows_where_its_water_stands():
    tables = dict(read_document("ma2023").tables)
    surface = [["0 m", "19 m"], ["20 m", "19 m"], ["35 m", "4 m"], ["75 m", "4 m"]]
    tables["geometry"] = {"surface": surface}
    assert found_in(tables | {"water": {"level": "6 m"}}) == []
    assert any("the lowest is at 4 m" in each for each in found_in(tables | {"water": {"level": "3 m"}}))
    assert any("8 m above the ground" in each for each in found_in(tables | {"water": {"table": "12 m"}}))


def test_what_is_told_of_the_water():
    """Under the plain the table is at the surface: 9.81 over 21 kN/m3, 47 % of the weight."""
    assert water_words(load_scene("ma2023")) is None
    table = load_scene("ma2023", [TABLE, "soil.saturated_unit_weight=21 kN/m^3"])
    assert most_carried(table) == pytest.approx(9.81 / 21.0, rel=1e-9)
    assert "from 4 m to 15 m" in water_words(table)
    assert "r_u = 0.25" in water_words(load_scene("ma2023", ["water.r_u=0.25"]))
    lake = water_words(load_scene("ma2023", ["water.level=7 m"]))
    assert "stands at 7 m, at most 3 m deep" in lake
    assert "table is at elevations from 7 m to 7 m; its pore pressure carries at most 49 % of" in lake
    assert "from 4 m to 19 m" in water_words(load_scene("ma2023", ["water.level=20 m"]))


def test_surfaces_that_end_in_a_face_keep_it():
    cliff = Surface(np.array([0.0, 2.0, 2.0, 4.0]), np.array([5.0, 5.0, 1.0, 1.0]))
    level = across([[0.0, 3.0]], 4.0)
    lower = lower_of(cliff, level)
    np.testing.assert_allclose(lower.height_at(np.array([1.0, 1.999999, 2.0, 3.0])), [3.0, 3.0, 1.0, 1.0])
