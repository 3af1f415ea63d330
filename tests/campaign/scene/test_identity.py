"""What decides a realization is the identity of its scene; how it is written is not."""

import json

import pytest
from scene_complaints import EXAMPLE, SURFACE

from campaign.scene import Scene, differences, load_scene


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


def test_differences_are_sentences() -> None:
    here = {"numerics.cell": 0.5, "campaign.seed": 1, "field.resolution": 0.25}
    there = {"numerics.cell": 1.0, "campaign.seed": 1}
    assert differences(here, there) == [
        "field.resolution is 0.25 here but absent in the results directory",
        "numerics.cell is 0.5 here but 1.0 in the results directory",
    ]
    assert differences(here, here) == []
