"""Release, march, rest, and the guards."""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
from small_slope import fails_from, small_model, with_strength

from solver.constants import STANDARD_GRAVITY
from solver.in_situ import in_situ_state
from solver.march import March, MarchEnd, march_to_rest
from solver.operations import GRAVITY_WORK
from solver.particles import copy_particles
from solver.rest import REST_UNBALANCED, RestBy, RestDetector
from solver.timestep import even_steps, largest_courant, stable_step

MODEL = small_model()
RESIDUAL = 2e3  # Pa
TIMES = np.linspace(0.0, 8.0, 81)


@pytest.fixture(scope="module")
def start():
    return with_strength(in_situ_state(MODEL), residual=RESIDUAL)


@pytest.fixture(scope="module")
def slide(start):
    return march_to_rest(MODEL, start, TIMES)


def test_the_same_start_gives_the_same_bits(start, slide):
    again = march_to_rest(MODEL, start, TIMES)
    for name in ("runout", "max_displacement", "kinetic_energy"):
        np.testing.assert_array_equal(getattr(again, name), getattr(slide, name))
    for found, expected in zip(again.particles, slide.particles, strict=True):
        np.testing.assert_array_equal(found, expected)
    assert (again.end, again.settle_time, again.steps) == (slide.end, slide.settle_time, slide.steps)


def test_the_start_is_not_modified(start, slide):
    assert np.all(start.velocity_x == 0.0)
    assert np.all(start.plastic_strain == 0.0)
    assert not np.shares_memory(start.x, slide.particles.x)


def test_a_failed_slope_slides_and_comes_to_rest(slide):
    assert slide.end is MarchEnd.AT_REST
    assert not slide.has_failed
    assert 2.0 < slide.settle_time < 6.0
    assert slide.max_displacement[-1] > 2.0
    assert slide.runout[-1] > 1.0
    assert abs(slide.energy_error) < 0.02


def test_output_beyond_rest_holds_its_last_values(slide):
    rest = int(np.searchsorted(TIMES, slide.settle_time - 1e-9))
    for name in ("runout", "max_displacement", "kinetic_energy"):
        values = getattr(slide, name)
        assert np.isfinite(values).all()
        assert np.all(values[rest:] == values[rest])


def test_forces_are_out_of_balance_in_motion_and_little_at_rest(slide):
    """At release only those that yielding sets free: the in-situ state is balanced."""
    assert slide.unbalanced_force[0] < 2e-4
    assert np.nanmax(slide.unbalanced_force) > 2.0 * slide.unbalanced_force[-1]
    assert slide.unbalanced_force[-1] < REST_UNBALANCED
    assert slide.rest_by is RestBy.MOTION_AND_FORCE


def test_the_front_is_missing_until_something_slides_and_then_only_gains(slide):
    slides = np.isfinite(slide.front_position)
    assert not slides[0]
    assert slides[-1]
    toe = MODEL.surface.toe_x
    tip = np.where(slides, np.maximum(slide.front_position - toe, 0.0), 0.0)
    np.testing.assert_allclose(slide.runout, tip, atol=1e-12)
    assert np.all(slide.runout_mass <= slide.runout)
    assert slide.runout_mass[-1] > 0.5


def test_the_front_that_is_followed_is_the_one_chosen(start, slide):
    model = MODEL._replace(criteria=MODEL.criteria._replace(front="mass"))
    history = march_to_rest(model, start, TIMES)
    assert history.front_position[-1] == model.surface.toe_x + slide.runout_mass[-1]


def test_output_starts_from_nothing(slide):
    assert slide.runout[0] == slide.max_displacement[0] == slide.kinetic_energy[0] == 0.0


def test_a_strong_slope_stays(start):
    """And its stillness is not taken for the rest after a slide."""
    still = march_to_rest(MODEL, with_strength(start, cohesion=1e6), np.linspace(0.0, 1.0, 11))
    assert still.end is MarchEnd.STANDS
    assert still.max_displacement[-1] < 1e-4
    assert np.isnan(still.settle_time)
    assert np.all(still.particles.plastic_strain == 0.0)


def test_mass_is_conserved_and_volume_nearly(slide, start):
    np.testing.assert_array_equal(slide.particles.mass, start.mass)
    assert slide.particles.volume.sum() == pytest.approx(start.volume.sum(), rel=0.05)


def test_output_times_do_not_steer_the_slide(start):
    """Output every 0.1 s or every 0.8 s: the same slide but for the rounding of steps to output times."""
    fine, coarse = (march_to_rest(MODEL, start, np.linspace(0.0, 1.6, n)) for n in (17, 3))
    assert coarse.max_displacement[-1] == pytest.approx(fine.max_displacement[-1], rel=0.02)


