"""The random field itself as the cheapest model: what it foretells of a run-out, whose mean is known exactly.

The logarithms of the properties are Gaussian with known means, given the data of borings, so the mean of any linear
function of them is known without a single run. What ridge regression on a coarse map of the field foretells of the
run-out is taken off each realization, and its known mean is put in its place. The realizations are fit by those of the
other folds only: then no value has shaped what it is compared with, and the mean stays unbiased (cross-fitting; Wager
et al. 2016, PNAS 113, 12673-12678).
"""

import numpy as np

from campaign.fields.marginals import Lognormal
from campaign.fields.properties import marginals
from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.layers import interfaces_of, layer_at, layer_scenes, random_properties
from campaign.statistics.intervals import Sample
from campaign.statistics.ridge import Matrix, ridge

FOLDS = 10

FEWEST = 50
"""Realizations, of fewer the map foretells too little."""


def deviations(field_maps: Matrix, scene: Scene) -> Matrix:
    """Return ln(property) in boxes of the ground as deviations from the mean, in standard deviations of a point.

    Parameters
    ----------
    field_maps : array (n, property, row, column)
        Means of ln(property) over the boxes; NaN where it is not random, and in realizations without a result.
    scene : Scene
        Gives the distributions.

    Returns
    -------
    array (n, m)
        Of the boxes in which the property is random.
    """
    if not random_properties(scene):
        return np.empty((len(field_maps), 0))
    mean, sigma = _distribution(scene)
    has_value = np.isfinite(field_maps).any(axis=0)
    return np.asarray(((field_maps - mean) / sigma)[:, has_value])


def _distribution(scene: Scene) -> tuple[Matrix, Matrix]:
    """Return the mean of ln(property) in each box, and the standard deviation of a point in it without data."""
    # With Numba, for which those who only read sentences about accuracy do not wait.
    from campaign.simulation.field_summary import box_map
    from campaign.simulation.scene_sampler import gaussian_means, reference_grid

    laws = [marginals(layer) for layer in layer_scenes(scene)]
    rows = [row.name for row in random_properties(scene)]
    of_layers = np.array([[_moments(law.get(name)) for law in laws] for name in rows])
    if not scene.layer and not scene.boring:
        mean, sigma = of_layers[:, 0].T[:, :, None, None]
        return mean, sigma
    surface = surface_of(scene.geometry)
    grid = reference_grid(scene, surface.width, surface.top)
    boxes, layer = box_map(surface, grid), layer_at(interfaces_of(scene), *np.meshgrid(grid.x, grid.y))
    mean, sigma = of_layers[:, layer, 0], of_layers[:, layer, 1]
    for number, known in gaussian_means(scene, grid).items():
        for row, name in enumerate(rows):
            mean[row] += np.where(layer == number, sigma[row] * known.get(name, 0.0), 0.0)
    return boxes.averages(mean), boxes.averages(sigma)


def _moments(law: Lognormal | None) -> tuple[float, float]:
    return (np.nan, np.nan) if law is None else (law.log_mean, law.sigma)


def controlled(outcomes: Sample, field: Matrix) -> Sample:
    """Return values (n,) with the mean of the outcomes and less scatter, the outcomes themselves where that fails.

    Parameters
    ----------
    outcomes : array (n,)
    field : array (n, m)
        Linear functions of the field with mean 0, each scaled to about the same scatter.
    """
    if len(outcomes) < FEWEST or field.shape[1] == 0 or np.ptp(outcomes) == 0.0:
        return outcomes
    adjusted = np.empty_like(outcomes)
    fold = np.arange(len(outcomes)) % FOLDS
    for each in range(FOLDS):
        inside = fold == each
        slopes = ridge(field[~inside], outcomes[~inside]).coefficients
        adjusted[inside] = outcomes[inside] - field[inside] @ slopes
    return adjusted if np.var(adjusted) < np.var(outcomes) else outcomes
