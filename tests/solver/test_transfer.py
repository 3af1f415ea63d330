"""Conservation between particles and grid."""

import numpy as np
import pytest
from driver import MUSL
from parts_of_a_step import begin

from solver._jit import kernel
from solver.constants import LANE_COUNT
from solver.filling import fill_ground
from solver.grid import allocate_grid
from solver.lanes import store
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.particles import allocate_particles
from solver.scheme import STRESS_UPDATES, Scheme
from solver.softening import NO_SOFTENING
from solver.sorting import fill_tiles
from solver.step import advance, allocate_workspace
from solver.surface import Surface
from solver.tiles import MASS, NUMBER, X, Y, get, place_of
from solver.transfer import gradient, interpolate, weights_of

CELL = 0.5
SOIL = mohr_coulomb(Constants(10e6, 0.3, 0.0, NO_SOFTENING))
HALF_LENGTHS = [1e-6, 0.25, 0.5]


def places_of_nodes(grid):
    """Return x and y of the nodes in m, each (rows, columns)."""
    j, i = np.indices(grid.mass.shape)
    return grid.origin + i * CELL, grid.origin + j * CELL


def random_particles(n=1000, seed=0):
    """Return particles with random state, of which the last block is not full."""
    rng = np.random.default_rng(seed)
    particles = allocate_particles(rng.uniform(1.0, 5.0, n), rng.uniform(1.0, 3.0, n), 0.05, 2000.0)
    for name in ("velocity_x", "velocity_y", "stress_xx", "stress_yy", "stress_zz", "stress_xy"):
        getattr(particles, name)[:] = rng.normal(size=n)
    particles.mass[:] = rng.uniform(50.0, 150.0, n)
    return particles


def free_grid(width, height, half_length):
    """Return a grid without walls."""
    grid = allocate_grid(width, height, CELL, half_length)
    grid.free_x[:] = grid.free_y[:] = 1.0
    return grid


@pytest.mark.parametrize("half_length", HALF_LENGTHS)
def test_mass_and_momentum_reach_the_grid_and_internal_forces_balance(half_length):
    particles = random_particles()
    grid = free_grid(6.0, 4.0, half_length)
    begin(particles, grid, allocate_workspace(particles.x.size), MUSL)
    momentum = [np.sum(particles.mass * v) for v in (particles.velocity_x, particles.velocity_y)]
    assert grid.mass.sum() == pytest.approx(particles.mass.sum(), rel=1e-13)
    np.testing.assert_allclose(grid.momentum.sum(axis=(0, 2)), momentum, rtol=1e-12)
    np.testing.assert_allclose(grid.force.sum(axis=(0, 2)), 0.0, atol=1e-11 * np.abs(grid.force).max())


@pytest.mark.parametrize("half_length", HALF_LENGTHS)
def test_internal_forces_of_a_symmetric_stress_exert_no_moment(half_length):
    """``sum_i x_i (x) f_i = -sum_p V_p sigma_p`` by linear reproduction, which is symmetric."""
    particles = random_particles()
    grid = free_grid(6.0, 4.0, half_length)
    begin(particles, grid, allocate_workspace(particles.x.size), MUSL)
    places = np.stack(places_of_nodes(grid))
    xx, yy, xy = (
        -np.sum(particles.volume * s) for s in (particles.stress_xx, particles.stress_yy, particles.stress_xy)
    )
    moments = np.einsum("ajk,jbk->ab", places, grid.force)
    np.testing.assert_allclose(moments, [[xx, xy], [xy, yy]], rtol=0.0, atol=1e-9)


