"""GIMP weights on the grid: means of the bilinear hat functions over the square domains of particles.

The oracle is Gauss quadrature between the node lines, where the integrand is bilinear: two points are exact. All nodes
of the grid are compared, so a wrong node is as wrong as a wrong value. Where nodes are swapped, a column under its own
weight has shear stresses of the size of the weight.
"""

import numpy as np
import pytest
from driver import SCHEMES, Row, elastic_soil, lattice, node_indices

from solver.basis import allocate_stencil, evaluate_stencil
from solver.constants import STANDARD_GRAVITY
from solver.elastic import p_wave_speed
from solver.grid import PADDING, allocate_grid
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

CELL, SIDE = 0.4, 2.0  # m
HALF_LENGTHS = (0.125, 1.0 / 6.0, 0.25, 0.5)  # in cells: 16, 9, 4 particles a cell; 1, which is the B-spline


def means_of_hats(x, nodes, half_length):
    """Return means of hat functions and of their slopes over ``x +- half_length`` (cells), each (nodes, particles)."""
    low, high = x - half_length, x + half_length
    kink = np.clip(np.ceil(low), low, high)
    hats, slopes = np.zeros((2, nodes.size, x.size))
    for start, stop in ((low, kink), (kink, high)):
        for point in (-np.sqrt(1.0 / 3.0), np.sqrt(1.0 / 3.0)):
            offset = 0.5 * (start + stop) + 0.5 * point * (stop - start) - nodes[:, None]
            share = 0.25 * (stop - start) / half_length
            hats += share * np.maximum(0.0, 1.0 - np.abs(offset))
            slopes -= share * np.sign(offset) * (np.abs(offset) < 1.0)
    return hats, slopes


def weights_of_solver(grid, x, y):
    """Return weights and both gradients over the cell, (3, rows, columns, particles), from the stencils."""
    stencil = allocate_stencil(x.size)
    evaluate_stencil(stencil, x, y, grid)
    found = np.zeros((3, grid.rows * grid.columns, x.size))
    particle = np.arange(x.size)
    for j in range(3):
        for i in range(3):
            values = stencil.sx[i] * stencil.sy[j], stencil.gx[i] * stencil.sy[j], stencil.sx[i] * stencil.gy[j]
            found[:, stencil.node + j * grid.columns + i, particle] += values
    found[1:] *= CELL
    return found.reshape(3, grid.rows, grid.columns, -1)


def largest_deviations(half_length, particles=2000):
    """Return those of weights, of their gradients, of their sum from 1, and of the places they reproduce, in cells."""
    grid = allocate_grid(SIDE, SIDE, CELL, half_length)
    x, y = np.random.default_rng(0).uniform(0.0, SIDE, (2, particles))
    found = weights_of_solver(grid, x, y)
    (hat_x, slope_x), (hat_y, slope_y) = (
        means_of_hats(place / CELL, np.arange(count) - float(PADDING), half_length)
        for place, count in ((x, grid.columns), (y, grid.rows))
    )
    pairs = (hat_y, hat_x), (hat_y, slope_x), (slope_y, hat_x)
    exact = np.array([along_y[:, None] * along_x for along_y, along_x in pairs])
    deviation = np.abs(found - exact).max(axis=(1, 2, 3))
    flat = found[0].reshape(-1, particles)
    places = np.abs(np.reshape(node_indices(grid), (2, -1)) @ flat - np.stack([x, y]) / CELL)
    return deviation[0], deviation[1:].max(), np.abs(flat.sum(axis=0) - 1.0).max(), places.max()


def spurious_shear(scheme, half_length):
    """Return the largest shear stress over the largest vertical one in a column that swings under its own weight."""
    soil, density = elastic_soil(10e6, 0.3), 2000.0
    x, y = lattice(1.0, 6.0, 0.25)
    column = allocate_particles(x, y, 0.25**2, density)
    grid, work = allocate_grid(1.0, 7.0, 0.5, half_length), allocate_workspace(x.size)
    dt = 0.3 * 0.5 / p_wave_speed(soil.bulk_modulus, soil.shear_modulus, density)
    advance(column, grid, work, (soil,), scheme, STANDARD_GRAVITY, 0.0, dt, 300)
    assert np.abs(column.stress_yy).max() > 50e3
    return np.abs(column.stress_xy).max() / np.abs(column.stress_yy).max()


@pytest.mark.parametrize("half_length", HALF_LENGTHS)
def test_weights_are_means_of_hat_functions_on_every_node(half_length):
    assert max(largest_deviations(half_length)) < 1e-12


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("half_length", [0.25, 0.5])
def test_a_column_under_its_own_weight_has_no_shear(scheme, half_length):
    assert spurious_shear(SCHEMES[scheme], half_length) < 1e-7


def rows():
    worst = np.max([largest_deviations(half_length) for half_length in HALF_LENGTHS], axis=0)
    shear = max(spurious_shear(scheme, 0.25) for scheme in SCHEMES.values())
    names = (
        "Weights of 16, 9, 4 and 1 particles a cell against quadrature",
        "Their gradients, times the cell",
        "Partition of unity",
        "Reproduction of places, over the cell",
    )
    return [
        *(
            Row(name, "within 1e-12", "", f"{found:.0e}", found < 1e-12)
            for name, found in zip(names, worst, strict=True)
        ),
        Row("Shear in a column under its own weight", "1e-7 of its stress", "", f"{shear:.0e}", shear < 1e-7),
    ]
