"""A slope that stands ends early as no slide; one that creeps before it fails is not cut."""

from math import atan, degrees, radians, tan

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.record import Status
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from solver.rest import RestBy, StandDetector
from solver.slide import PAPER

LIMIT = 31.9
"""Cohesion (kPa) at the limit with 10 degrees, bisected: brittle ground, which fails at once or not at all."""

BRITTLE = ["soil.softening.rate=0.6", "numerics.output_interval=0.1 s"]


def simulated(*overrides):
    return prepare(small_scene(*BRITTLE, *overrides)).simulate(BASELINE)


def at_safety(factor):
    """Return settings with both parts of the strength at a factor of safety."""
    angle = degrees(atan(factor * tan(radians(10.0))))
    return [f"soil.cohesion.mean={factor * LIMIT:.4f} kPa", f"soil.friction_angle.mean={angle:.4f} deg"]


def to_the_end(monkeypatch, *overrides):
    with monkeypatch.context() as patch:
        patch.setattr(StandDetector, "stands", lambda *_: False)
        return simulated(*overrides)


def test_a_slope_that_stands_costs_a_third_at_most(monkeypatch):
    early, late = simulated("soil.cohesion.mean=60 kPa"), to_the_end(monkeypatch, "soil.cohesion.mean=60 kPa")
    assert early.status is late.status is Status.no_slide
    assert early.values["steps"] <= late.values["steps"] / 3
    assert early.values["rest_by"] == RestBy.STANDING
    assert late.values["rest_by"] == RestBy.NEVER
    assert np.isnan(early.values["settle_time"])
    assert np.isfinite(early.values["max_displacement"]).all()


def test_shortly_above_the_limit_the_end_comes_early_with_the_displacement_of_the_whole_run(monkeypatch):
    early, late = simulated(*at_safety(1.02)), to_the_end(monkeypatch, *at_safety(1.02))
    assert early.status is late.status is Status.no_slide
    assert early.values["steps"] < late.values["steps"] / 2
    assert early.values["max_displacement"][-1] == pytest.approx(late.values["max_displacement"][-1], abs=0.005)


@pytest.mark.parametrize("factor", [0.98, 0.995])
def test_shortly_below_the_limit_no_creeping_slope_is_cut(factor):
    record = simulated(*at_safety(factor))
    assert record.status in (Status.slid, Status.not_settled, Status.reached_wall)
    assert record.values["rest_by"] != RestBy.STANDING
    assert record.values["final_runout"] > 1.0


QUIET = {"farthest": 0.01, "energy": 1.0, "unbalanced": 0.05}


def ends_at(seconds=6.0, loaded_at=0.0, **changes):
    """Return when a slope of 15 m is known to stand (s), or None; changes are functions of time."""
    detector = StandDetector(PAPER, height=15.0, mass=1.45e6, loaded_at=loaded_at)
    for time in np.arange(0.0, seconds, 0.1):
        state = [changes[name](time) if name in changes else value for name, value in QUIET.items()]
        if detector.stands(float(time), *state):
            return time
    return None


def test_quiet_ground_is_watched_for_one_and_a_half_times_the_time_of_its_height():
    assert ends_at() == pytest.approx(1.5 * np.sqrt(15.0 / 9.81), abs=0.1)
    assert ends_at(loaded_at=2.0) == pytest.approx(2.0 + 1.5 * np.sqrt(15.0 / 9.81), abs=0.1)


@pytest.mark.parametrize(
    "changes",
    [
        {"farthest": lambda time: 0.002 * time},  # creep of 2 mm/s
        {"farthest": lambda _: 0.2},  # it has moved
        {"energy": lambda _: 2e3},  # 5 cm/s
        {"unbalanced": lambda _: 0.2},
    ],
)
def test_each_sign_of_motion_keeps_the_watch(changes):
    assert ends_at(**changes) is None
