"""The average of plastic strain over the internal length: a Gaussian on the grid, and nothing where there is none."""

import numpy as np
import pytest
from parts_of_a_step import spread_all
from small_slope import small_model, with_strength

from solver.filling import fill_ground
from solver.grid import allocate_grid
from solver.in_situ import in_situ_state
from solver.internal_length import BAND_THICKNESS, coarse_rate_factor, least_thickness, smoothing_weights
from solver.march import march_to_rest
from solver.scheme import STRESS_UPDATES, CellScheme
from solver.sorting import fill_tiles, read_tiles
from solver.surface import Surface
from solver.tiles import PLASTIC_INCREMENT, PLASTIC_STRAIN, allocate_tiles

LENGTH = 1.0  # m
AVERAGING = CellScheme(STRESS_UPDATES["musl"], averages_dilation=False, averages_plastic_strain=True)
LEVEL = Surface(np.array([0.0, 8.0]), np.array([8.0, 8.0]))


def averaged(cell, surface, plastic_strain_at):
    """Return particles of level ground and what an increment ``plastic_strain_at(x, y)`` becomes."""
    particles = fill_ground(surface, cell, 4, 2000.0)
    particles.plastic_strain[:] = plastic_strain_at(particles.x, particles.y)
    grid = allocate_grid(surface.width, surface.top + cell, cell, 0.25, smoothing_weights(LENGTH, cell, 0.25))
    tiles = fill_tiles(particles, grid, allocate_tiles(particles.x.size))
    tiles.blocks[:, PLASTIC_INCREMENT] = tiles.blocks[:, PLASTIC_STRAIN]
    tiles.blocks[:, PLASTIC_STRAIN] = 0.0
    spread_all(tiles, grid, AVERAGING)
    read_tiles(tiles, particles)
    return particles


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0, 3.7, 8.0])
def test_the_filter_keeps_the_sum_and_has_the_variance_that_pooling_and_the_band_lack(ratio):
    """``sigma^2 = l^2 / 2 pi`` in cells squared, less theirs; here the cell is 1 m."""
    weights = smoothing_weights(ratio, 1.0, 0.25)
    k = np.arange(weights.size) - weights.size // 2
    assert np.all(weights >= 0.0)
    np.testing.assert_allclose(weights.sum(), 1.0, rtol=1e-14)
    expected = max(0.0, ratio**2 - least_thickness(0.25) ** 2) / (2.0 * np.pi)
    np.testing.assert_allclose(weights @ k**2, expected, atol=1e-13)


def test_even_plastic_strain_stays_as_it_is_up_to_walls_and_surface():
    """The quotient of two sums smoothed alike."""
    particles = averaged(
        0.25, Surface(np.array([0.0, 2.0, 6.0]), np.array([3.0, 3.0, 1.0])), lambda x, y: 0.3 + 0.0 * x
    )
    np.testing.assert_allclose(particles.plastic_strain, 0.3, rtol=1e-12)


@pytest.mark.parametrize("angle", [0.0, 30.0, 45.0])
def test_a_band_weakens_its_middle_as_if_it_were_one_internal_length_thick(angle):
    """``eps_p`` of integral ``u`` across becomes ``u / l`` in the middle, in any direction; 3 % at ten cells a length.

    The band is as thick as the grid makes them: a Gaussian whose integral over its height is ``BAND_THICKNESS`` cells.
    """
    normal = np.array([-np.sin(np.radians(angle)), np.cos(np.radians(angle))])
    thickness = BAND_THICKNESS * 0.1

    def distance(x, y):
        return (x - 4.0) * normal[0] + (y - 4.0) * normal[1]

    def band(x, y):
        return np.exp(-np.pi * (distance(x, y) / thickness) ** 2) / thickness

    particles = averaged(0.1, LEVEL, band)
    n = distance(particles.x, particles.y)
    middle = (np.hypot(particles.x - 4.0, particles.y - 4.0) < 1.5) & (abs(n) < 0.05)
    np.testing.assert_allclose(particles.plastic_strain[middle], 1.0 / LENGTH, rtol=0.03)


def test_cells_too_coarse_for_the_length_raise_the_rate():
    """Pooling and reading average over ``sqrt(2 pi 2 (1/12 + l_p^2/3))`` cells, 1.14 at four a cell; bands add 2.1."""
    np.testing.assert_allclose(least_thickness(0.25), np.hypot(1.143, 2.1), rtol=1e-3)
    assert coarse_rate_factor(LENGTH, 0.4, 0.25) == 1.0
    np.testing.assert_allclose(coarse_rate_factor(LENGTH, 2.0, 0.25), 4.782, rtol=1e-3)
    assert coarse_rate_factor(0.0, 2.0, 0.25) == 1.0


def test_a_slide_softens_over_the_internal_length():
    """The same slope runs farther if its bands soften over less, 0.5 m against 2 m, with one rate."""
    reach = []
    for length in (0.5, 2.0):
        model = small_model()._replace(internal_length=length)
        reach.append(
            march_to_rest(model, with_strength(in_situ_state(model)), np.array([0.0, 1.0])).max_displacement[-1]
        )
    assert reach[0] > 1.02 * reach[1] > 0.1
