"""What is read off the particles, on states made by hand."""

import numpy as np
import pytest
from driver import MUSL, begin

from solver import observables
from solver.filling import fill_ground
from solver.grid import allocate_grid
from solver.particles import allocate_particles, copy_particles
from solver.slide import PAPER
from solver.step import allocate_workspace
from solver.surface import Surface

CUT = Surface(np.array([0.0, 10.0, 10.0, 30.0]), np.array([8.0, 8.0, 4.0, 4.0]), 10.0)


def start_and_now(x, y, shift, volume=1.0):
    start = allocate_particles(np.array(x, dtype=float), np.array(y, dtype=float), volume, 2000.0)
    now = copy_particles(start)
    now.x[:] += shift
    return start, now


def test_runout_is_the_advance_of_the_front_of_the_ground_upslope_of_the_toe():
    start, now = start_and_now([9.0, 8.0, 12.0], [5.0, 6.0, 3.0], [3.0, 5.5, 9.0])
    assert observables.runout(now, start, CUT, PAPER) == pytest.approx(3.5)  # not the third, which lay beyond the toe


def test_runout_counts_only_particles_displaced_more_than_a_tenth_of_a_metre():
    start, now = start_and_now([9.95], [5.0], [0.099])
    assert observables.runout(now, start, CUT, PAPER) == 0.0
    start, now = start_and_now([9.95], [5.0], [0.101])
    assert observables.runout(now, start, CUT, PAPER) == pytest.approx(0.051)


def test_runout_behind_the_toe_is_zero():
    start, now = start_and_now([2.0], [5.0], [3.0])
    assert observables.runout(now, start, CUT, PAPER) == 0.0
    assert observables.runout_mass(now, start, CUT, PAPER) == 0.0


def test_runout_of_nothing_is_zero():
    start, now = start_and_now([2.0, 3.0], [5.0, 6.0], [0.0, 0.0])
    assert observables.runout(now, start, CUT, PAPER) == observables.runout_mass(now, start, CUT, PAPER) == 0.0
    assert observables.sliding_volume(now, start, PAPER) == 0.0


def test_mass_front_is_interpolated_between_particles():
    """Areas of 0.1 m2 at 14, 13, 12, 11 m: 0.25 m2 lies ahead of 12 m, where half of the third particle does."""
    start, now = start_and_now([9.0, 8.0, 7.0, 6.0], [5.0] * 4, 5.0, volume=0.1)
    assert observables.runout_mass(now, start, CUT, PAPER) == pytest.approx(2.0)
    start.volume[0] = 0.15
    assert observables.runout_mass(now, start, CUT, PAPER) == pytest.approx(2.0 + 0.5)


def test_ground_that_has_come_apart_weighs_no_more_in_the_mass_front():
    start, now = start_and_now([9.0, 8.0, 7.0, 6.0], [5.0] * 4, 5.0, volume=0.1)
    now.volume[:] = 5.0
    assert observables.runout_mass(now, start, CUT, PAPER) == pytest.approx(2.0)


def test_mass_front_does_not_depend_on_the_order_of_the_particles():
    rng = np.random.default_rng(0)
    start, now = start_and_now(rng.uniform(5, 10, 200), rng.uniform(4.1, 8, 200), rng.uniform(0, 9, 200), volume=0.06)
    order = rng.permutation(200)
    shuffled = [type(p)(*(array[order] for array in p)) for p in (now, start)]
    assert observables.runout_mass(*shuffled, CUT, PAPER) == pytest.approx(
        observables.runout_mass(now, start, CUT, PAPER), rel=1e-14
    )


def test_mass_front_changes_continuously():
    """One particle overtaking another must not make it jump: its rate stays below that of the fastest particle."""
    start, now = start_and_now([9.0, 8.0, 7.0, 6.0], [5.0] * 4, 3.0, volume=0.1)
    fronts = []
    for overtaker in np.linspace(0.0, 6.0, 601):
        now.x[3] = 9.0 + overtaker
        fronts.append(observables.runout_mass(now, start, CUT, PAPER))
    assert np.abs(np.diff(fronts)).max() <= 0.01 + 1e-12


def test_mass_front_of_less_than_its_area_is_zero():
    start, now = start_and_now([9.0, 8.0], [5.0, 5.0], 5.0, volume=0.1)
    assert observables.runout_mass(now, start, CUT, PAPER) == 0.0


def test_sliding_volume_is_the_area_before_the_slide():
    start, now = start_and_now([1.0, 2.0, 3.0], [5.0] * 3, [0.05, 0.2, 1.0], volume=0.0625)
    now.volume[:] *= 1.5
    assert observables.sliding_volume(now, start, PAPER) == pytest.approx(0.125)