@pytest.mark.parametrize("stress_update", ["usl", "usf"])
def test_every_scheme_slides_alike(stress_update, start, slide):
    method = MODEL.method._replace(stress_update=stress_update)
    other = march_to_rest(MODEL._replace(method=method, courant=0.4), start, TIMES)
    assert other.max_displacement[-1] == pytest.approx(slide.max_displacement[-1], rel=0.1)


def test_what_the_watch_raises_ends_the_march(start):
    seen = []

    def stop_after_three(march):
        seen.append(march.time)
        if len(seen) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        march_to_rest(MODEL, start, TIMES, stop_after_three)
    np.testing.assert_allclose(seen, [0.0, 0.1, 0.2], atol=1e-12)


def test_gravity_ramps_up_and_stays(start):
    march = March(MODEL._replace(ramp_time=0.4), start)
    seen = []
    for time in (0.0, 0.1, 0.3, 0.7):
        march.advance_to(time)
        seen.append(march._gravity()[0])
        assert march.time == time
    np.testing.assert_allclose(seen, STANDARD_GRAVITY * np.array([0.0, 0.25, 0.75, 1.0]), rtol=1e-12)


def test_a_ramp_does_the_work_of_its_mean_gravity():
    """A body in free fall under ``g t / T`` has the velocity ``g T / 2`` at the end of the ramp."""
    start = in_situ_state(MODEL)
    for stress in (start.stress_xx, start.stress_yy, start.stress_zz, start.stress_xy):
        stress[:] = 0.0
    march = March(MODEL._replace(ramp_time=0.05), start)
    march.grid.free_x[:] = march.grid.free_y[:] = 1.0
    march.advance_to(0.05)
    np.testing.assert_allclose(march.particles.velocity_y, -STANDARD_GRAVITY * 0.025, rtol=1e-7)
    energy = 0.5 * start.mass.sum() * (STANDARD_GRAVITY * 0.025) ** 2
    assert march.work.ledger[GRAVITY_WORK] == pytest.approx(energy, rel=0.15)  # first order: twelve steps


def test_left_domain_is_told_and_its_output_is_nan(start):
    flying = copy_particles(start)
    flying.velocity_y[:] = 30.0
    history = march_to_rest(MODEL, flying, TIMES)
    assert history.end is MarchEnd.LEFT_DOMAIN
    assert history.has_failed
    assert "left the grid at the top at" in history.reason
    assert np.isnan(history.runout[1:]).all()
    assert np.isnan(history.settle_time)


@pytest.mark.parametrize(("speed", "side"), [(30.0, "on the right"), (-30.0, "on the left")])
def test_the_side_is_told_on_which_ground_left(speed, side, start):
    """A side wall holds nothing that is a cell beyond it."""
    flying = copy_particles(start)
    flying.x[0] = MODEL.surface.width if speed > 0.0 else 0.0
    flying.velocity_x[0] = speed
    march = March(MODEL, flying)
    march.particles.x[0] += np.sign(speed) * 3.0 * MODEL.cell_size
    assert march._way_out() == side


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize(
    "name", ["velocity_x", "velocity_y", "stress_xx", "stress_zz", "stress_xy", "cohesion", "friction_angle", "volume"]
)
def test_one_bad_number_ends_the_march_as_diverged(name, value, start):
    if (name, value) == ("cohesion", np.inf):
        pytest.skip("infinite cohesion is an elastic particle")
    bad = copy_particles(start)
    getattr(bad, name)[57] = value
    history = march_to_rest(MODEL, bad, np.linspace(0.0, 1.0, 11))
    assert history.end is MarchEnd.DIVERGED
    assert history.reason
    assert np.isnan(history.max_displacement[-1])


def test_an_explosion_is_not_mistaken_for_a_plain_that_is_too_short(start):
    bad = copy_particles(start)
    bad.stress_xx[57] = 1e12
    assert march_to_rest(MODEL, bad, np.linspace(0.0, 1.0, 11)).end is MarchEnd.DIVERGED


def moving_march(start, released, model=MODEL):
    """Return a march whose mass has moved 2 m and gained far more energy than gravity ``released`` (J/m)."""
    march = March(model, start)
    march.particles.x[:] += 2.0
    march.particles.velocity_x[:] = 5.0
    march.work.ledger[GRAVITY_WORK] = released
    return march


