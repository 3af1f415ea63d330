"""The ground is a slope or a surface, and suits the cells."""

import json

import pytest
from scene_complaints import EXAMPLE, SURFACE, complaint, found_in

from campaign.scene import load_scene


def test_a_surface_can_replace_the_slope() -> None:
    tables = EXAMPLE.tables | {"geometry": {"surface": SURFACE}}
    assert found_in(tables) == []


def test_slope_and_surface_contradict_each_other() -> None:
    message = complaint(f"geometry.surface={json.dumps(SURFACE)}")
    assert "geometry.slope (ma2023.toml, line" in message
    assert "and --set geometry.surface contradict each other; remove one of them." in message


def test_a_slope_or_a_surface_is_needed() -> None:
    assert "geometry.slope (scene.toml) is not given" in found_in(EXAMPLE.tables | {"geometry": {}})[0]


@pytest.mark.parametrize(
    ("surface", "expected"),
    [
        ([], "have two points or more"),
        ([["0 m", "19 m"]], "have two points or more"),
        (
            [["1 m", "19 m"], ["20 m", "4 m"]],
            "start at x = 0: take its first x off all x, of toe and",
        ),
        ([["0 m", "19 m"], ["20 m", "4 m"], ["10 m", "4 m"]], "go from left to right, and point 3, x = 10 m, lies"),
        ([["0 m", "19 m"], ["20 m", "-1 m"]], "stay above the base"),
        ([["0 m", "4 m"], ["20 m", "19 m"]], "descend to the right somewhere"),
    ],
)
def test_a_surface_falls_from_left_to_right_above_the_base(surface: list[list[str]], expected: str) -> None:
    (message,) = found_in(EXAMPLE.tables | {"geometry": {"surface": surface}})
    assert f"it must {expected}" in message


def test_a_surface_may_have_a_vertical_face() -> None:
    surface = [["0 m", "9 m"], ["5 m", "9 m"], ["5 m", "4 m"], ["20 m", "4 m"]]
    assert found_in(EXAMPLE.tables | {"geometry": {"surface": surface}}) == []


def test_a_slope_that_just_fits_its_cells_is_accepted() -> None:
    load_scene("ma2023", ["geometry.slope.height=4 m", "geometry.slope.crest=2 m"])


def test_a_wrong_point_is_named_by_its_number() -> None:
    surface = [*SURFACE[:2], ["35 m", 4], ["75 m"], ["1 m", "2 m", "3 m"]]
    unit, short, long = found_in(EXAMPLE.tables | {"geometry": {"surface": surface}})
    assert "point 3) is 4, but a length needs its unit" in unit
    assert 'point 4) is ["75 m"], but a point has two coordinates' in short
    assert "point 5)" in long
    assert "a point has two coordinates" in long


def test_a_surface_too_flat_for_its_cells_is_refused() -> None:
    (message,) = found_in(
        EXAMPLE.tables | {"geometry": {"surface": [["0 m", "6 m"], ["20 m", "4 m"], ["40 m", "4 m"]]}}
    )
    assert "numerics.cell" in message
    assert "a slope of 2 m must be at least 4 cells high; use at most 0.5 m" in message


VALLEY = [["0 m", "10 m"], ["10 m", "10 m"], ["16 m", "4 m"], ["40 m", "4 m"], ["60 m", "25 m"]]


def test_a_valley_may_have_a_far_side_higher_than_the_crest() -> None:
    assert found_in(EXAMPLE.tables | {"geometry": {"surface": VALLEY}}) == []


@pytest.mark.parametrize("toe", ["16 m", "20 m"])
def test_the_toe_of_a_surface_can_be_given(toe: str) -> None:
    assert found_in(EXAMPLE.tables | {"geometry": {"surface": VALLEY, "toe": toe}}) == []


@pytest.mark.parametrize("toe", ["1 m", "59 m", "60 m", "75 m"])
def test_a_toe_on_a_wall_is_refused(toe: str) -> None:
    (message,) = found_in(EXAMPLE.tables | {"geometry": {"surface": VALLEY, "toe": toe}})
    assert "geometry.toe" in message
    assert f'is "{toe}", but a slide must begin and end between the walls, at 0 m and 60 m' in message


def test_a_slope_that_ends_at_the_wall_is_refused() -> None:
    (message,) = found_in(EXAMPLE.tables | {"geometry": {"surface": [["0 m", "19 m"], ["20 m", "4 m"]]}})
    assert "the foot of its slope, x = 20 m, lies on a wall" in message


def test_the_toe_of_a_slope_is_not_given_again() -> None:
    assert "leave it out" in complaint("geometry.toe=30 m")
