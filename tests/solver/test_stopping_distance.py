"""How much farther a front may come that is cut short."""

from dataclasses import replace

import numpy as np
import pytest
from small_slope import small_model, with_strength

from solver.constants import STANDARD_GRAVITY
from solver.in_situ import in_situ_state
from solver.march import MarchEnd, march_to_rest
from solver.observables import is_displaced
from solver.slide import PAPER
from solver.stopping_distance import farther_advance, front_speeds, least_friction, stopping_distance

MODEL = small_model()._replace(criteria=PAPER._replace(front="mass"))
TIMES = np.linspace(0.0, 8.0, 81)


@pytest.fixture(scope="module")
def start():
    return with_strength(in_situ_state(MODEL), residual=2e3)


@pytest.fixture(scope="module")
def slide(start):
    return march_to_rest(MODEL, start, TIMES)


def cut_short(slide, **changes):
    """Return a march that has not come to rest, with other series at its end."""
    return replace(slide, end=MarchEnd.END_TIME, **changes)


def advance_of(history):
    return farther_advance(history, MODEL.surface, MODEL.criteria)


def test_friction_stops_a_block_where_coulomb_says():
    """2 m/s at a tenth of the weight: it takes 2 / 0.981 s, at 1 m/s in the mean."""
    assert stopping_distance(2.0, 0.1) == pytest.approx(2.0 / (0.1 * STANDARD_GRAVITY))
    assert stopping_distance(2.0, 0.0) == np.inf


@pytest.mark.parametrize(("angle", "ratio", "cohesion"), [(5.0, 0.0, 1e3), (9.925, 0.5, 1e3), (0.0, 0.0, 6e3)])
def test_residual_strength_resists_by_its_friction_or_its_cohesion(start, angle, ratio, cohesion):
    """5 degrees are 0.0875 of the weight, 9.9 on half of it, and 6 kPa under 3 m of 2000 kg/m3 are 0.102."""
    soil = start._replace(
        cohesion_residual=np.full(start.x.size, cohesion),
        friction_angle_residual=np.full(start.x.size, np.radians(angle)),
        pore_area=ratio * start.volume,
    )
    assert least_friction(soil, MODEL.surface) == pytest.approx(0.0875 if angle else 0.102, rel=2e-3)


def test_the_speed_of_a_front_is_that_of_its_last_second():
    """2 m/s from 1 s to 3 s, then still; a front that is drawn back does not advance."""
    time = np.linspace(0.0, 5.0, 51)
    runout = 2.0 * np.clip(time - 1.0, 0.0, 2.0) - 0.3 * np.maximum(time - 4.0, 0.0)
    speeds = front_speeds(time, runout, PAPER)
    assert speeds[time <= 1.0] == pytest.approx(0.0)
    assert speeds.max() == pytest.approx(2.0)
    assert speeds[35] == pytest.approx(1.0)
    assert speeds[-1] == 0.0


def test_at_rest_it_comes_no_farther(slide):
    assert slide.end is MarchEnd.AT_REST
    assert advance_of(slide) == 0.0


def test_nothing_bounds_a_front_at_full_speed(start):
    fast = march_to_rest(MODEL, start, TIMES[:9])
    assert fast.end is MarchEnd.END_TIME
    assert np.isnan(advance_of(fast))


def test_a_front_that_slows_down_comes_no_farther_than_its_bound(start, slide):
    """Cut short at several times from which on there is a bound; it is given within the displacement that counts."""
    last = int(np.searchsorted(TIMES, slide.settle_time - 1e-9))
    final, bounded = slide.runout_mass[-1], 0
    for k in range(last - 1, last // 2, -2):
        cut = march_to_rest(MODEL, start, TIMES[:k])
        bound = advance_of(cut)
        assert not final - cut.runout_mass[-1] > bound + MODEL.criteria.displaced, TIMES[k - 1]
        bounded += np.isfinite(bound)
    assert bounded >= 3


def test_a_front_that_stands_is_bound_by_the_ground_that_still_moves_behind_it(slide):
    """The last second of a slope that retrogresses: sliding ground at 1 m/s behind a front that has stopped."""
    slid = is_displaced(slide.particles, slide.reference, MODEL.criteria)
    moving = np.full(TIMES.size, 0.5 * slide.particles.mass[slid].sum())
    friction = least_friction(slide.reference, MODEL.surface)
    assert advance_of(cut_short(slide, kinetic_energy=moving)) == pytest.approx(
        stopping_distance(1.0, friction), rel=1e-3
    )
    assert advance_of(cut_short(slide, kinetic_energy=1e-6 * moving)) < 1e-5


def test_where_a_wall_was_in_the_way_nothing_bounds_it(slide):
    assert np.isnan(advance_of(cut_short(slide, walls=slide.walls._replace(right=True))))


def test_nothing_bounds_a_tip(slide):
    criteria = MODEL.criteria._replace(front="tip")
    assert np.isnan(farther_advance(cut_short(slide), MODEL.surface, criteria))
