"""Fields of very long correlations: fewer nodes, the same correlation but for what is said to be lost."""

import numpy as np
import pytest

from campaign.fields import stretched
from campaign.fields.correlation import KERNELS, Correlation
from campaign.fields.samplers import CirculantSampler
from campaign.fields.stretched import LOST, StretchedSampler, stretched_bytes
from campaign.scene import load_scene
from campaign.simulation.ground import strengths_of

SHAPE, SPACING = (6, 25), 1.0
X, Y = (axis.ravel() for axis in np.meshgrid(np.arange(25.0), np.arange(6.0)))


def covariance(sampler, noise):
    """Return A A^T of the first field, from the image of each unit vector of noise."""
    images = np.array([sampler.correlate(unit.reshape(noise))[0].ravel() for unit in np.eye(int(np.prod(noise)))])
    return images.T @ images


@pytest.mark.parametrize("kind", KERNELS)
@pytest.mark.parametrize(("lengths", "angle"), [((3000.0, 3.0), 0.0), ((3000.0, 3000.0), 0.4), ((1e6, 1e6), 0.0)])
def test_the_correlation_is_kept_but_for_what_is_lost_between_nodes(kind, lengths, angle):
    """Variance exactly 1; covariances within twice the loss between two nodes, and exact among these."""
    correlation = Correlation(kind, *lengths, angle)
    sampler = StretchedSampler(correlation, SHAPE, SPACING)
    found = covariance(sampler, (1, sampler.rows.number * sampler.columns.number))
    expected = correlation(X[:, None] - X, Y[:, None] - Y)
    assert sampler.columns.number < 25
    np.testing.assert_allclose(np.diag(found), 1.0, atol=1e-10)
    np.testing.assert_allclose(found, expected, atol=2.0 * LOST)
    nodes = (X % sampler.columns.stride == 0) & (Y % sampler.rows.stride == 0)
    np.testing.assert_allclose(found[np.ix_(nodes, nodes)], expected[np.ix_(nodes, nodes)], atol=1e-6)


def test_many_nodes_are_drawn_on_a_periodic_grid_of_unequal_sides(monkeypatch):
    """The same field by its covariance, and not one of the nodes' Cholesky factor."""
    correlation = Correlation("spherical", 600.0, 3.0)
    few = StretchedSampler(correlation, SHAPE, SPACING)
    monkeypatch.setattr(stretched, "FEW", 0)
    many = StretchedSampler(correlation, SHAPE, SPACING)
    assert isinstance(many.nodes, CirculantSampler)
    fields = many.draw(np.random.default_rng(1), 2000).reshape(2000, -1)
    error = 1.0 / np.sqrt(2000.0)
    one = covariance(few, (1, few.rows.number * few.columns.number))
    assert np.abs(fields.T @ fields / 2000.0 - one).max() < 6.0 * np.sqrt(2.0) * error  # 1e-8 for each of 11,325


@pytest.mark.parametrize("vertical", ["2 m", "1e4 m"])
def test_a_correlation_over_10_km_takes_megabytes(vertical):
    """Periodic grids would take 1.4 to 8 GB and 500 GB or more. Perfectly correlated ground is of one strength."""
    overrides = ["field.horizontal=1e4 m", f"field.vertical={vertical}", "field.resolution=0.25 m"]
    field = strengths_of(load_scene("ma2023", overrides), 3)["cohesion"]
    along = np.ptp(field, axis=1).max() / field.mean()
    assert along < 0.05  # sigma sqrt(2 (1 - C)) = 0.1 sqrt(2 x 0.0075) = 0.012 from wall to wall
    if vertical != "2 m":
        assert np.ptp(field) / field.mean() < 0.05


def test_its_memory_is_foreseen():
    correlation = Correlation("exponential", 1e4, 2.0)
    least, most = stretched_bytes(correlation, (76, 300), 0.25)
    assert 1e5 < least <= most < 1e7
