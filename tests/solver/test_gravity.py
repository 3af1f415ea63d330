"""The in-situ state."""

import numpy as np
import pytest
from parts_of_a_step import begin
from small_slope import small_model

from solver import in_situ, observables
from solver.balance import felt_share, unbalanced_share
from solver.constants import STANDARD_GRAVITY
from solver.filling import ground_of
from solver.in_situ import LOCAL_DAMPING, UNBALANCED, NotSettledError, Stall, in_situ_state, lay_geostatic_stress
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.materials import Material
from solver.particles import copy_particles
from solver.scheme import STRESS_UPDATES, Scheme
from solver.softening import NO_SOFTENING
from solver.step import advance, allocate_workspace
from solver.surface import Surface
from solver.timestep import stable_step

BUMP = Surface(np.array([0.0, 4.0, 6.0, 8.0, 12.0]), np.array([4.1, 4.1, 4.28, 4.1, 4.1]))
LEVEL = Surface(np.array([0.0, 5.0]), np.array([4.0, 4.0]))


def assert_geostatic(ground, model, tolerance):
    """``s_yy = -gamma depth``, ``s_xx = s_zz = nu / (1 - nu) s_yy``, no shear, over the stress at the base."""
    unit_weight = model.materials[0].unit_weight
    poisson_ratio = model.materials[0].poisson_ratio
    k0 = poisson_ratio / (1.0 - poisson_ratio)
    vertical = -unit_weight * (4.0 - ground.y)
    size = 4.0 * unit_weight
    np.testing.assert_allclose(ground.stress_yy, vertical, atol=tolerance * size)
    np.testing.assert_allclose(ground.stress_xx, k0 * vertical, atol=tolerance * size)
    np.testing.assert_allclose(ground.stress_zz, k0 * vertical, atol=tolerance * size)
    np.testing.assert_allclose(ground.stress_xy, 0.0, atol=1e-9 * size)


def test_level_ground_rests_in_the_geostatic_state():
    model = small_model()._replace(surface=LEVEL)
    assert_geostatic(in_situ_state(model), model, tolerance=1e-3)


def test_level_ground_finds_the_geostatic_state_from_nothing():
    """The laid stress is a head start: damped motion leads to the same, but for settlement and the surface it moves.

    Once the surface lies between node lines, a quarter to a third of a cell of weight is missing at every depth.
    """
    model = small_model()._replace(surface=LEVEL)
    ground = ground_of(model)
    grid, work = model.allocate_grid(), allocate_workspace(ground.x.size)
    dt = stable_step(0.5, model.cell_size, model.wave_speed, 0.0)
    scheme = Scheme(STRESS_UPDATES["musl"], 1.0, LOCAL_DAMPING)
    advance(ground, grid, work, model.laws, scheme, STANDARD_GRAVITY, 0.0, dt, 2000)
    assert unbalanced_share(grid, STANDARD_GRAVITY) < 1e-6
    assert_geostatic(ground, model, tolerance=model.cell_size / 3.0 / 4.0)


def test_in_situ_slope_is_at_rest_elastic_and_balanced():
    model = small_model()
    start = in_situ_state(model)
    assert observables.kinetic_energy(start) == 0.0
    assert np.all(start.plastic_strain == 0.0)
    grid, work = model.allocate_grid(), allocate_workspace(start.x.size)
    advance(start, grid, work, model.laws, model.scheme, STANDARD_GRAVITY, 0.0, 1e-9, 1)
    assert unbalanced_share(grid, STANDARD_GRAVITY) < 2e-4
    movable_weight = STANDARD_GRAVITY * grid.mass[grid.free_y == 1.0].sum()  # nodes of the base carry their own
    assert -np.sum(grid.force[:, 1][grid.free_y == 0.0]) == pytest.approx(movable_weight, rel=1e-3)


def test_vertical_stress_under_a_slope_carries_its_weight():
    """Integrated over any horizontal plane: the mean of ``s_yy`` times the width is the weight above."""
    model = small_model()
    start = in_situ_state(model)
    row = np.isclose(start.y, start.y.min(), atol=0.05)
    carried = -np.sum(start.stress_yy[row]) * 0.25
    above = STANDARD_GRAVITY * (start.mass.sum() - 0.5 * start.mass[row].sum())
    assert carried == pytest.approx(above, rel=0.01)