@kernel
def read_field(tiles, grid, values, gradients):
    """Fill ``values`` (n, 2) and ``gradients`` (n, 4) with what the particles read of the nodal velocity."""
    lanes = np.empty((6, LANE_COUNT))
    for tile in range(tiles.first.size):
        row, column = place_of(tile, grid)
        block = tiles.first[tile]
        while block >= 0:
            w = weights_of(get(tiles, block, X), get(tiles, block, Y), row, column, grid)
            x, y = interpolate(grid.velocity, row, column, w, grid)
            xx, xy, yx, yy = gradient(grid.velocity, row, column, w, grid)
            store(lanes, 0, x)
            store(lanes, LANE_COUNT, y)
            store(lanes, 2 * LANE_COUNT, xx)
            store(lanes, 3 * LANE_COUNT, xy)
            store(lanes, 4 * LANE_COUNT, yx)
            store(lanes, 5 * LANE_COUNT, yy)
            for lane in range(LANE_COUNT):
                if tiles.blocks[block, MASS, lane] > 0.0:
                    p = int(tiles.blocks[block, NUMBER, lane])
                    values[p], gradients[p] = lanes[:2, lane], lanes[2:, lane]
            block = tiles.following[block]


@pytest.mark.parametrize("half_length", HALF_LENGTHS)
def test_a_linear_velocity_field_is_read_back_exactly(half_length):
    grid = free_grid(6.0, 4.0, half_length)
    particles = random_particles(100, seed=1)
    tiles = fill_tiles(particles, grid, allocate_workspace(100).tiles)
    L = np.array([[0.3, -1.2], [0.7, 2.0]])
    grid.velocity[:] = np.einsum("ab,bjk->jak", L, np.stack(places_of_nodes(grid)))
    values, gradients = np.empty((100, 2)), np.empty((100, 4))
    read_field(tiles, grid, values, gradients)
    np.testing.assert_allclose(values, np.stack([particles.x, particles.y], axis=1) @ L.T, atol=1e-8)
    np.testing.assert_allclose(gradients, np.broadcast_to(L.ravel(), (100, 4)), atol=1e-8)


@pytest.mark.parametrize("stress_update", STRESS_UPDATES)
@pytest.mark.parametrize("flip", [1.0, 0.9])
def test_a_free_body_keeps_its_momentum_to_round_off(stress_update, flip):
    particles = random_particles(seed=2)
    particles.stress_xx[:] *= 1e3
    grid, work = free_grid(6.0, 4.0, 0.25), allocate_workspace(particles.x.size)
    before = [np.sum(particles.mass * v) for v in (particles.velocity_x, particles.velocity_y)]
    size = np.sum(particles.mass * np.hypot(particles.velocity_x, particles.velocity_y))
    scheme = Scheme(STRESS_UPDATES[stress_update], flip, 0.0)
    assert advance(particles, grid, work, (SOIL,), scheme, 0.0, 0.0, 1e-4, 100) == 100
    after = [np.sum(particles.mass * v) for v in (particles.velocity_x, particles.velocity_y)]
    np.testing.assert_allclose(after, before, rtol=0.0, atol=1e-12 * size)


@pytest.mark.parametrize("stress_update", STRESS_UPDATES)
def test_free_fall_is_exact(stress_update):
    """Velocity ``-g t`` and, because a place moves with the velocity at the end of its step, ``g t (t + dt) / 2``."""
    block = fill_ground(Surface(np.array([0.0, 1.0]), np.array([1.0, 1.0])), CELL, 4, 2000.0)
    block.x[:] += 2.1
    block.y[:] += 3.07
    grid, work = free_grid(5.0, 5.0, 0.25), allocate_workspace(block.x.size)
    height, dt, steps = block.y.copy(), 1e-3, 500
    advance(block, grid, work, (SOIL,), Scheme(STRESS_UPDATES[stress_update], 1.0, 0.0), 9.81, 0.0, dt, steps)
    t = steps * dt
    np.testing.assert_allclose(block.velocity_y, -9.81 * t, rtol=1e-12)
    np.testing.assert_allclose(block.velocity_x, 0.0, atol=1e-12)
    np.testing.assert_allclose(height - block.y, 9.81 * t * (t + dt) / 2.0, rtol=1e-12)
    np.testing.assert_allclose(block.stress_yy, 0.0, atol=1e-4)  # of 10 MPa: round-off of the strain
    np.testing.assert_allclose(block.volume, CELL**2 / 4, rtol=1e-11)
