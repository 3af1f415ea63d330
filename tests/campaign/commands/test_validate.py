"""`campaign validate` is a first look, and refuses what `campaign run` refuses."""

import re

import pytest

from campaign import cli
from campaign.commands import run as run_command
from campaign.running import launcher


@pytest.fixture(autouse=True)
def keep_threads(monkeypatch):
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)


def answer(capsys, *arguments):
    code = cli.main(["validate", *arguments, "--quick"])
    return code, capsys.readouterr()


def test_a_scene_is_looked_at(capsys):
    code, printed = answer(capsys, "ma2023")
    assert code == 0
    flat = " ".join(printed.out.split())
    for part in (
        "toe At x = 35 m, elevation 4 m: the foot of the slope.",
        "factor of safety 0.73 with the mean peak strength on a circle from x = 14.1 m to 35 m",
        "0.37 with the residual strength",
        "Nearly every realization slides.",
        "after 6.7 to 22 s, half of them before 10 s. The run ends at 10 s.",
        "300 x 76 points, 0.25 m apart",
        "core-hours for all 1,000, with 8 repeated",
        "for each rank (process); the results take",
    ):
        assert part in flat
    assert "Warning" not in flat


def test_a_profile_is_told_where_its_toe_was_found(capsys):
    surface = 'geometry.surface=[["0 m","19 m"],["20 m","19 m"],["35 m","4 m"],["75 m","4 m"]]'
    _, printed = answer(capsys, "ma2023", "--set", "geometry={}", "--set", surface)
    assert "x = 35 m, elevation 4 m: the foot of the slope, of all its faces" in " ".join(printed.out.split())
    _, printed = answer(capsys, "ma2023", "--set", "geometry={}", "--set", surface, "--set", "geometry.toe=30 m")
    assert "x = 30 m, elevation 9 m: as given." in " ".join(printed.out.split())


def test_a_warning_shows_the_value_in_the_users_unit(capsys):
    code, printed = answer(capsys, "ma2023", "--set", "soil.cohesion.mean=25 MPa")
    assert code == 0
    assert 'Warning: --set soil.cohesion.mean is "25 MPa", but' in printed.out


RECEPTORS = 'receptor=[{name="road", x="40 m"}, {name="house", x="60 m"}, {name="barn", x="55 m"}]'


SMALL_FRONT = 'Warning: slide.front_area (ma2023.toml, line 80) is "0.25 m^2", but the front then leaves'
"""What is said of ma2023 in cells of 2 m, whatever else is changed."""


def tried(capsys, *overrides):
    options = [f"--set={override}" for override in ("numerics.cell=2 m", *overrides)]
    assert cli.main(["validate", "ma2023", *options]) == 0
    return " ".join(capsys.readouterr().out.split())


def test_the_slide_with_mean_strengths_says_whom_it_reaches(capsys):
    printed = tried(capsys, RECEPTORS)
    assert "comes to rest after 8.1 s; its front is 10.8 m beyond the toe, at x = 45.84 m." in printed
    assert "It reaches road (x = 40 m), not house (x = 60 m) and barn (x = 55 m). Simulated in cells of 2 m." in printed
    assert printed.count("Warning") == printed.count(SMALL_FRONT) == 1


def test_what_a_slide_has_shown_is_not_guessed(capsys):
    """By experience a plain of 18 m is too short for a slope of 15 m; this slide has come 11 m far."""
    short = ["geometry.slope.plain=18 m"]
    assert tried(capsys, *short).count("Warning") == 1
    printed = answer(capsys, "ma2023", f"--set={short[0]}")[1].out
    assert "Warning: --set geometry.slope.plain" in printed


def test_a_slope_that_stands_is_said_to_stand(capsys):
    """What time slides take is told as if there was one."""
    printed = tried(capsys, "soil.cohesion.mean=45 kPa")
    assert "The slope stands: nothing moves farther than 0.0" in printed
    assert "The run ends at 10 s. Should the slope slide all the same: comparable slides come to rest after" in printed
    assert "time Comparable slides" not in printed


def test_a_slide_at_a_wall_is_told_as_a_lower_bound_with_the_key_that_moves_the_wall(capsys):
    """Without the wall its front stops 10.8 m beyond the toe."""
    printed = tried(capsys, "geometry.slope.plain=8 m")
    assert re.search(
        r"its front is at least \d\.\d+ m beyond the toe, at x = 4\d\.?\d* m, and the wall ahead stopped it\.",
        printed,
    )
    reached = "Warning: The slide has reached the wall ahead of it (x = 43 m): its run-out is a lower bound."
    assert f"{reached} Lengthen geometry.slope.plain." in printed
    profile = 'geometry={surface=[["0 m","19 m"],["20 m","19 m"],["35 m","4 m"],["43 m","4 m"]]}'
    road = 'receptor=[{name="road", x="40 m"}, {name="house", x="42.9 m"}]'
    printed = tried(capsys, profile, road)
    assert "It reaches road (x = 40 m), by then not house (x = 42.9 m)." in printed
    assert f"{reached} Continue geometry.surface beyond x = 43 m." in printed
    assert "geometry.slope" not in printed


def test_a_slide_that_still_moves_is_told_as_a_lower_bound(capsys):
    printed = tried(capsys, "numerics.end_time=4 s")
    assert "The slope slides and still moves at the end of the run; its front is at least" in printed


def test_too_few_realizations_are_told_where_they_are_what_ends_the_campaign(capsys):
    few = ["--set", "campaign.realizations=20"]
    assert "At most 20 realizations cannot converge" in answer(capsys, "ma2023", *few)[1].out
    assert "cannot converge" not in answer(capsys, "ma2023", *few, "--accuracy", "3 %")[1].out


NOT_RUN = [
    "field.resolution=1 mm",
    "field.resolution=1e-8 m",
    "numerics.cell=1e-6 m",
    "geometry.slope.plain=1e9 m",
    "numerics.output_interval=1e-9 s",
    "numerics.flip=0.9",
    'geometry={surface=[["0 m","19 m"],["0 m","4 m"]]}',
]


@pytest.mark.parametrize("override", NOT_RUN)
@pytest.mark.parametrize("command", ["validate", "run"])
def test_what_cannot_be_run_is_refused_alike(command, override, capsys, monkeypatch):
    monkeypatch.setattr(run_command, "_run_on_ranks", lambda *_: pytest.fail("it was begun"))
    for name in launcher.SIZES:
        monkeypatch.delenv(name, raising=False)
    assert cli.main([command, "ma2023", "--set", override]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "geometry" in printed.err or override.partition("=")[0] in printed.err


def test_layers_are_told_in_a_table(capsys):
    assert cli.main(["validate", "layered", "--quick"]) == 0
    printed = capsys.readouterr().out
    (sand,) = [line.split() for line in printed.split("\n") if line.strip().startswith("soil ")]
    assert sand[1:6] == ["0", "to", "7.9", "m", "19"]
    assert "44 kPa (25 %)" in printed
    in_one_line = " ".join(printed.split())
    assert "Soil and soft clay: exponential: 95 %" in in_one_line
    assert "till: none: strength stays at its peak." in in_one_line
