"""Cell means of dilation and pressure: what they leave alone, and that forces and stresses do the same work."""

import numpy as np
import pytest
from small_slope import small_model, with_strength

from solver import cells, mean_dilation
from solver._jit import kernel
from solver.filling import ground_of
from solver.in_situ import in_situ_state
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.march import MarchEnd, march_to_rest
from solver.operations import INTERNAL_WORK
from solver.particles import copy_particles
from solver.scheme import LOCKING, STRESS_UPDATES, Scheme
from solver.softening import NO_SOFTENING
from solver.step import allocate_workspace, deform, spread_first

MODEL = small_model()
CURED = MODEL._replace(method=MODEL.method._replace(locking="cell-average"))
USL_CURED = Scheme(STRESS_UPDATES["usl"], 1.0, 0.0, LOCKING["cell-average"])
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
def cell_mean(particles, increment, grid):
    cells.clear(grid.cell_dilation, grid)
    mean_dilation.pool_dilation(particles, increment, grid)
    cells.average(grid.cell_dilation, mean_dilation.NO_VOLUME, grid)
    mean_dilation.replace_dilation(particles, increment, grid)


def averaged(particles, dilation):
    """Return the mean of the cells, seen by the particles, of a dilation all in xx."""
    increment = np.zeros((4, dilation.size))
    increment[0] = dilation
    cell_mean(particles, increment, CURED.allocate_grid())
    np.testing.assert_allclose(increment[0] - increment[3], dilation, atol=1e-12)  # the shear is left alone
    return increment[0] + increment[3]


def test_uniform_dilation_stays(disturbed):
    np.testing.assert_allclose(averaged(disturbed, np.full(disturbed.x.size, 0.3)), 0.3, rtol=1e-13)


def test_the_mean_keeps_the_change_of_volume_and_is_self_adjoint(disturbed):
    a, b = np.random.default_rng(4).normal(size=(2, disturbed.x.size))
    volume = disturbed.volume
    assert np.sum(volume * averaged(disturbed, a)) == pytest.approx(np.sum(volume * a), abs=1e-12)
    assert np.sum(volume * b * averaged(disturbed, a)) == pytest.approx(np.sum(volume * a * averaged(disturbed, b)))


def test_on_the_lattice_the_particles_of_a_cell_dilate_alike():
    particles = ground_of(MODEL)
    dilation = np.random.default_rng(5).normal(size=particles.x.size)
    cell = np.floor(particles.x / MODEL.cell_size) + 1000 * np.floor(particles.y / MODEL.cell_size)
    mean = averaged(particles, dilation)
    for c in np.unique(cell):
        np.testing.assert_allclose(mean[cell == c], dilation[cell == c].mean(), atol=1e-12)


def test_nodal_forces_do_the_work_of_the_stresses(disturbed):
    """Virtual work: ``-sum_i f_i . v_i dt = sum_p V_p s_p : Lbar_p dt`` for any nodal velocity."""
    particles = copy_particles(disturbed)
    grid, work, dt = CURED.allocate_grid(), allocate_workspace(particles.x.size), 1e-9
    spread_first(particles, grid, work, USL_CURED)
    velocity = np.random.default_rng(6).normal(size=grid.velocity.shape)
    power = -np.sum(grid.force * velocity)
    grid.velocity[:] = velocity
    work.moved_x[:], work.moved_y[:] = particles.x, particles.y
    assert deform(particles, grid, work, (SOFT,), USL_CURED, 0.0, dt)
    assert work.ledger[INTERNAL_WORK] / dt == pytest.approx(power, rel=1e-6)


@pytest.mark.parametrize("stress_update", ["musl", "usf"])
def test_a_cured_slide_keeps_its_energy_and_comes_to_rest(stress_update):
    """USL is left out: it destroys 4 % of the energy of this slide, cured or not."""
    model = small_model(plain=15.0, stress_update=stress_update)
    model = model._replace(method=model.method._replace(locking="cell-average"))
    slide = march_to_rest(model, with_strength(in_situ_state(model)), np.linspace(0.0, 10.0, 101))
    assert slide.end is MarchEnd.AT_REST
    assert abs(slide.energy_error) < 0.005
