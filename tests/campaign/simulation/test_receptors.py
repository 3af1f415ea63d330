"""A slide at the places that a scene names: on marches made by hand, and on the paper's slope in cells of 2 m."""

from types import SimpleNamespace

import numpy as np
import pytest
from small_campaign import small_scene
from small_slope import small_model

from campaign.record import Status
from campaign.simulation.ground import prepare
from campaign.simulation.receptors import ReceptorLog, columns_of
from campaign.statistics.receptors import AHEAD, EFFECTS
from solver.filling import ground_of
from solver.particles import copy_particles

MODEL = small_model(plain=14.0)  # cells of 0.5 m; crest 3 m, toe at 6 m, foundation 1 m, height 3 m
TIMES = np.array([0.0, 1.0, 2.0, 3.0])
TOE, CELL = 6.0, 0.5


def log_of(*stretches):
    return ReceptorLog(np.array(stretches), MODEL, TIMES)


def march(log, *states):
    """Let the log see a march in these states, and return its values after the last of them."""
    start = ground_of(MODEL)
    for state in states:
        log.observe(SimpleNamespace(particles=state, reference=start))
    return log.values(states[-1]._replace(volume=start.volume), start)


def with_block_at(place, height=1.0):
    """Return the ground with 1 x 1 m of its crest, four cells, laid on the plain from a place on (m)."""
    now = copy_particles(ground_of(MODEL))
    block = (now.x > 1.0) & (now.x < 2.0) & (now.y > 3.0)
    now.x[block] += place - 1.0
    now.y[block] += height - 3.0
    return now


STILL = copy_particles(ground_of(MODEL))


def test_a_block_that_slides_over_a_point_is_told_with_its_time_depth_speed_and_force():
    """1 m deep and at 2.5 m/s, of 2000 kg/m3: 12.5 kN/m and 12.5 kPa; the column is the cell around the point."""
    found = march(log_of([10.0, 10.0]), STILL, with_block_at(7.0), with_block_at(9.5), with_block_at(9.5))
    assert found["front_reaches"] == found["moved_ground_reaches"] == 1.0
    assert found["front_arrival"] == found["moved_ground_arrival"] == 2.0
    np.testing.assert_allclose(found["receptor_depth"], [[0.0, 0.0, 1.0, 1.0]], atol=1e-12)
    np.testing.assert_allclose(found["receptor_velocity"], [[0.0, 0.0, 2.5, 0.0]], atol=1e-12)
    assert found["receptor_max_depth"] == pytest.approx(1.0)
    assert found["receptor_max_velocity"] == pytest.approx(2.5)
    assert found["receptor_momentum_flux"] == pytest.approx(2000.0 * 1.0 * 2.5**2)
    assert found["receptor_impact_pressure"] == pytest.approx(2000.0 * 2.5**2)
    assert found["receptor_deposit"] == pytest.approx(1.0)
    for name in AHEAD:
        assert not found[name], name


def test_what_flies_ahead_is_told_apart_from_the_slide_behind_it():
    """A clod of one particle passes at 9 m/s, a second before the block comes at 2.5 m/s and 1 m deep."""
    clod, block = copy_particles(with_block_at(7.0)), with_block_at(9.5)
    ahead = np.flatnonzero((clod.x > 7.0) & (clod.y > 1.0))[:1]
    clod.x[ahead], block.x[ahead] = 10.0, 13.0
    found = march(log_of([10.0, 10.0]), STILL, clod, block)
    assert (found["moved_ground_arrival"], found["front_arrival"]) == (1.0, 2.0)
    assert found["receptor_max_velocity"] == pytest.approx(2.5)
    assert found["receptor_ahead_velocity"] > 8.0
    assert found["receptor_ahead_depth"] == pytest.approx(0.25**2 / CELL)
    assert found["receptor_ahead_impact_pressure"] == pytest.approx(2000.0 * found["receptor_ahead_velocity"] ** 2)


def test_velocity_is_how_ground_moves_and_not_what_a_cell_does_not_see():
    """A deposit at rest whose particles keep velocities of 4 m/s that move nothing."""
    trembling = with_block_at(9.5)
    trembling.velocity_x[::2], trembling.velocity_x[1::2] = 4.0, -4.0
    found = march(log_of([10.0, 10.0]), STILL, with_block_at(9.5), trembling)
    assert found["receptor_velocity"][0, 2] == 0.0


def test_a_block_that_stops_short_reaches_nothing():
    found = march(log_of([12.0, 14.0]), STILL, with_block_at(8.0), with_block_at(9.0))
    assert found["front_reaches"] == found["moved_ground_reaches"] == 0.0
    assert np.isnan(found["front_arrival"])
    assert np.isnan(found["moved_ground_arrival"])
    for name in (*EFFECTS, *AHEAD, "receptor_depth", "receptor_velocity"):
        assert not np.any(found[name]), name


