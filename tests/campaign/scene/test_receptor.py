"""A receptor is a place on the ground, written under [[receptor]]."""

from pathlib import Path

import pytest
from scene_complaints import EXAMPLE, SURFACE, complaint, complaints, found_in, line_of

from campaign.errors import SceneError
from campaign.scene import differences, load_scene, scene_of

ROAD = '\n[[receptor]]\nname = "road"\nx = "42 m"\n'
HOUSE = '\n[[receptor]]  # above the toe\nname = "house"\nx = ["30 m", "33.5 m"]\n'


def with_receptors(directory: Path, text: str) -> Path:
    path = directory / "slope.toml"
    path.write_text(EXAMPLE.text + text, "utf-8")
    return path


def test_receptors_are_set_one_by_one_or_all_at_once(tmp_path: Path) -> None:
    """Numbers count from 1, as messages do."""
    scene = with_receptors(tmp_path, ROAD + HOUSE)
    road, house = load_scene(scene, ["receptor.1.x=43 m"]).receptor
    assert (road.x, house.x) == ((43.0, 43.0), (30.0, 33.5))
    (road,) = load_scene(scene, ['receptor=[{name="road", x="43 m"}]']).receptor
    assert road.x == (43.0, 43.0)
    with pytest.raises(SceneError, match=r"receptor.3.x: receptor is a list of 2; set one .*, for instance --set 'rec"):
        load_scene(scene, ["receptor.3.x=43 m"])
    assert complaint("receptor.1.x=43 m").startswith("--set receptor.1.x: the scene has no [[receptor]]; set all of it")


def test_an_override_of_one_receptor_is_the_place_of_its_mistake(tmp_path: Path) -> None:
    scene = with_receptors(tmp_path, ROAD + HOUSE)
    assert complaint("receptor.2.x=99 m", source=scene).startswith('--set receptor.2.x is "99 m", but it must lie')
    line = line_of("[[receptor]]", scene)
    assert f"receptor.x (slope.toml, line {line + 2}, receptor 1)" in complaint(
        "receptor.2.x=31 m", "geometry.slope.plain=5 m", source=scene
    )


def test_a_place_is_a_range_without_length(tmp_path: Path) -> None:
    road, house = load_scene(with_receptors(tmp_path, ROAD + HOUSE)).receptor
    assert (road.name, road.x) == ("road", (42.0, 42.0))
    assert (house.name, house.x) == ("house", (30.0, 33.5))


def test_receptors_decide_what_is_measured_and_scenes_without_are_what_they_were() -> None:
    plain, watched = scene_of(EXAMPLE.text), scene_of(EXAMPLE.text + ROAD)
    assert not any(key.startswith("receptor") for key in plain.identity())
    assert watched.identity()["receptor.0.x"] == [42.0, 42.0]
    assert plain.digest() == load_scene("ma2023").digest() != watched.digest()


