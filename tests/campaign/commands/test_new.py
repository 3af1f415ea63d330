"""`campaign new` writes a scene to start from, and never over anything."""

import pytest

from campaign import cli
from campaign.scene import load_scene


@pytest.fixture(autouse=True)
def keep_threads(monkeypatch):
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)


@pytest.mark.parametrize("name", ["my-slope.toml", 'ein "Hang" {x}.toml'])
def test_a_new_scene_is_the_built_in_one_but_for_what_suits_any_slope(tmp_path, name):
    file = tmp_path / name
    assert cli.main(["new", str(file)]) == 0
    scene = load_scene(file)
    other = {"slide.front_area": pytest.approx(2.25), "numerics.filling": "cut"}
    assert scene.identity() == load_scene("ma2023").identity() | other
    assert scene.title == file.stem
    assert f"campaign validate {name}" in scene.text
    assert "# front_area = " in scene.text
    assert "[[receptor]]" in scene.text
    assert not [words for words in ("10,090", "reconstruction, ", "bisected", "0.347") if words in scene.text]


def test_an_existing_file_is_left_as_it_is(tmp_path, capsys):
    file = tmp_path / "my-slope.toml"
    file.write_text("mine")
    assert cli.main(["new", str(file)]) == 2
    assert "exists and is left as it is" in capsys.readouterr().err
    assert file.read_text() == "mine"


@pytest.mark.parametrize(
    ("name", "sentence"), [("my-slope", "give my-slope.toml"), ("absent/my-slope.toml", "give another place")]
)
def test_a_place_that_is_none_is_a_sentence(tmp_path, name, sentence, capsys):
    assert cli.main(["new", str(tmp_path / name)]) == 2
    assert sentence in capsys.readouterr().err
