"""What decides a realization is the identity of its scene; how it is written is not."""

import json

import pytest
from scene_complaints import EXAMPLE, SURFACE

from campaign.scene import Scene, differences, load_scene
from campaign.scene.document import in_force


def test_what_decides_a_realization_changes_its_identity() -> None:
    digest = load_scene("ma2023").digest()
    for override in ("numerics.cell=0.5 m", "soil.cohesion.mean=21 kPa", "campaign.seed=1", "field.angle=1 deg"):
        assert load_scene("ma2023", [override]).digest() != digest


@pytest.mark.parametrize(
    "override",
    [
        "title=other",
        "campaign.realizations=10",
        "campaign.minimum=20",
        "campaign.realization_timeout=2 h",
        "campaign.confidence=0.9",
        "campaign.slide_probability_tolerance=0.05",
        "slide.front=tip",
        "numerics.cell=100 cm",
        "numerics.flip=1",
    ],
)
def test_stopping_rules_and_ways_of_writing_leave_the_identity(override: str) -> None:
    assert load_scene("ma2023", [override]).digest() == load_scene("ma2023").digest()


def test_the_identity_survives_json_bit_for_bit() -> None:
    scene = Scene.model_validate(
        EXAMPLE.tables | {"geometry": {"surface": SURFACE}, "name": "a", "text": "", "overrides": ()}
    )
    assert json.loads(json.dumps(scene.identity())) == scene.identity()
    assert scene.identity()["geometry.surface"][0] == [0.0, 19.0]


def test_differences_are_told_in_the_units_of_people() -> None:
    there = load_scene("ma2023").identity()
    changed = ["soil.cohesion.mean=25 kPa", "soil.friction_angle.mean=0.2 rad", "campaign.seed=1"]
    here = load_scene("ma2023", changed).identity()
    assert differences(here, there) == [
        "campaign.seed is 1 here but 2023 in the results directory",
        "soil.cohesion.mean is 25 kPa here but 20 kPa in the results directory",
        "soil.friction_angle.mean is 11.4592 deg here but 10 deg in the results directory",
    ]
    assert differences(here, here) == []


def test_what_one_scene_has_and_the_other_has_not_is_absent() -> None:
    here = json.loads(json.dumps({"geometry.surface": [[0.0, 19.0], [20.0, 4.0]]}))
    assert differences(here, {"field.resolution": 0.25}) == [
        "field.resolution is absent here but 0.25 m in the results directory",
        'geometry.surface is [["0 m", "19 m"], ["20 m", "4 m"]] here but absent in the results directory',
    ]


def test_values_that_look_alike_are_told_apart() -> None:
    here, there = {"soil.cohesion.mean": 20000.000000001}, {"soil.cohesion.mean": 20000.0}
    assert differences(here, there) == [
        "soil.cohesion.mean is 20000.000000001 here but 20000.0 in the results directory"
    ]


@pytest.mark.parametrize(
    ("overrides", "kept"),
    [
        (["a=1", "b=2", "a=3"], ["b=2", "a=3"]),
        (["a.b=1", "a={b=2}", "a.b=3"], ["a={b=2}", "a.b=3"]),
        ([], []),
    ],
)
def test_an_override_that_a_later_one_replaces_is_forgotten(overrides: list[str], kept: list[str]) -> None:
    assert in_force(overrides) == kept


def test_a_front_area_left_out_grows_with_the_slope_and_not_with_the_cells() -> None:
    """The square of a tenth of the height, the same on every mesh; it is part of the identity as if it were written."""
    tables = EXAMPLE.tables | {"slide": {}, "name": "a", "text": ""}
    slope = tables["geometry"]["slope"] | {"height": "30 m"}
    fine = tables["numerics"] | {"cell": "0.5 m"}
    scenes = [tables, tables | {"numerics": fine}, tables | {"geometry": {"slope": slope}}]
    areas = [Scene.model_validate(each).identity()["slide.front_area"] for each in scenes]
    assert areas == pytest.approx([2.25, 2.25, 9.0])
    assert Scene.model_validate(tables | {"slide": {"front_area": "1 m^2"}}).front_area == 1.0