def test_differing_receptors_are_told_in_their_units() -> None:
    here, there = (scene_of(EXAMPLE.text + text).identity() for text in (ROAD, ROAD.replace("42", "43.5")))
    assert differences(here, there) == [
        'receptor.1.x is ["42 m", "42 m"] here but ["43.5 m", "43.5 m"] in the results directory'
    ]
    assert differences(scene_of(EXAMPLE.text).identity(), here)[0].startswith("receptor.1.name is absent here but road")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            'name = "river"\nx = 42',
            "x (slope.toml, line {x}, receptor 2) is 42, but a length needs its unit and quotes",
        ),
        ('name = "river"\nx = "42 kPa"', "but that is a pressure, and a length is needed"),
        ('name = "river"\nx = "1e999 m"', "a finite number is needed"),
        ('name = "river"\nx = ["46 m", "40 m"]', 'is ["46 m", "40 m"], but the range must increase'),
        ('name = "river"\nx = ["40 m", "40 m"]', "or a single place without brackets"),
        ('name = "river"\nx = ["40 m"]', "or both ends of a range"),
        ('name = "river"\nx = "75 m"', 'x (slope.toml, line {x}, receptor 2) is "75 m", but it must lie between'),
        ('name = "river"\nx = ["-1 m", "3 m"]', "; move it, or add ground behind the crest, and as much to every x."),
        ('name = "road"\nx = "43 m"', 'is "road", but receptor 1 has that name, too.'),
        ('name = " "\nx = "43 m"', "it must be a line of text"),
        ('x = "43 m"', 'line {head}, receptor 2) has no name; add it, for instance name = "road".'),
        ('name = "river"', 'receptor 2) has no x; add it, for instance x = "42 m".'),
        ('name = "river"\nx = "43 m"\nwidth = "2 m"', 'there is no key "width"; the keys here are name, x.'),
        ('nam = "river"\nx = "43 m"', 'there is no key "nam"; did you mean "name"?'),
    ],
)
def test_a_mistake_names_the_receptor_and_its_line(text: str, expected: str, tmp_path: Path) -> None:
    path = with_receptors(tmp_path, f"{ROAD}\n[[receptor]]\n{text}\n")
    lines = path.read_text("utf-8").split("\n")
    last = {name: max(n for n, line in enumerate(lines, 1) if line.startswith(name)) for name in ("x", "[[receptor]]")}
    assert expected.format(x=last["x"], head=last["[[receptor]]"]) in complaint(source=path)


def test_every_receptor_off_the_ground_is_named(tmp_path: Path) -> None:
    path = with_receptors(tmp_path, ROAD.replace("42", "80") + HOUSE.replace("33.5", "99"))
    lines = [line_of(text, path) for text in ('x = "80 m"', 'x = ["30 m"')]
    assert [message.split(" is ")[0] for message in complaints(source=path)] == [
        f"receptor.x (slope.toml, line {line}, receptor {number})" for number, line in enumerate(lines, 1)
    ]


def test_other_mistakes_hide_no_receptor_off_the_ground(tmp_path: Path) -> None:
    """A receptor with a mistake of its own, one without a name, and a foundation without a unit."""
    school = ROAD.replace("42", "80").replace("road", "school")
    path = with_receptors(tmp_path, f'{ROAD}colour = 3\n{school}[[receptor]]\nx = "90 m"\n')
    told = complaints("geometry.slope.foundation=4", source=path)
    assert len(told) == 5
    assert [each for each in told if "must lie between the walls" in each] == [
        f"receptor.x (slope.toml, line {line_of(f'x = {place}', path)}, receptor {number}) is {place}, but it must lie "
        "between the walls, at 0 m and 75 m; move it, or lengthen geometry.slope.plain."
        for number, place in ((2, '"80 m"'), (3, '"90 m"'))
    ]


def test_walls_of_a_surface_bound_receptors_as_well() -> None:
    receptor = {"receptor": [{"name": "road", "x": "74 m"}]}
    tables = EXAMPLE.tables | {"geometry": {"surface": SURFACE}}
    assert found_in(tables | receptor) == []
    receptor["receptor"][0]["x"] = "75.5 m"
    assert "at 0 m and 75 m; move it, or continue the surface." in found_in(tables | receptor)[0]


def test_one_pair_of_brackets_is_explained(tmp_path: Path) -> None:
    path = with_receptors(tmp_path, ROAD.replace("[[receptor]]", "[receptor]"))
    assert "it must be written under a line [[receptor]], with two brackets" in complaint(source=path)


@pytest.mark.parametrize("junk", [5, "road", [5], [[]], [{}], [{"name": 3, "x": [3]}], [{"x": {"y": 1}}, "a"], {}])
def test_whatever_is_written_the_answer_is_sentences(junk: object) -> None:
    messages = found_in(EXAMPLE.tables | {"receptor": junk})
    assert messages
    assert all(message.endswith(".") for message in messages)


def test_receptors_can_be_set_on_the_command_line() -> None:
    road = 'receptor=[{name = "road", x = "42 m"}]'
    assert load_scene("ma2023", [road]).receptor[0].x == (42.0, 42.0)
    assert complaint(road.replace("42", "90")).startswith("--set receptor, receptor 1 is")
