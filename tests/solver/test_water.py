"""Ground water: its pressure as drawn, at rest, and in ground that moves."""

import numpy as np
import pytest
from small_slope import small_model, with_strength

from solver.in_situ import in_situ_state
from solver.march import March
from solver.overburden import overburden
from solver.particles import Particles, allocate_particles
from solver.pore_pressure import wet_ground_of
from solver.step import advance, allocate_workspace
from solver.surface import Surface
from solver.water import Water

MODEL = small_model()
LEVEL = Surface(np.array([0.0, 5.0]), np.array([4.0, 4.0]))
UNIT_WEIGHT = MODEL.materials[0].unit_weight
SATURATED = MODEL.materials[0]._replace(saturated_density=2200.0)


def level_model(table):
    """Return level ground of 4 m that is saturated below a table at that elevation in m."""
    water = Water(Surface(np.array([0.0, 5.0]), np.array([table, table])))
    return MODEL._replace(surface=LEVEL, materials=(SATURATED,), water=water)


@pytest.mark.parametrize("table", [4.0, 2.5])
def test_saturated_level_ground_carries_its_weight_less_the_pressure_of_the_water(table):
    """``u = gamma_w z`` below the table, ``s_yy = u - gamma d``, ``s_xx = K0 s_yy``: Terzaghi's effective stress."""
    model = level_model(table)
    ground = in_situ_state(model)
    dry, wet = np.minimum(4.0 - ground.y, 4.0 - table), np.maximum(table - ground.y, 0.0)
    total = UNIT_WEIGHT * dry + 2200.0 * 9.81 * wet
    size = 4.0 * UNIT_WEIGHT
    np.testing.assert_allclose(ground.pore_pressure, 9810.0 * wet, atol=1e-3 * size)
    np.testing.assert_allclose(ground.stress_yy, 9810.0 * wet - total, atol=1e-3 * size)
    np.testing.assert_allclose(ground.stress_xx, 0.3 / 0.7 * (9810.0 * wet - total), atol=1e-3 * size)


def test_ground_below_the_table_has_its_saturated_weight():
    ground = wet_ground_of(level_model(2.5))
    np.testing.assert_allclose(ground.mass / ground.volume, np.where(ground.y < 2.5, 2200.0, 2000.0))
    found = overburden(level_model(2.5), np.array([1.0, 1.0]), np.array([3.0, 0.5]))
    np.testing.assert_allclose(found, 9.81 * np.array([2000.0, 1.5 * 2000.0 + 2.0 * 2200.0]))


def test_a_ratio_is_that_of_the_weight_above():
    """``u = r_u gamma d`` before a slide, less the half particle that a slope on its lattice may lack.

    It stays so to 0.1 % of the stress at the base while the ground settles elastically.
    """
    model = MODEL._replace(water=Water(ratio=0.4))
    ground = wet_ground_of(model)
    lacking = model.surface.height_at(ground.x) - ground.y - ground.pore_pressure / (0.4 * UNIT_WEIGHT)
    assert lacking.min() > -1e-9
    assert np.quantile(lacking, [0.5, 0.9, 1.0]) == pytest.approx([0.0, 0.125, 0.148], abs=0.005)
    np.testing.assert_allclose(in_situ_state(model).pore_pressure, ground.pore_pressure, atol=4.0 * UNIT_WEIGHT * 1e-3)


def test_no_ground_carries_more_of_its_weight_by_pore_pressure_than_is_drawn():
    """Not even at a cliff, where half of the columns that nodes see are empty."""
    cliff = Surface(np.array([0.0, 3.0, 3.0, 12.0]), np.array([4.0, 4.0, 1.0, 1.0]), 3.0)
    ground = wet_ground_of(MODEL._replace(surface=cliff, water=Water(ratio=0.4)))
    assert np.max(ground.pore_area / ground.volume) == pytest.approx(0.4, rel=1e-12)


def test_dry_ground_is_ground_with_a_ratio_of_zero():
    dry, wet = (in_situ_state(MODEL._replace(water=water)) for water in (Water(), Water(unit_weight=1.0)))
    for one, other in zip(dry, wet, strict=True):
        np.testing.assert_array_equal(one, other)


def lake_model(level, surface=MODEL.surface):
    """Return a saturated slope in a lake of that level (m), with the water table at the surface above the lake."""
    elevation = np.maximum(surface.y, level)
    water = Water(Surface(surface.x, elevation), level=level)
    return MODEL._replace(surface=surface, materials=(SATURATED,), water=water)


def test_a_slope_under_water_is_one_of_its_buoyant_weight():
    """Archimedes: effective stresses are those of dry ground that weighs ``gamma_sat - gamma_w``."""
    under_water = in_situ_state(lake_model(level=6.0))
    buoyant = MODEL.materials[0]._replace(density=2200.0 - 9810.0 / 9.81)
    dry = in_situ_state(MODEL._replace(materials=(buoyant,)))
    size = np.abs(dry.stress_yy).max()
    for name in ("stress_xx", "stress_yy", "stress_zz", "stress_xy"):
        np.testing.assert_allclose(getattr(under_water, name), getattr(dry, name), atol=2e-3 * size)
    np.testing.assert_allclose(under_water.pore_pressure, 0.0, atol=2e-3 * size)


