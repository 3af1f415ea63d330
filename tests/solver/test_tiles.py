"""Blocks of eight particles: nobody is lost or changed on the way in, from tile to tile, or out."""

import numpy as np
import pytest
from parts_of_a_step import move, sorted_tiles

from solver.grid import allocate_grid
from solver.particles import UNYIELDING, allocate_particles, copy_particles
from solver.sorting import fill_tiles, read_tiles
from solver.step import allocate_workspace
from solver.tiles import (
    COHESION,
    FIELDS,
    LEAVERS,
    MASS,
    MOVED_X,
    MOVED_Y,
    NUMBER,
    USED,
    VOLUME,
    X,
    Y,
    allocate_tiles,
    place_of,
    tiles_in_row,
)

N = 700


@pytest.fixture
def particles():
    """Particles of random state, of which some cells have many and most have none."""
    rng = np.random.default_rng(5)
    body = allocate_particles(rng.uniform(-0.4, 9.9, N), rng.uniform(-0.4, 3.0, N) ** 2 / 3.0, 0.05, 2000.0)
    for name in body._fields:
        if name not in ("x", "y", "material"):
            getattr(body, name)[:] = rng.uniform(1.0, 2.0, N)
    body.material[:] = rng.integers(0, 3, N)
    return body


@pytest.fixture(params=[0.25, 0.5, 1e-6])
def grid(request):
    return allocate_grid(10.0, 4.0, 0.5, request.param)


def members(tiles, grid):
    """Return number, tile and lane of every particle that the chains hold."""
    found = []
    for tile, block in enumerate(tiles.first):
        while block >= 0:
            lanes = np.flatnonzero(tiles.blocks[block, MASS] > 0.0)
            found += [(int(tiles.blocks[block, NUMBER, lane]), tile, lane) for lane in lanes]
            block = tiles.following[block]
    return np.array(sorted(found))


def expected_members(x, y, grid):
    """Return the same from the places alone."""
    column, row = (np.floor((place - grid.origin) / grid.cell_size - grid.half_length).astype(int) for place in (x, y))
    tile = row * (grid.columns // 8 - 1) + column // 8
    return np.stack([np.arange(x.size), tile, column % 8], axis=1)


def test_every_particle_is_in_the_lane_of_its_base_cell(particles, grid):
    tiles = fill_tiles(particles, grid, allocate_tiles(N))
    np.testing.assert_array_equal(members(tiles, grid), expected_members(particles.x, particles.y, grid))


def test_an_empty_lane_weighs_nothing_and_stands_in_its_own_cell(particles, grid):
    tiles = fill_tiles(particles, grid, allocate_tiles(N))
    for tile, block in enumerate(tiles.first):
        row, column = place_of(tile, grid)
        while block >= 0:
            for lane in np.flatnonzero(tiles.blocks[block, MASS] == 0.0):
                at = tiles.blocks[block, :, lane]
                assert at[VOLUME] == 0.0
                assert at[COHESION] == UNYIELDING
                places = [(at[axis] - grid.origin) / grid.cell_size - grid.half_length for axis in (X, Y)]
                assert 0.0 <= places[0] - (column + lane) < 1.0
                assert 0.0 <= places[1] - row < 1.0
            block = tiles.following[block]


def test_out_comes_what_went_in(particles, grid):
    before = copy_particles(particles)
    tiles = fill_tiles(particles, grid, allocate_tiles(N))
    for name in ("x", "velocity_x", "stress_xy", "plastic_strain"):
        getattr(particles, name)[:] = -1.0
    read_tiles(tiles, particles)
    for found, expected in zip(particles, before, strict=True):
        np.testing.assert_array_equal(found, expected)
    read_tiles(sorted_tiles(tiles, grid), particles)
    np.testing.assert_array_equal(particles.x, before.x)


def leave(tiles, grid, shift):
    """Move all particles by ``shift`` (2,) in m; return whether all are on the grid."""
    used = tiles.blocks[: tiles.counts[USED]]
    is_there = used[:, MASS] > 0.0
    for old, new, by in zip((X, Y), (MOVED_X, MOVED_Y), shift, strict=True):
        used[:, new] = np.where(is_there, used[:, old] + by, used[:, old])
    return move(tiles, grid, allocate_workspace(N))


@pytest.mark.parametrize("shift", [(0.0, 0.0), (0.04, -0.03), (-0.3, 0.5), (0.37, 0.21)])
def test_whoever_leaves_a_cell_is_found_in_the_next(particles, grid, shift):
    before = copy_particles(particles)
    tiles = fill_tiles(particles, grid, allocate_tiles(N))
    assert leave(tiles, grid, shift)
    np.testing.assert_array_equal(
        members(tiles, grid), expected_members(before.x + shift[0], before.y + shift[1], grid)
    )
    read_tiles(tiles, particles)
    np.testing.assert_array_equal(particles.x, before.x + shift[0])
    np.testing.assert_array_equal(particles.stress_zz, before.stress_zz)


@pytest.mark.parametrize("shift", [(2.0, 0.0), (0.0, -3.0), (np.nan, 0.0)])
def test_whoever_leaves_the_grid_is_told_and_keeps_its_place(particles, grid, shift):
    before = copy_particles(particles)
    tiles = fill_tiles(particles, grid, allocate_tiles(N))
    assert not leave(tiles, grid, shift)
    assert tiles.counts[LEAVERS] > 0
    read_tiles(tiles, particles)
    np.testing.assert_array_equal(particles.x, before.x + shift[0])
    np.testing.assert_array_equal(particles.y, before.y + shift[1])


def test_a_block_is_whole_vectors_on_the_lines_of_the_cache():
    store = allocate_tiles(5)
    assert store.blocks.shape[1:] == (FIELDS, 8)
    assert store.blocks.ctypes.data % 64 == 0
    assert tiles_in_row(allocate_grid(10.0, 4.0, 0.5, 0.25)) == 3