@pytest.mark.parametrize("released", [1e3, -1e3])
def test_energy_from_nowhere_is_noticed_also_when_the_mass_has_risen(released, start):
    """An explosion can throw the ground upwards, where gravity has done negative work."""
    assert moving_march(start, released).energy.is_created()


def test_energy_that_gravity_gave_is_no_alarm(start):
    march = moving_march(start, released=0.5 * start.mass.sum() * 25.0)
    assert march.energy.error() == pytest.approx(0.0, abs=1e-12)
    assert not march.energy.is_created()
    assert not march.energy.is_lost()


def test_energy_lost_to_the_scheme_is_noticed(start):
    """Of what gravity gave, 10 % are missing, and a blend with PIC is blamed where there is one."""
    given = 0.5 * start.mass.sum() * 25.0
    march = moving_march(start, released=given / 0.9)
    assert march.energy.is_lost()
    assert march.blame_scheme() is MarchEnd.DIVERGED
    assert "lower numerics.courant" in march.reason
    march = moving_march(start, given / 0.9, MODEL._replace(method=MODEL.method._replace(flip_fraction=0.9)))
    assert march.energy.is_lost()
    march.blame_scheme()
    assert "numerics.flip" in march.reason


def test_a_start_outside_the_grid_breaks_off_without_a_crash():
    """In a process of its own, because writing beyond the nodes takes the whole process down."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert all(pool.map(fails_from, [-50.0, 1e7, np.nan, np.inf]))


def test_a_step_beyond_its_limit_is_not_taken(start):
    history = march_to_rest(MODEL._replace(courant=0.95), start, TIMES)
    assert history.end is MarchEnd.DIVERGED
    assert history.steps == 0
    assert "The Courant number 0.95 is beyond 0.9" in history.reason


def test_a_runaway_time_step_breaks_off(start, monkeypatch):
    monkeypatch.setattr("solver.march.largest_courant", lambda *scheme: np.inf)
    history = march_to_rest(MODEL._replace(courant=4.0), start, TIMES)
    assert history.has_failed
    assert history.steps > 0


@pytest.mark.parametrize(("basis", "largest"), [("linear", 0.2), ("gimp", 0.9), ("bspline", 1.1)])
def test_every_basis_has_its_limit(basis, largest):
    assert largest_courant(basis, "musl") == largest


def test_rest_needs_a_slide_and_then_both_signs_for_a_while():
    detector = RestDetector()
    story = [  # time, farthest, energy, is over
        (0.0, 0.0, 0.0, False),
        (0.1, 0.0, 0.0, False),  # quiet before the slide
        (0.2, 0.5, 100.0, False),
        (0.3, 2.0, 100.0, False),
        (0.4, 2.001, 50.0, False),  # slow, but it still has energy
        (0.5, 2.002, 0.05, False),  # quiet from here
        (0.6, 2.003, 0.05, False),
        (0.65, 2.003, 5.0, False),  # a jolt
        (0.7, 2.003, 0.05, False),
        (0.8, 2.003, 0.05, False),
        (0.9, 2.003, 0.05, True),
    ]
    assert [detector.is_over(*state, 0.05) for *state, _ in story] == [over for *_, over in story]


def test_rest_needs_balanced_forces_or_patience():
    """Quiet ground whose forces are not balanced may be about to move; if it stays quiet, it only vibrates."""
    story = [(0.0, 0.0, 0.0), (0.1, 2.0, 100.0), *((0.1 * k, 2.0, 0.01) for k in range(2, 30))]
    for unbalanced, over, by in ((0.05, 0.4, RestBy.MOTION_AND_FORCE), (0.2, 1.2, RestBy.MOTION)):
        detector = RestDetector()
        assert next(time for time, *state in story if detector.is_over(time, *state, unbalanced)) == pytest.approx(over)
        assert detector.by is by


def test_a_slide_below_a_metre_does_not_arm_the_rest():
    detector = RestDetector()
    states = [(0.0, 0.0, 0.0), (0.5, 0.9, 100.0), (1.0, 0.9, 1e-6), (2.0, 0.9, 1e-6), (9.0, 0.9, 1e-6)]
    assert not any(detector.is_over(*state, 0.05) for state in states)


def test_steps_respect_the_courant_limit_and_divide_the_interval():
    assert stable_step(0.5, 0.4, 90.0, 10.0) == pytest.approx(0.5 * 0.4 / 100.0)
    assert even_steps(0.1, 0.02) == 5
    assert even_steps(0.1, 0.0199) == 6
    assert even_steps(1e-9, 1.0) == 1
