"""A scene is read from a file or a name, with overrides, and keeps what it was read from."""

import copy
import pickle
from pathlib import Path

import pytest
from scene_complaints import EXAMPLE, complaint, found_in, written

from campaign.errors import SceneError
from campaign.scene import load_scene
from campaign.scene.document import key_lines


def test_a_scene_keeps_its_name_text_and_overrides_and_survives_pickling(tmp_path: Path) -> None:
    path = written(tmp_path)
    scene = load_scene(path, ["numerics.cell=0.5 m"])
    assert (scene.name, scene.text, scene.overrides) == ("slope", EXAMPLE.text, ("numerics.cell=0.5 m",))
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_a_byte_order_mark_and_windows_line_ends_do_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "slope.toml"
    path.write_bytes(EXAMPLE.text.replace("\n", "\r\n").encode("utf-8-sig"))
    assert load_scene(path).digest() == load_scene("ma2023").digest()


@pytest.mark.parametrize("value", ["0.5 m", '"0.5 m"', "50 cm", " 0.5 m "])
def test_overrides_work_with_and_without_the_quotes_a_shell_strips(value: str) -> None:
    assert load_scene("ma2023", [f"numerics.cell={value}"]).numerics.cell == 0.5


def test_the_last_of_two_overrides_wins() -> None:
    assert load_scene("ma2023", ["campaign.seed=1", "campaign.seed=2"]).campaign.seed == 2


def test_only_the_required_keys_need_to_be_written() -> None:
    tables = copy.deepcopy(EXAMPLE.tables)
    for section, kept in {"numerics": {"cell", "end_time"}, "campaign": set()}.items():
        tables[section] = {key: value for key, value in tables[section].items() if key in kept}
    for key in ("sampler", "resolution", "angle", "cross_correlation_of"):
        del tables["field"][key]
    assert found_in(tables) == []


def test_an_unknown_scene_lists_the_built_in_ones() -> None:
    message = complaint(source="ma2032")
    assert message.startswith(
        '"ma2032" is neither a file nor a built-in scene; built in are bui2008, drawdown, layered'
    )
    assert message.endswith('Did you mean "ma2023"?')


def test_a_file_that_is_not_text_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "slope.toml"
    path.write_bytes(b"title = '\xff\xfe'")
    assert "cannot be read" in complaint(source=path)


def test_the_line_of_a_key_is_found_among_sections_arrays_and_comments() -> None:
    text = 'title = "a"\n[geometry] # [soil]\nsurface = [\n  ["0 m", "1 m"],\n]\n'
    text += '[ soil . cohesion ]\n"mean" = 1\na.b = 2\n'
    assert key_lines(text) == {
        ("title",): 1,
        ("geometry",): 2,
        ("geometry", "surface"): 3,
        ("soil",): 6,
        ("soil", "cohesion"): 6,
        ("soil", "cohesion", "mean"): 7,
        ("soil", "cohesion", "a"): 8,
        ("soil", "cohesion", "a", "b"): 8,
    }


@pytest.mark.parametrize("line_break", ["\n", "\r\n", "\n\n\n"])
def test_an_override_is_one_line_however_it_was_given(line_break: str) -> None:
    """The dataset tells each on a line of its own, from which the report reads them again."""
    scene = load_scene("ma2023", [f"soil.cohesion.mean={line_break}21 kPa", f"campaign.seed=7{line_break}"])
    assert (scene.soil.cohesion.mean, scene.campaign.seed) == (21e3, 7)
    again = load_scene("ma2023", "\n".join(scene.overrides).split("\n"))
    assert again.digest() == scene.digest()


def test_a_title_is_a_line() -> None:
    with pytest.raises(SceneError, match="title"):
        load_scene("ma2023", ['title="\\u001b[2J"'])
