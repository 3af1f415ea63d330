"""What gives slides more ground is told in the keys of the scene's own geometry, and what moves with it."""

import pytest

from campaign.scene import load_scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.more_ground import ahead, behind_crest, below

SURFACE = 'surface=[["0 m","16 m"],["8 m","16 m"],["20 m","4 m"],["40 m","4 m"]]'
ROAD = 'receptor=[{name="road", x="38 m"}]'


@pytest.mark.parametrize(
    ("overrides", "longer"),
    [
        ([], "lengthen geometry.slope.crest, for instance by 15 m, which moves the toe from x = 35 m to 50 m"),
        (
            [ROAD],
            "lengthen geometry.slope.crest, for instance by 15 m, which moves the toe from x = 35 m to 50 m; add 15 m "
            "to the x of each receptor",
        ),
        (
            [ROAD, 'boring=[{name="B1", x="30 m", cohesion=[["1 m", "20 kPa"]]}]'],
            "lengthen geometry.slope.crest, for instance by 15 m, which moves the toe from x = 35 m to 50 m; add 15 m "
            "to the x of each receptor; add 15 m to the x of each boring",
        ),
        (
            [f"geometry={{{SURFACE}}}"],
            "add ground on the left of geometry.surface, for instance 12 m of it: another point at x = 0 m, and 12 m "
            "more in the x of all others",
        ),
        (
            [f'geometry={{{SURFACE}, toe="20 m"}}', ROAD],
            "add ground on the left of geometry.surface, for instance 12 m of it: another point at x = 0 m, and 12 m "
            "more in the x of all others, in geometry.toe and in the x of each receptor",
        ),
    ],
)
def test_ground_behind_the_crest_moves_every_x(overrides, longer):
    """x counts from the wall behind the crest; as much ground as the slope is high is named."""
    assert behind_crest(load_scene("ma2023", overrides)) == longer


def test_layers_and_water_move_with_the_ground():
    """Tops and tables from wall to wall have their ends and their x, and all elevations count from the base."""
    layers = 'layer=[{name="clay", top=[["0 m","9 m"],["35 m","6 m"],["75 m","6 m"]]}, {name="till", top="2 m"}]'
    water = 'water={table=[["0 m","13 m"],["35 m","4 m"],["75 m","4 m"]], level="5 m"}'
    boring = 'boring=[{name="B1", x="10 m", by="elevation", cohesion=[["12 m", "20 kPa"]]}]'
    scene = load_scene("ma2023", [layers, water, boring])
    assert behind_crest(scene).endswith(
        "; add 15 m to the x of each boring; add 15 m to the x of each point of layer.1.top; add 15 m to the x of each "
        "point of water.table"
    )
    assert ahead(scene) == "lengthen geometry.slope.plain, and layer.1.top and water.table with it"
    assert below(scene).endswith(
        "foundation, with as much added to the elevation of each layer's top, water.table, water.level and the data of "
        "each boring"
    )
    by_depth = load_scene("ma2023", ['layer=[{name="clay", depth="3 m"}]', "water.r_u=0.3"])
    assert below(by_depth) == "deepen geometry.slope.foundation"


def test_a_scene_is_told_its_own_keys_alone():
    slope, profile = load_scene("ma2023"), load_scene("ma2023", [f"geometry={{{SURFACE}}}"])
    assert ahead(slope) == "lengthen geometry.slope.plain"
    assert ahead(profile) == "continue geometry.surface beyond x = 40 m"
    assert "geometry.slope.foundation" in below(slope)
    for remedy in (behind_crest, ahead, below):
        assert "geometry.surface" not in remedy(slope)
        assert "geometry.slope" not in remedy(profile)


def test_the_toe_is_where_the_remedy_says():
    assert "to 50 m" in behind_crest(load_scene("ma2023"))
    assert surface_of(load_scene("ma2023", ["geometry.slope.crest=35 m"]).geometry).toe_x == pytest.approx(50.0)
