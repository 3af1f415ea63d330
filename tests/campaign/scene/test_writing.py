"""A scene that is written out again is the same scene."""

import pytest

from campaign.scene import load_scene
from campaign.scene.loading import scene_of
from campaign.scene.writing import toml_of

NAMED = 'receptor=[{name = "a \\"road\\" – Straße", x = "46 m"}, {name = "house", x = ["48 m", "50 m"]}]'
PROFILE = 'geometry={surface = [["0 m", "19 m"], ["20 m", "19 m"], ["35 m", "4 m"], ["75 m", "4 m"]]}'
SLIP = "soil.softening.slip_to_residual=0.3 m"
PAIRS = ["soil.cohesion.residual_cov=0.1", "field.pairs={cohesion = {cohesion_residual = 0.5}}"]


@pytest.mark.parametrize("name", ["ma2023", "ma2023-printed", "bui2008"])
def test_a_built_in_scene(name):
    scene = load_scene(name)
    again = scene_of(toml_of(scene))
    assert again.identity() == scene.identity()
    assert again.campaign == scene.campaign


@pytest.mark.parametrize("overrides", [[NAMED], [PROFILE], [SLIP], PAIRS, ["soil.cohesion.cov=1e-06"]])
def test_with_its_overrides(overrides):
    scene = load_scene("ma2023", overrides)
    assert scene_of(toml_of(scene)).identity() == scene.identity()


def test_without_an_override():
    scene = load_scene("ma2023", ["campaign.realizations=7", "campaign.seed=7"])
    again = scene_of(toml_of(scene, frozenset({"campaign.realizations"})))
    assert (again.campaign.realizations, again.campaign.seed) == (1000, 7)
