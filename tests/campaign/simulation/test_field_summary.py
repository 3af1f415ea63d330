"""What a record keeps of its random field."""

from types import SimpleNamespace

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.strengths import Strengths
from campaign.seeds import BASELINE
from campaign.simulation.field_summary import BOXES, box_map, slip_zone, zone_means
from campaign.simulation.ground import prepare
from solver.particles import allocate_particles
from solver.surface import slope_surface

SLOPE = slope_surface(15.0, np.radians(45.0), 20.0, 40.0, 4.0)  # 75 m wide, 19 m high
GRID = ReferenceGrid.covering(SLOPE.width, SLOPE.top, 0.25)


def field_of(values):
    return Strengths(GRID, ("cohesion",), values[None])


def test_means_are_over_the_zone_and_weighted_by_area():
    """Four particles of 1, 1, 1 and 3 m2; the last two slide, and the last alone has slipped."""
    start = allocate_particles(np.arange(4.0), np.ones(4), 1.0, 2000.0)
    start.volume[3] = 3.0
    start = start._replace(cohesion=np.array([10e3, 20e3, 30e3, 50e3]), friction_angle=np.array([0.1, 0.2, 0.3, 0.5]))
    now = start._replace(plastic_strain=np.array([0.0, 0.1, 0.2, 4.0]), cohesion=np.zeros(4))
    found = zone_means(now, start, np.array([False, False, True, True]))
    assert found["sliding_cohesion"] == pytest.approx((30e3 + 3 * 50e3) / 4)
    assert found["sliding_friction_angle"] == pytest.approx((0.3 + 3 * 0.5) / 4)
    assert found["slip_cohesion"] == pytest.approx(50e3)
    assert found["slip_friction_angle"] == pytest.approx(0.5)
    nothing = zone_means(now, start, np.zeros(4, dtype=bool))
    assert np.isnan(list(nothing.values())).all()


def test_a_few_overstrained_particles_do_not_decide_the_slip_zone():
    """A band at strains of about 2 in ground that slides as a block, with and without a shred at 100."""
    strain = np.concatenate([np.full(20, 2.0), np.full(180, 0.1)])
    displaced = np.ones(200, dtype=bool)
    displaced[10:20] = False  # the lower half of the band stays
    np.testing.assert_array_equal(np.flatnonzero(slip_zone(strain, displaced)), np.arange(20))
    strain[-1] = 100.0
    np.testing.assert_array_equal(np.flatnonzero(slip_zone(strain, displaced)), [*range(20), 199])


def test_a_map_of_equal_strength_is_its_logarithm_wherever_there_is_ground():
    boxes = box_map(SLOPE, GRID)
    (means,) = boxes.means(field_of(np.full(GRID.shape, 20e3)))
    assert means.shape == BOXES
    has_ground = np.isfinite(means)
    np.testing.assert_allclose(means[has_ground], np.log(20e3), rtol=1e-14)
    left, low = np.meshgrid(boxes.x - 75.0 / BOXES[1] / 2, boxes.y - 19.0 / BOXES[0] / 2)
    assert not has_ground[low >= SLOPE.height_at(left)].any()
    assert has_ground[low + 0.25 < SLOPE.height_at(left + 0.25)].all()
    assert 0.4 < has_ground.mean() < 0.6  # 75 x 4 m of plain and 20 x 15 m of crest in 75 x 19 m, and the face


def test_boxes_tell_where_the_ground_is_strong():
    """ln c = a + b x + d y has its value in the middle of a box as mean, to what the cells of the grid resolve."""
    boxes = box_map(SLOPE, GRID)
    x, y = np.meshgrid(GRID.x, GRID.y)
    (means,) = boxes.means(field_of(np.exp(9.0 + 0.02 * x - 0.05 * y)))
    whole = slice(0, 2)  # the rows below the plain are full of ground
    middle_x, middle_y = np.meshgrid(boxes.x, boxes.y)
    expected = 9.0 + 0.02 * middle_x - 0.05 * middle_y
    np.testing.assert_allclose(means[whole], expected[whole], atol=0.05 * 0.25 / 2)


def test_cells_that_the_sampler_leaves_out_do_not_count():
    values = np.full(GRID.shape, 20e3)
    values[:, : GRID.shape[1] // 2] = np.nan
    (means,) = box_map(SLOPE, GRID).means(field_of(values))
    assert np.isnan(means[0, 0])
    assert means[0, -1] == pytest.approx(np.log(20e3))


def test_a_coarse_field_fills_all_boxes():
    """Where boxes are smaller than the cells of the field each has its cell's value."""
    grid = ReferenceGrid.covering(SLOPE.width, SLOPE.top, 6.0)
    field = Strengths(grid, ("cohesion",), np.full((1, *grid.shape), 20e3))
    np.testing.assert_allclose(box_map(SLOPE, grid).means(field)[0, :2], np.log(20e3), rtol=1e-14)


def test_the_map_is_the_same_on_every_mesh():
    coarse, fine = (prepare(small_scene(f"numerics.cell={cell} m", "numerics.gravity=ramp")) for cell in (2, 1))
    np.testing.assert_array_equal(coarse.boxes.means(coarse.draw(3)), fine.boxes.means(fine.draw(3)))
    assert coarse.coordinates["property"].tolist() == ["cohesion", "friction_angle"]


def test_a_record_knows_its_field():
    ground = prepare(small_scene("numerics.end_time=2 s"))
    strength = ground.released(1)
    record = ground.simulate(1)
    moved = record.values["displaced"] == 1
    assert 0 < moved.sum() < moved.size
    mean = np.average(strength.cohesion[moved], weights=ground.in_situ.volume[moved])
    assert record.values["sliding_cohesion"] == pytest.approx(mean, rel=1e-12)
    sizes = SimpleNamespace(**{name: ground.coordinates[name].size for name in ("property", "box_x", "box_y")})
    assert record.values["field_map"].shape == (sizes.property, sizes.box_y, sizes.box_x)
    uniform = ground.simulate(BASELINE).values
    assert uniform["sliding_cohesion"] == pytest.approx(20e3) == uniform["slip_cohesion"]
    np.testing.assert_allclose(uniform["field_map"][0][:2], np.log(20e3), rtol=1e-6)
