"""The sampler that a scene asks for."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from campaign.fields.cholesky import CholeskySampler
from campaign.fields.correlation import Correlation, autocorrelation_distance
from campaign.fields.cross_correlation import gaussian_matrix, lower_factor
from campaign.fields.properties import marginals
from campaign.fields.reference_grid import Mask, ReferenceGrid
from campaign.fields.samplers import CirculantSampler, KroneckerSampler, Sampler
from campaign.fields.strengths import StrengthSampler
from campaign.scene.scene import Scene
from campaign.scene.sections import RandomField

AUTOMATIC = "circulant"
"""Sampler for any correlation and angle, and the only one without a matrix factorisation, whose last bits depend on the
processor and the number of threads."""

CELLS_PER_DISTANCE = 8
"""Cells of the reference grid per shorter autocorrelation distance, where the scene does not say."""


def strength_sampler(
    scene: Scene, width: float, height: float, directory: Path | None = None, soil: Mask | None = None
) -> StrengthSampler:
    """Build the sampler of a scene.

    Parameters
    ----------
    scene : Scene
    width, height : float
        Bounding box of the ground [m], from the origin on.
    directory : Path, optional
        Where the Cholesky factor is kept; the other samplers keep nothing.
    soil : callable, optional
        Tells for coordinates x, y [m] which places are in the ground; spares the Cholesky sampler the others.

    Raises
    ------
    SamplerError
        If the sampler cannot draw this field.
    """
    field = scene.field
    correlation = correlation_of(field)
    finest = min(correlation.horizontal, correlation.vertical)
    grid = ReferenceGrid.covering(width, height, field.resolution or finest / CELLS_PER_DISTANCE)
    method = AUTOMATIC if field.sampler == "auto" else field.sampler
    cells = grid.cells_with(soil if method == "cholesky" else None)
    laws = marginals(scene)
    matrix = gaussian_matrix(laws, field.cross_correlations(), field.cross_correlation_of)
    gaussian = gaussian_sampler(method, correlation, grid, cells, directory)
    return StrengthSampler(grid, cells, gaussian, laws, lower_factor(matrix))


def correlation_of(field: RandomField) -> Correlation:
    """Return the correlation of a scene, with its lengths as autocorrelation distances."""
    along, across = field.horizontal, field.vertical
    if field.length_kind == "scale-of-fluctuation":
        along = autocorrelation_distance(along, field.correlation)
        across = autocorrelation_distance(across, field.correlation)
    return Correlation(field.correlation, along, across, field.angle)


def gaussian_sampler(
    method: str, correlation: Correlation, grid: ReferenceGrid, cells: NDArray[np.bool_], directory: Path | None
) -> Sampler:
    """Build the sampler of standard Gaussian fields on a grid by the name of its method."""
    if method == "kronecker":
        return KroneckerSampler(correlation, grid.x, grid.y)
    if method == "circulant":
        return CirculantSampler(correlation, grid.shape, grid.resolution)
    x, y = np.meshgrid(grid.x, grid.y)
    return CholeskySampler(correlation, x[cells], y[cells], directory)