def test_laid_stress_is_zero_at_the_surface_and_never_tension():
    model = small_model()
    ground = ground_of(model)
    lay_geostatic_stress(ground, model)
    assert ground.stress_yy.max() <= 0.0
    depth = model.surface.height_at(ground.x) - ground.y
    np.testing.assert_allclose(ground.stress_yy, -2000.0 * STANDARD_GRAVITY * depth, atol=1e-6)


def bumpy_model():
    """Return level ground with a bump of two particles, which three nodes share that carry nothing else."""
    law = mohr_coulomb(Constants(30e6, 0.45, 0.0, NO_SOFTENING))
    return small_model()._replace(surface=BUMP, cell_size=1.0, materials=(Material(2000.0, 0.45, law),))


def test_ground_whose_nodal_forces_cancel_at_its_particles_rests_by_the_force_that_they_feel():
    """``sum_i S_ip f_i / m_i = 0`` of forces at three nodes that two particles share: they never go.

    Damping that does not fade holds the particles where they feel 2.1e-4 of the weight, for 30,000 steps at least.
    """
    model = bumpy_model()
    start = in_situ_state(model)
    assert observables.kinetic_energy(start) == 0.0
    grid = model.allocate_grid()
    tiles = begin(start, grid, allocate_workspace(start.x.size), model.scheme)
    assert felt_share(tiles, grid, STANDARD_GRAVITY) < 1.01 * UNBALANCED
    assert unbalanced_share(grid, STANDARD_GRAVITY) > 10.0 * UNBALANCED
    is_heavy = grid.mass > 0.1 * grid.mass.max()
    others = grid._replace(free_x=grid.free_x * is_heavy, free_y=grid.free_y * is_heavy)
    assert unbalanced_share(others, STANDARD_GRAVITY) < 2.0 * UNBALANCED


def test_ground_that_rests_by_the_force_that_particles_feel_stays_where_it_is_when_damping_ends():
    """Elastic ground goes on under its own weight for 2 s, and nothing of it comes near to counting as sliding."""
    model = bumpy_model()
    start = in_situ_state(model)
    particles, grid = copy_particles(start), model.allocate_grid()
    dt = stable_step(model.courant, model.cell_size, model.wave_speed, 0.0)
    work = allocate_workspace(start.x.size)
    advance(particles, grid, work, model.laws, model.scheme, STANDARD_GRAVITY, 0.0, dt, int(2.0 / dt))
    assert observables.displacement(particles, start).max() < 0.01 * model.criteria.displaced


def test_a_force_that_falls_slowly_has_not_stalled_and_one_that_only_swings_has():
    slow, swinging = Stall(patience=10), Stall(patience=10)
    assert not any(slow.has_come(0.97**check) for check in range(300))  # a fifth in 8 checks
    assert [swinging.has_come(force) for force in [3.0, 2.0, 1.0, *[1.0, 0.9] * 5]] == [False] * 12 + [True]


def test_ground_too_soft_to_carry_itself_is_refused():
    soft = small_model()
    law = soft.materials[0].law._replace(bulk_modulus=2e3, shear_modulus=1e3)
    soft = soft._replace(materials=(soft.materials[0]._replace(law=law),))
    complaint = r"under its own weight: it fell apart within \d+ elastic steps; check young_modulus"
    with pytest.raises(NotSettledError, match=complaint):
        in_situ_state(soft)


def test_ground_that_never_rests_is_refused_once_the_damping_has_faded(monkeypatch):
    """No force is below zero: after 10,000 steps without a fall the damping fades in 10,600, and then it is enough."""
    monkeypatch.setattr(in_situ, "UNBALANCED", 0.0)
    complaint = r"in 2\d{4} elastic steps .* 0e\+00 wanted\): it still moves at x = .* m, y = .* m; check young_modulus"
    with pytest.raises(NotSettledError, match=complaint):
        in_situ_state(bumpy_model())
