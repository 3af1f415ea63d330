"""A slide that a wall of the model stops or disturbs, or whose slip surface runs along the base, says so."""

import pytest

from campaign import load_scene
from campaign.record import Status
from campaign.seeds import BASELINE
from campaign.simulation.flags import AHEAD_WALL, CREST_WALL, ON_THE_BASE, with_remedy
from campaign.simulation.ground import prepare

WEAK = ["soil.cohesion.residual=4 kPa", "soil.friction_angle.residual=2 deg"]


def deterministic(*overrides, scene="ma2023"):
    """Return the deterministic run on cells of 1 m."""
    return prepare(load_scene(scene, ["numerics.cell=1 m", *overrides])).simulate(BASELINE)


def test_a_slide_clear_of_the_walls_is_a_slide():
    record = deterministic()
    assert (record.status, record.reason, record.values["reached_wall_behind"]) == (Status.slid, "", 0)
    assert record.values["final_runout"] == pytest.approx(10.90, abs=0.02)
    assert record.values["front_position"][-1] == 35.0 + record.values["final_runout_mass"]


def test_the_printed_plain_of_20_metres_is_long_enough():
    record = deterministic(scene="ma2023-printed")
    assert record.status is Status.slid
    assert record.values["front_position"][-1] == 35.0 + record.values["final_runout"]


@pytest.mark.parametrize(("plain", "runout"), [("8 m", 7.57), ("4 m", 3.78), ("13 m", 10.81)])
def test_a_slide_that_the_wall_ahead_stops_says_so(plain, runout):
    """With a plain of 40 m it runs 10.90 m."""
    record = deterministic(f"geometry.slope.plain={plain}")
    assert record.status is Status.reached_wall
    assert record.values["final_runout"] == pytest.approx(runout, abs=0.02)
    assert record.reason == AHEAD_WALL.format(width=35.0 + float(plain.partition(" ")[0]))


def test_a_slide_that_the_wall_behind_the_crest_disturbs_says_so_and_bounds_nothing_in_front():
    """With a crest of 20 m the same soil runs 18.28 m, with 40 m 18.31 m; other slides run less with more ground."""
    record = deterministic("geometry.slope.crest=4 m", *WEAK)
    assert record.status is Status.slid
    assert record.values["reached_wall_behind"] == 1
    assert record.values["final_runout"] == pytest.approx(11.46, abs=0.02)
    assert record.reason == CREST_WALL


def test_a_slip_surface_along_the_base_is_flagged_and_no_failure():
    """Undrained clay slips as deep as it can: here along the base."""
    clay = [
        "soil.cohesion.mean=45 kPa",
        "soil.cohesion.residual=20 kPa",
        "soil.friction_angle.mean=1 deg",
        "soil.friction_angle.residual=0.5 deg",
    ]
    record = deterministic("geometry.slope.foundation=2 m", "geometry.slope.crest=40 m", *clay)
    assert record.status is Status.slid
    assert record.values["base_contact"] > 0.3
    assert "The slip surface runs along the fixed base under" in record.reason


PROFILE = 'geometry={surface=[["0 m","19 m"],["20 m","19 m"],["35 m","4 m"],["43 m","4 m"]]}'
LEFT = "A particle left the grid on the {side} at 3.90 s; widen the ground there."


@pytest.mark.parametrize(
    ("reason", "key", "point"),
    [
        (CREST_WALL, "Lengthen geometry.slope.crest", "Add ground on the left of geometry.surface"),
        (AHEAD_WALL.format(width=43.0), "Lengthen geometry.slope.plain.", "Continue geometry.surface beyond x = 43 m."),
        (ON_THE_BASE.format(percent=40.0), "Deepen geometry.slope.foundation.", "added to the elevation of each point"),
        (LEFT.format(side="right"), "Lengthen geometry.slope.plain.", "Continue geometry.surface beyond x = 43 m."),
        (LEFT.format(side="left"), "Lengthen geometry.slope.crest", "Add ground on the left of geometry.surface"),
    ],
)
def test_what_can_be_done_about_it_is_told_in_the_keys_of_the_scene(reason, key, point):
    for scene, remedy, other in (
        (load_scene("ma2023"), key, "geometry.surface"),
        (load_scene("ma2023", [PROFILE]), point, "geometry.slope"),
    ):
        told = with_remedy(reason, scene)
        assert told.startswith(f"{reason} ")
        assert remedy in told
        assert other not in told
    assert with_remedy("A particle has no mass.", load_scene("ma2023")) == "A particle has no mass."
