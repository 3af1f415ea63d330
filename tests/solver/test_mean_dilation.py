"""Cell means of dilation and pressure: what they leave alone, and that forces and stresses do the same work."""

import numpy as np
import pytest
from parts_of_a_step import deform, pool_each, spread_all
from small_slope import small_model, with_strength

from solver import cells, mean_dilation
from solver._jit import kernel
from solver.constants import LANE_COUNT
from solver.filling import ground_of
from solver.in_situ import in_situ_state
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.march import MarchEnd, march_to_rest
from solver.operations import INTERNAL_WORK
from solver.particles import copy_particles
from solver.scheme import STRESS_UPDATES, CellScheme
from solver.softening import NO_SOFTENING
from solver.sorting import fill_tiles
from solver.step import allocate_workspace
from solver.tiles import MASS, MOVED_X, MOVED_Y, NUMBER, X, Y, get, place_of, put

MODEL = small_model()
CURED = MODEL._replace(method=MODEL.method._replace(locking="cell-average"))
USL_CURED = CellScheme(STRESS_UPDATES["usl"])
SOFT = mohr_coulomb(Constants(1e-3, 0.0, 0.0, NO_SOFTENING))  # the stress stays what it is


@pytest.fixture(scope="module")
def disturbed():
    """Particles off the lattice under random stress, of unequal volume."""
    rng = np.random.default_rng(3)
    particles = ground_of(MODEL)
    for place in (particles.x, particles.y):
        place += rng.uniform(-0.1, 0.1, place.size)
    for stress in (particles.stress_xx, particles.stress_yy, particles.stress_zz, particles.stress_xy):
        stress[:] = rng.normal(0.0, 1e4, stress.size)
    particles.volume[:] *= rng.uniform(0.8, 1.2, particles.volume.size)
    return particles


@kernel
def read_pressure(tiles, grid, means):
    """Fill ``means`` (n,) with what the particles read of the pressure of their cells."""
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            shares = cells.shares_of(get(tiles, block, X), get(tiles, block, Y), row, column, grid)
            put(tiles, block, MOVED_X, cells.read(grid.cell_pressure, row, column, shares, grid))
            for lane in range(LANE_COUNT):
                if tiles.blocks[block, MASS, lane] > 0.0:
                    means[int(tiles.blocks[block, NUMBER, lane])] = tiles.blocks[block, MOVED_X, lane]
            block = tiles.following[block]


def averaged(particles, pressure):
    """Return the mean of the cells, seen by the particles, of a ``pressure`` (n,)."""
    stressed, means = copy_particles(particles), np.empty_like(pressure)
    stressed.stress_xx[:] = stressed.stress_yy[:] = pressure
    grid = CURED.allocate_grid()
    tiles = fill_tiles(stressed, grid, allocate_workspace(pressure.size).tiles)
    pool_each(tiles, grid, USL_CURED)
    read_pressure(tiles, grid, means)
    return means


def test_a_mean_replaces_the_dilation_and_leaves_the_shear_alone():
    xx, xy, yx, yy = mean_dilation.with_mean_dilation((0.3, 0.5, -0.2, 0.1), 0.6)
    assert xx + yy == pytest.approx(0.6)
    assert (xx - yy, xy, yx) == (pytest.approx(0.2), 0.5, -0.2)


def test_a_uniform_value_stays(disturbed):
    np.testing.assert_allclose(averaged(disturbed, np.full(disturbed.x.size, 0.3)), 0.3, rtol=1e-13)


def test_the_mean_keeps_the_change_of_volume_and_is_self_adjoint(disturbed):
    a, b = np.random.default_rng(4).normal(size=(2, disturbed.x.size))
    volume = disturbed.volume
    assert np.sum(volume * averaged(disturbed, a)) == pytest.approx(np.sum(volume * a), abs=1e-12)
    assert np.sum(volume * b * averaged(disturbed, a)) == pytest.approx(np.sum(volume * a * averaged(disturbed, b)))


def test_on_the_lattice_the_particles_of_a_cell_read_alike():
    particles = ground_of(MODEL)
    value = np.random.default_rng(5).normal(size=particles.x.size)
    cell = np.floor(particles.x / MODEL.cell_size) + 1000 * np.floor(particles.y / MODEL.cell_size)
    mean = averaged(particles, value)
    for c in np.unique(cell):
        np.testing.assert_allclose(mean[cell == c], value[cell == c].mean(), atol=1e-12)


def test_nodal_forces_do_the_work_of_the_stresses(disturbed):
    """Virtual work: ``-sum_i f_i . v_i dt = sum_p V_p s_p : Lbar_p dt`` for any nodal velocity."""
    particles = copy_particles(disturbed)
    grid, work, dt = CURED.allocate_grid(), allocate_workspace(particles.x.size), 1e-9
    tiles = fill_tiles(particles, grid, work.tiles)
    spread_all(tiles, grid, USL_CURED)
    velocity = np.random.default_rng(6).normal(size=grid.velocity.shape)
    power = -np.sum(grid.force * velocity)
    grid.velocity[:] = velocity
    tiles.blocks[:, MOVED_X], tiles.blocks[:, MOVED_Y] = tiles.blocks[:, X], tiles.blocks[:, Y]
    assert deform(tiles, grid, work, (SOFT,), USL_CURED, 0.0, dt)
    assert work.ledger[INTERNAL_WORK] / dt == pytest.approx(power, rel=1e-6)


@pytest.mark.parametrize("stress_update", ["musl", "usf"])
def test_a_cured_slide_keeps_its_energy_and_comes_to_rest(stress_update):
    """USL is left out: it destroys 4 % of the energy of this slide, cured or not."""
    model = small_model(plain=15.0, stress_update=stress_update)
    model = model._replace(method=model.method._replace(locking="cell-average"))
    slide = march_to_rest(model, with_strength(in_situ_state(model)), np.linspace(0.0, 10.0, 101))
    assert slide.end is MarchEnd.AT_REST
    assert abs(slide.energy_error) < 0.005
