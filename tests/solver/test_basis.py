"""A weight is the mean of the hat function over the particle's domain: the oracle is quadrature of that."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import BSpline

from solver.basis import allocate_stencil, evaluate_stencil, weight_and_gradient
from solver.domain import half_length_in_cells
from solver.grid import allocate_grid

HALF_LENGTHS = [0.125, 1.0 / 6.0, 0.25, 0.5]  # 16, 9, 4 and 1 particles a cell
CELL = 0.4


def hat(s):
    return max(0.0, 1.0 - abs(s))


def hat_slope(s):
    return -np.sign(s) if abs(s) < 1.0 else 0.0


def mean_over_domain(function, place, node, half_length):
    low, high = place - half_length, place + half_length
    kinks = [kink for kink in (node - 1.0, node, node + 1.0) if low < kink < high]
    return quad(lambda s: function(s - node), low, high, points=kinks or None)[0] / (2.0 * half_length)


@pytest.mark.parametrize("half_length", HALF_LENGTHS)
def test_weights_and_gradients_are_means_of_the_hat_function_over_the_domain(half_length):
    for place in np.linspace(half_length, 1.0 + half_length, 41, endpoint=False):
        weights = [mean_over_domain(hat, place, node, half_length) for node in range(3)]
        gradients = [mean_over_domain(hat_slope, place, node, half_length) / CELL for node in range(3)]
        np.testing.assert_allclose(
            np.ravel(weight_and_gradient(place, half_length, 1.0 / CELL)), weights + gradients, rtol=0.0, atol=1e-12
        )


def test_half_a_cell_is_the_quadratic_b_spline():
    spline = BSpline.basis_element([-1.5, -0.5, 0.5, 1.5])
    slope = spline.derivative()
    for place in np.linspace(0.5, 1.5, 41)[1:-1]:
        offsets = place - np.arange(3)
        inside = np.abs(offsets) < 1.5
        expected = [*np.where(inside, spline(offsets), 0.0), *np.where(inside, slope(offsets), 0.0)]
        np.testing.assert_allclose(
            np.ravel(weight_and_gradient(place, half_length_in_cells("bspline", 4), 1.0)),
            expected,
            rtol=0.0,
            atol=1e-13,
        )


def test_vanishing_half_length_is_the_hat_function():
    for place in np.linspace(0.001, 0.999, 41):
        expected = [1.0 - place, place, 0.0, -1.0, 1.0, 0.0]
        np.testing.assert_allclose(
            np.ravel(weight_and_gradient(place, half_length_in_cells("linear", 4), 1.0)), expected, rtol=0.0, atol=2e-6
        )


def test_gimp_particles_tile_the_cell():
    assert [half_length_in_cells("gimp", n) for n in (1, 4, 16)] == [0.5, 0.25, 0.125]


def sums_over_nodes(stencil, grid, values):
    """Return ``sum S f``, ``sum dS/dx f`` and ``sum dS/dy f`` of nodal values, each (particles,)."""
    nodes = stencil.node + grid.columns * np.arange(3)[:, None, None] + np.arange(3)[None, :, None]
    return [
        np.sum(along_y[:, None] * along_x[None] * values[nodes], axis=(0, 1))
        for along_x, along_y in ((stencil.sx, stencil.sy), (stencil.gx, stencil.sy), (stencil.sx, stencil.gy))
    ]


@pytest.mark.parametrize("half_length", [1e-6, *HALF_LENGTHS])
def test_stencil_reproduces_constant_and_linear_fields_up_to_one_cell_beyond_the_walls(half_length):
    grid = allocate_grid(2.0, 1.2, CELL, half_length)
    rng = np.random.default_rng(0)
    x = np.concatenate([rng.uniform(-CELL, 2.0 + CELL, 500), [-CELL + 1e-12, 2.0 + CELL - 1e-12, 0.8, 0.9]])
    y = np.concatenate([rng.uniform(-CELL, 1.2 + CELL, 500), [-CELL + 1e-12, 1.2 + CELL - 1e-12, 0.4, 0.5]])
    stencil = allocate_stencil(x.size)
    evaluate_stencil(stencil, x, y, grid)
    assert stencil.node.min() >= 0
    assert stencil.node.max() + 2 * grid.columns + 2 < grid.mass.size
    j, i = np.divmod(np.arange(grid.mass.size), grid.columns)
    node_x, node_y = grid.origin + i * CELL, grid.origin + j * CELL
    for field, at_particles in (
        (np.ones_like(node_x), (1.0, 0.0, 0.0)),
        (node_x, (x, 1.0, 0.0)),
        (node_y, (y, 0.0, 1.0)),
    ):
        for found, expected in zip(sums_over_nodes(stencil, grid, field), at_particles, strict=True):
            # 1e-6 cells of half length amplify round-off of the gradient weights a million times.
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=2e-9 if half_length < 1e-3 else 1e-12)


@pytest.mark.parametrize("half_length", HALF_LENGTHS)
def test_weights_are_never_negative(half_length):
    for place in np.linspace(half_length, np.nextafter(1.0 + half_length, 0.0), 1001):
        assert min(weight_and_gradient(place, half_length, 1.0)[0]) >= -1e-16
