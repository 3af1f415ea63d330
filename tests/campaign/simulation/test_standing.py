"""A slope that stands ends early as no slide; one that creeps before it fails is not cut."""

from math import atan, degrees, radians, tan

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.record import Status
from campaign.scene import load_scene
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


def brittle_cut(*overrides):
    """Return a cut of 8 m at 35 degrees whose mean factor of safety is 1.06, with strength residual after 0.1 m."""
    return prepare(
        load_scene(
            "ma2023",
            [
                "geometry.slope.height=8 m",
                "geometry.slope.angle=35 deg",
                "soil.cohesion.mean=7.075 kPa",
                "soil.cohesion.residual=1 kPa",
                "soil.friction_angle.mean=20 deg",
                "soil.friction_angle.residual=12 deg",
                "soil.softening.slip_to_residual=0.1 m",
                *overrides,
            ],
        )
    )


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


def test_a_cut_that_creeps_by_less_than_it_swings_is_not_taken_for_stable():
    """Its displacement is 4 to 5 mm from 0.5 s until it fails at 2.6 s."""
    record = brittle_cut("campaign.seed=1", "numerics.end_time=4 s").simulate(9)
    assert record.values["rest_by"] != RestBy.STANDING
    assert record.values["max_displacement"][-1] > 1.0


@pytest.mark.slow
def test_a_cut_that_fails_after_many_oscillations_is_not_taken_for_stable():
    """From 2 s to 17 s it moves by 1.5 mm and yields a little in each oscillation, then it slides."""
    record = brittle_cut("soil.cohesion.mean=6.893 kPa", "numerics.end_time=20 s").simulate(2)
    assert record.values["rest_by"] != RestBy.STANDING
    assert record.values["max_displacement"][-1] > 1.0


QUIET = {"farthest": 0.01, "energy": 1.0, "unbalanced": 0.05, "intact": np.ones(1000)}
WATCH = 1.5 * np.sqrt(15.0 / 9.81)


def ends_at(end_time=6.0, loaded_at=0.0, period=0.5, **changes):
    """Return when a slope of 15 m is known to stand (s), or None; changes are functions of time."""
    detector = StandDetector(PAPER, 15.0, period, mass=1.45e6, end_time=end_time, loaded_at=loaded_at)
    for time in np.arange(0.0, end_time, 0.1):
        state = [changes[name](time) if name in changes else value for name, value in QUIET.items()]
        if detector.stands(float(time), *state):
            return time
    return None


def softening_band(share, size=50):
    """Return the history of a ground of which a band of ``size`` particles loses a share of its drop in strength."""

    def intact(time):
        shares = np.ones(1000)
        shares[:size] -= share(time)
        return shares

    return intact


def test_quiet_ground_is_watched_for_one_and_a_half_times_the_time_of_its_height():
    assert ends_at() == pytest.approx(WATCH, abs=0.1)
    assert ends_at(loaded_at=2.0) == pytest.approx(2.0 + WATCH, abs=0.1)


def test_soft_ground_is_watched_for_a_whole_oscillation():
    assert ends_at(period=2.5) == pytest.approx(2.5, abs=0.1)


def test_ground_that_softens_evenly_is_left_once_too_little_time_remains_to_lose_a_half_percent():
    """A pace ``r`` has ``r (end_time - t)`` to go; here 1 % per s, so that 0.5 s before the end is early enough."""
    assert ends_at(intact=softening_band(lambda time: 0.01 * time)) == pytest.approx(5.5, abs=0.11)


def test_ground_that_shakes_down_stands_once_its_softening_has_died_out():
    """A pace ``0.1 exp(-t)`` over the watch ``W`` has ``0.1 exp(-t) (exp(W) - 1) (end_time - t) / W`` to go."""
    died_out = ends_at(end_time=20.0, intact=softening_band(lambda time: 0.1 * (1.0 - np.exp(-time))))
    times = np.arange(2.0, 20.0, 0.1)
    to_come = 0.1 * np.exp(-times) * np.expm1(WATCH) * (20.0 - times) / WATCH
    assert died_out == pytest.approx(times[np.argmax(to_come <= 0.005)], abs=0.11)


def test_a_band_counts_alike_in_a_large_slope_that_softens_a_little_everywhere():
    """The mean over all ground would be 18 times less than in the band, and would let it go at once."""

    def shares(time):
        return softening_band(lambda t: 0.01 * t)(time) - 0.00005 * time

    assert ends_at(intact=shares) == pytest.approx(5.5, abs=0.21)


@pytest.mark.parametrize(
    "changes",
    [
        {"farthest": lambda time: 0.002 * time},  # creep of 2 mm/s
        {"farthest": lambda _: 0.2},  # it has moved
        {"energy": lambda _: 2e3},  # 5 cm/s
        {"unbalanced": lambda _: 0.2},
        {"intact": softening_band(lambda time: 0.1 * time)},  # no strength will be left
    ],
)
def test_each_sign_of_motion_or_failure_keeps_the_watch(changes):
    assert ends_at(**changes) is None