def test_deposit_surface_of_level_ground_is_its_height():
    ground = fill_ground(Surface(np.array([0.0, 6.0]), np.array([2.0, 2.0])), 0.5, 4, 2000.0)
    np.testing.assert_allclose(observables.deposit_surface(ground, 0.125, np.linspace(0, 6, 13)), 2.0, rtol=1e-12)


def test_deposit_surface_conserves_area_over_columns_of_any_width():
    rng = np.random.default_rng(1)
    debris = allocate_particles(rng.uniform(1.0, 9.0, 500), rng.uniform(0.0, 3.0, 500), 0.0625, 2000.0)
    edges = np.concatenate([[0.0], np.sort(rng.uniform(0.0, 10.0, 30)), [10.0]])
    surface = observables.deposit_surface(debris, 0.125, edges)
    assert np.sum(surface * np.diff(edges)) == pytest.approx(500 * 0.0625, rel=1e-12)
    assert surface.min() >= -1e-12


def test_deposit_surface_shares_a_particle_between_its_columns():
    """A square of 0.2 m a side around x = 0.95 has three quarters of its area left of 1 m."""
    grain = allocate_particles(np.array([0.95]), np.array([1.0]), 0.04, 2000.0)
    np.testing.assert_allclose(
        observables.deposit_surface(grain, 0.1, np.array([0.0, 1.0, 2.0])), [0.03, 0.01], rtol=1e-12
    )


def ground_on_a_grid(has_walls):
    ground = fill_ground(Surface(np.array([0.0, 3.0]), np.array([2.0, 2.0])), 0.5, 4, 2000.0)
    grid, work = allocate_grid(3.0, 3.0, 0.5, 0.25), allocate_workspace(ground.x.size)
    if not has_walls:
        grid.free_x[:] = grid.free_y[:] = 1.0
    return ground, grid, work


def test_grid_sees_all_energy_of_a_translation_and_less_of_noise():
    ground, grid, work = ground_on_a_grid(has_walls=False)
    ground.velocity_x[:], ground.velocity_y[:] = 3.0, -4.0
    assert observables.fastest(ground) == pytest.approx(5.0)
    begin(ground, grid, work, MUSL)
    energy = 0.5 * 2000.0 * 6.0 * 25.0
    assert observables.kinetic_energy(ground) == pytest.approx(energy, rel=1e-12)
    assert observables.resolved_kinetic_energy(grid) == pytest.approx(energy, rel=1e-12)
    ground.velocity_x[:] = np.random.default_rng(2).normal(size=ground.x.size)
    begin(ground, grid, work, MUSL)
    assert observables.resolved_kinetic_energy(grid) < observables.kinetic_energy(ground)


def test_nodes_that_cannot_move_carry_no_energy():
    """Noise inside a cell shows as momentum of wall nodes, which moves nothing. A wall holds half a cell of mass."""
    ground, grid, work = ground_on_a_grid(has_walls=True)
    ground.velocity_x[:], ground.velocity_y[:] = 3.0, -4.0
    begin(ground, grid, work, MUSL)
    movable_x, movable_y = (3.0 - 0.5) * (2.0 - 0.25), 3.0 * (2.0 - 0.25)
    energy = 0.5 * 2000.0 * (9.0 * movable_x + 16.0 * movable_y)
    assert observables.resolved_kinetic_energy(grid) == pytest.approx(energy, rel=1e-12)


def test_what_counts_behind_the_crest_is_how_far_its_surface_has_moved():
    """It moves by 2 m behind x = 7 m, by 0.2 m behind 4 m, and the crest is at 10 m; ground below does not count."""
    ground = fill_ground(CUT, 0.5, 4, 2000.0)
    now = copy_particles(ground)
    now.x[(ground.x > 4.0) & (ground.x < 10.0)] += 0.2
    now.x[(ground.x > 7.0) & (ground.x < 10.0)] += 1.8
    now.x[(ground.x > 2.0) & (ground.y < 7.0)] += 2.0
    for farther_than, distance in ((PAPER.failed, 3.0), (PAPER.displaced, 6.0), (3.0, 0.0)):
        assert observables.moved_behind_crest(now, ground, CUT, farther_than, 0.25) == pytest.approx(distance)


def test_without_a_slide_and_within_the_face_nothing_is_lost_behind_the_crest():
    slope = Surface(np.array([0.0, 10.0, 14.0, 30.0]), np.array([8.0, 8.0, 4.0, 4.0]), 14.0)
    ground = fill_ground(slope, 0.5, 4, 2000.0)
    assert observables.moved_behind_crest(ground, ground, slope, 0.1, 0.25) == 0.0
    now = copy_particles(ground)
    now.x[(ground.x > 12.0) & (ground.x < 14.0)] += 0.2
    assert observables.moved_behind_crest(now, ground, slope, 0.1, 0.25) == 0.0
