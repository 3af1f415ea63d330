"""A slide with mean strengths foretells what will hinder a campaign, in seconds on every mesh."""

import re

import pytest

from campaign.record import Status
from campaign.scene import load_scene
from campaign.scene.complaints import sentences
from campaign.scene.cost import realization_seconds
from campaign.scene.first_look import LONGEST_SLIDE, SHORTEST_SLIDE, look_at
from campaign.simulation import trial as trials
from campaign.simulation.trial import foreseen, remarks, trial, with_affordable_cells

COARSE = "numerics.cell=2 m"


def tried(*overrides):
    scene = load_scene("ma2023", [COARSE, *overrides])
    return scene, trial(scene, look_at(scene))


@pytest.mark.parametrize(("cell", "times"), [("2 m", 1), ("1 m", 1), ("0.25 m", 3), ("0.1 m", 6)])
def test_cells_are_as_much_larger_as_a_trial_must_be_faster(cell, times):
    scene = load_scene("ma2023", [f"numerics.cell={cell}"])
    coarse = with_affordable_cells(scene, look_at(scene))
    assert coarse.numerics.cell == pytest.approx(times * scene.numerics.cell)
    assert realization_seconds(coarse) < 1.2 * trials.AFFORDABLE


def test_a_slope_too_low_for_affordable_cells_is_not_tried():
    low = load_scene("ma2023", ["geometry.slope.height=2 m", "numerics.cell=0.1 m", "geometry.slope.plain=2000 m"])
    assert with_affordable_cells(low, look_at(low)) is None
    assert trial(low, look_at(low)) is None


def test_a_trial_has_the_run_out_of_the_deterministic_run():
    """10.8 m with cells of 2 m, as with those of 1 m."""
    _, made = tried()
    assert made.record.status is Status.slid
    assert made.runout == pytest.approx(10.84, abs=0.1)
    assert made.front == pytest.approx(35.0 + made.runout)
    assert remarks(made) == ""


@pytest.mark.parametrize(
    ("plain", "sentence"),
    [("16 m", "and the wall 16 m beyond the toe will hold them back; use at least"), ("40 m", "")],
)
def test_a_wall_is_foreseen_that_only_farther_slides_reach(plain, sentence):
    scene, made = tried(f"geometry.slope.plain={plain}")
    assert sentence in "".join(sentences(foreseen(scene, look_at(scene), made), scene))
    assert bool(foreseen(scene, look_at(scene), made)) == bool(sentence)


def test_a_wall_that_was_reached_is_told_once():
    scene, made = tried("geometry.slope.plain=8 m")
    assert foreseen(scene, look_at(scene), made) == []
    assert "reached the wall ahead of it (x = 43 m)" in remarks(made)


def test_a_foundation_too_thin_is_found():
    """Undrained ground slides as deep as it can, here along the fixed base 4 m below the toe."""
    undrained = ["soil.friction_angle.mean=0.1 deg", "soil.friction_angle.residual=0 deg", "soil.cohesion.mean=30 kPa"]
    _, made = tried(*undrained, "geometry.slope.angle=25 deg", "geometry.slope.crest=40 m")
    assert "slip surface runs along the fixed base under" in remarks(made)


def test_a_trial_that_takes_too_long_is_given_up(monkeypatch):
    monkeypatch.setattr(trials, "PATIENCE", 0.0)
    assert tried()[1] is None


FAN = 'geometry={surface=[["0 m","32 m"],["30 m","32 m"],["60 m","17 m"],["180 m","6.5 m"]], toe="60 m"}'
WEAK = ["soil.cohesion.mean=14 kPa", "soil.cohesion.residual=7 kPa", "soil.friction_angle.residual=8 deg"]
CLAY = ["soil.friction_angle.mean=12 deg", "soil.softening.slip_to_residual=1 m", *WEAK]


def test_slides_on_a_gentle_fan_take_long():
    """A fan that falls by 5 degrees hardly brakes: 8 sqrt(H / g), enough on level ground, is 9.9 s."""
    scene = load_scene("ma2023", [FAN, *CLAY, "numerics.cell=3 m", "numerics.end_time=40 s"])
    look = look_at(scene)
    made = trial(scene, look)
    assert SHORTEST_SLIDE * look.time_scale < made.rest < LONGEST_SLIDE * look.time_scale
    assert made.rest > 10.5
    assert foreseen(scene, look_at(scene), made) == []


@pytest.mark.parametrize(
    ("end", "sentence"),
    [("4 s", 'still moves then, .* use "23 s"'), ("9 s", 'takes 8.1 s to come to rest, .* use "17 s"')],
)
def test_an_end_before_the_slides_is_foreseen(end, sentence):
    scene, made = tried(f"numerics.end_time={end}")
    (warning,) = sentences(foreseen(scene, look_at(scene), made), scene)
    assert re.search(sentence, warning)
