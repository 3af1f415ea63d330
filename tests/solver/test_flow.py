"""Moved ground in columns, on states made by hand."""

import numpy as np
import pytest

from solver.flow import flow_through, shares_in_columns
from solver.particles import allocate_particles, copy_particles

SPACING, DENSITY = 0.5, 2000.0


def layer(left, right, layers, velocity=(0.0, 0.0)):
    """Return particles that fill so many layers between two places (m)."""
    x, y = np.meshgrid(np.arange(left, right, SPACING) + 0.25, np.arange(layers) * SPACING + 0.25)
    ground = allocate_particles(x.ravel(), y.ravel(), SPACING**2, DENSITY)
    return ground._replace(velocity_x=np.full(x.size, velocity[0]), velocity_y=np.full(x.size, velocity[1]))


def flow(ground, columns, moved=None, start=None):
    moved = np.ones(ground.x.size, dtype=bool) if moved is None else moved
    return flow_through(ground, start or ground, moved, 0.5 * SPACING, np.array(columns))


def test_a_uniform_flow_has_its_depth_velocity_flux_and_pressure_in_every_column():
    """1.5 m at 5 m/s: rho h v^2 = 2000 * 1.5 * 25 N/m, rho v^2 = 2000 * 25 Pa, wherever the edges lie."""
    found = flow(layer(0.0, 10.0, 3, (3.0, -4.0)), [[2.0, 3.0], [4.1, 5.73], [0.0, 10.0]])
    np.testing.assert_allclose(found.depth, 1.5, rtol=1e-12)
    np.testing.assert_allclose(found.velocity, 5.0, rtol=1e-12)
    np.testing.assert_allclose(found.momentum_flux, 75e3, rtol=1e-12)
    np.testing.assert_allclose(found.impact_pressure, 50e3, rtol=1e-12)


def test_velocity_is_the_mean_over_the_depth():
    """Layers at 2 and 6 m/s: 4 m/s, and noise that sums up to nothing does not count."""
    ground = layer(0.0, 10.0, 2, (2.0, 0.0))
    ground.velocity_x[ground.y > SPACING] = 6.0
    ground.velocity_y[ground.y > SPACING] = 9.0
    ground.velocity_y[ground.y < SPACING] = -9.0
    np.testing.assert_allclose(flow(ground, [[4.0, 6.0]]).velocity, 4.0, rtol=1e-12)


def test_still_ground_and_empty_columns_have_no_flow():
    ground = layer(0.0, 4.0, 2, (3.0, 0.0))
    found = flow(ground, [[1.0, 2.0], [5.0, 6.0]], moved=ground.y > SPACING)
    np.testing.assert_allclose(found.depth, [SPACING, 0.0], atol=1e-12)
    for values in found:
        assert values[1] == 0.0
    assert not np.any(flow(ground, [[1.0, 2.0]], moved=np.zeros(ground.x.size, dtype=bool)))


def test_grains_that_part_are_no_deeper_and_no_lighter():
    start = layer(0.0, 4.0, 2)
    now = copy_particles(start)
    now.volume[:] *= 3.0
    now.velocity_x[:] = 2.0
    found = flow(now, [[1.0, 2.0]], start=start)
    assert found.depth == pytest.approx(2 * SPACING)
    assert found.impact_pressure == pytest.approx(DENSITY * 4.0)


def test_shares_of_columns_side_by_side_make_up_the_particle():
    x = np.linspace(0.3, 3.7, 23)
    edges = np.array([0.0, 0.6, 1.0, 2.75, 4.0])
    shares = shares_in_columns(x, 0.25, np.column_stack([edges[:-1], edges[1:]]))
    np.testing.assert_allclose(shares.sum(axis=0), 1.0, rtol=1e-12)
    np.testing.assert_allclose(shares_in_columns(np.array([0.95]), 0.1, np.array([[0.0, 1.0]])), 0.75, rtol=1e-12)
