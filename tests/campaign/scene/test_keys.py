"""The reference of keys is that of the model."""

from pathlib import Path

from campaign.scene.keys import REQUIRED, keys, markdown
from campaign.scene.loading import load_scene
from campaign.scene.scene import flatten


def test_readme_lists_the_keys_of_the_model() -> None:
    text = (Path(__file__).parents[3] / "README.md").read_text()
    begin, end = "<!-- keys: from the model -->\n", "\n<!-- keys end -->"
    assert text[text.index(begin) + len(begin) : text.index(end)] == markdown()


def test_every_key_of_a_scene_is_listed() -> None:
    """Those of a built-in scene, but for correlations of pairs, which are keys by their properties."""
    scene = load_scene("ma2023").model_dump(
        exclude={"name", "text", "overrides", "receptor", "layer", "boring"}, mode="json"
    )
    scene["field"].pop("pairs")
    scene["geometry"].pop("slope")
    listed = {key.name for key in keys()}
    assert set(flatten(scene)) <= listed
    assert {key.name for key in keys() if key.left_out == REQUIRED} >= {"title", "field.length_kind", "receptor.x"}