def test_ground_that_is_only_pushed_has_moved_without_the_front():
    pushed = copy_particles(ground_of(MODEL))
    pushed.x[(pushed.x > 9.0) & (pushed.x < 12.0) & (pushed.y > 0.5)] += 0.2
    found = march(log_of([10.0, 10.0]), STILL, pushed)
    assert (found["front_reaches"], found["moved_ground_reaches"]) == (0.0, 1.0)
    assert (found["receptor_max_depth"], found["receptor_max_velocity"]) == (0.0, 0.0)
    assert found["receptor_ahead_depth"] == pytest.approx(0.5)
    assert found["receptor_ahead_velocity"] == pytest.approx(0.2)


def test_what_is_told_of_a_range_is_the_largest_of_its_columns():
    """The block covers 1 of 4 m: two of eight columns, whose depth is not levelled over the range."""
    found = march(log_of([9.0, 13.0]), STILL, with_block_at(9.5))
    assert found["receptor_max_depth"] == found["receptor_deposit"] == pytest.approx(1.0)
    assert found["front_arrival"] == 1.0


def test_a_front_that_flew_over_between_two_outputs_has_been_there():
    found = march(log_of([8.0, 8.0]), STILL, with_block_at(11.0))
    assert found["front_reaches"] == found["moved_ground_reaches"] == 1.0
    assert found["receptor_max_depth"] == 0.0


def test_upslope_of_the_toe_only_ground_that_has_slid_there_counts():
    """The block leaves 1 to 2 m for the plain: a house on it is reached, one behind it not, and the ground is lost."""
    found = march(log_of([1.5, 1.5], [0.4, 0.6]), STILL, with_block_at(9.0))
    np.testing.assert_array_equal(found["front_reaches"], [0.0, 0.0])
    np.testing.assert_allclose(found["receptor_deposit"], [-1.0, 0.0], atol=1e-12)
    sunk = copy_particles(ground_of(MODEL))
    sunk.y[(sunk.x > 1.0) & (sunk.x < 2.0)] -= 0.2
    found = march(log_of([1.5, 1.5], [0.4, 0.6]), STILL, sunk)
    np.testing.assert_array_equal(found["front_reaches"], [1.0, 0.0])
    np.testing.assert_array_equal(found["front_arrival"], [1.0, np.nan])


def test_a_front_is_as_much_as_slide_front_area():
    """0.25 m2 is four particles; three that are thrown ahead are moved ground and no front."""
    thrown = copy_particles(ground_of(MODEL))
    few = np.flatnonzero((thrown.x > 1.0) & (thrown.x < 2.0) & (thrown.y > 3.5))[:3]
    thrown.x[few] += 9.0
    found = march(log_of([9.5, 9.5], [7.0, 7.0]), STILL, thrown)
    np.testing.assert_array_equal(found["front_reaches"], [0.0, 0.0])
    np.testing.assert_array_equal(found["moved_ground_reaches"], [0.0, 0.0])
    found = march(log_of([10.1, 10.5]), STILL, thrown)
    assert (found["front_reaches"], found["moved_ground_reaches"]) == (0.0, 1.0)


@pytest.mark.parametrize(
    ("stretch", "edges"),
    [
        ([10.0, 10.0], [9.75, 10.25]),
        ([10.0, 10.2], [9.85, 10.35]),
        ([9.0, 10.2], [9.0, 9.6, 10.2]),
        ([0.1, 0.1], [0.0, 0.5]),
        ([19.9, 19.95], [19.5, 20.0]),
    ],
)
def test_columns_are_at_least_a_cell_wide_and_between_the_walls(stretch, edges):
    columns = columns_of(np.array(stretch), CELL, 20.0)
    np.testing.assert_allclose(columns, np.column_stack([edges[:-1], edges[1:]]), atol=1e-12)


@pytest.fixture(scope="module")
def slope_records():
    """Four realizations, half of which go beyond the median of their fronts; the farther place none reaches."""
    plain = small_scene("numerics.end_time=6 s")
    ground = prepare(plain)
    records = [ground.simulate(k) for k in range(4)]
    median = 35.0 + float(np.median([record.values["final_runout_mass"] for record in records]))
    places = f'receptor=[{{name = "road", x = "{median} m"}}, {{name = "river", x = ["70 m", "74 m"]}}]'
    watched = prepare(small_scene("numerics.end_time=6 s", places))
    return median, records, [watched.simulate(k) for k in range(4)]


def test_the_share_that_reaches_a_place_is_that_of_fronts_beyond_it(slope_records):
    """Counted by hand from the final mass fronts, which at rest are the farthest."""
    median, records, watched = slope_records
    beyond = [35.0 + record.values["final_runout_mass"] >= median for record in records]
    assert sum(beyond) == 2
    assert [record.values["front_reaches"].tolist() for record in watched] == [[float(far), 0.0] for far in beyond]
    for record in watched:
        assert (record.values["moved_ground_reaches"] >= record.values["front_reaches"]).all()


def test_receptors_change_nothing_else(slope_records):
    _, records, watched = slope_records
    for plain, record in zip(records, watched, strict=True):
        assert record.status == plain.status in (Status.slid, Status.not_settled)
        for name in plain.values.keys() - {"wall_time"}:
            np.testing.assert_array_equal(record.values[name], plain.values[name], err_msg=name)