def test_a_body_in_water_sinks_by_its_weight_less_that_of_the_water():
    """Archimedes: ``a = g (1 - rho_w / rho)`` under water, g above it, and half the lift where it is half submerged."""
    y = np.array([1.0, 3.0, 5.0])
    body = allocate_particles(np.full(3, 2.25), y, 0.0625, 2200.0)
    model = lake_model(level=3.0)
    grid, work = model.allocate_grid(), allocate_workspace(3)
    assert advance(body, grid, work, model.laws, model.scheme, 9.81, 0.0, 1e-4, 1) == 1
    np.testing.assert_allclose(body.velocity_y, -9.81e-4 * (1.0 - np.array([1.0, 0.5, 0.0]) / 2.2), rtol=1e-9)


def test_pressure_under_a_lake_is_that_of_the_water_column():
    """``u = gamma_w (z - y)``, of which the particles carry what the table is above the lake."""
    model = lake_model(level=2.0)
    ground = wet_ground_of(model)
    column = model.water.height_at(ground.x) - ground.y
    lacking = column - (ground.pore_pressure + model.water.standing_pressure(ground.y)) / 9810.0
    assert lacking.min() > -1e-9
    under_level_ground = (ground.x < 2.0) | (ground.x > 7.0)
    assert lacking[under_level_ground].max() < 1e-9
    assert lacking.max() < 0.25


def test_ground_that_slides_under_water_carries_the_load_of_the_lake_in_its_pores():
    """Undrained: its own ratio of its weight, and the lake on its surface, so that the effective stress stays."""
    model = lake_model(level=2.0)
    ground = wet_ground_of(model)
    upper = ground.y > 3.0
    ground.y[:] -= 2.5
    ground.velocity_y[:] = 0.0
    alone = Particles(*(array[upper] for array in ground))
    before = alone.pore_pressure.copy()
    grid, work = model.allocate_grid(), allocate_workspace(alone.x.size)
    advance(alone, grid, work, model.laws, model.scheme, 9.81, 0.0, 1e-6, 1)
    own_depth = 4.0 - (alone.y + 2.5)
    is_inside = (alone.x < 2.0) & (own_depth > 0.25)
    assert is_inside.sum() == 24
    expected = before - 9810.0 * own_depth
    np.testing.assert_allclose(alone.pore_pressure[is_inside], expected[is_inside], atol=0.05 * 9810.0)


@pytest.mark.parametrize("level", [1.5, 6.0])
def test_the_work_of_a_lake_is_in_the_ledger(level):
    model = lake_model(level)
    march = March(model, with_strength(in_situ_state(model), cohesion=1e3))
    assert march.advance_to(2.0) is None
    assert march.moment().runout > 0.3
    assert abs(march.energy.error()) < 0.005


@pytest.fixture(scope="module")
def slid():
    """Return a slope with water after it has slid, and before."""
    model = MODEL._replace(water=Water(ratio=0.4))
    start = with_strength(in_situ_state(model))
    march = March(model, start)
    assert march.advance_to(2.0) is None
    return march


def test_pore_pressure_follows_the_ground(slid):
    """Each particle keeps its share of the weight above: of the columns of ground after the slide, to half a cell."""
    after = slid.particles
    assert np.hypot(after.x - slid.start.x, after.y - slid.start.y).max() > 1.0
    columns = np.arange(0.0, slid.model.surface.width, slid.model.cell_size)
    thickness = np.histogram(after.x, columns, weights=after.volume)[0] / slid.model.cell_size
    depth = np.interp(after.x, columns[:-1] + 0.25, thickness) - after.y
    deep = depth > 1.5
    assert deep.sum() > 50
    expected = 0.4 * UNIT_WEIGHT * depth * slid.start.volume / after.volume  # what has loosened carries less
    np.testing.assert_allclose(after.pore_pressure[deep], expected[deep], atol=0.25 * UNIT_WEIGHT)
    assert after.pore_pressure.min() >= 0.0


def test_the_work_of_the_pore_pressure_is_in_the_ledger(slid):
    assert abs(slid.energy.error()) < 0.005


def test_water_makes_a_slope_slide_farther(slid):
    dry = March(MODEL, with_strength(in_situ_state(MODEL)))
    assert dry.advance_to(2.0) is None
    assert slid.moment().runout > dry.moment().runout + 0.3


def test_water_that_carries_much_does_not_drive_ground_apart():
    """With 70 % of the weight on pore water the ground flows, and no particle swells for ever."""
    model = MODEL._replace(water=Water(ratio=0.7))
    march = March(model, with_strength(in_situ_state(model)))
    assert march.advance_to(4.0) is None
    assert abs(march.energy.error()) < 0.01
    swollen = march.particles.volume / march.start.volume
    assert np.quantile(swollen, 0.98) < 2.0
