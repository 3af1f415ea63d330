"""The sampler that a scene asks for."""

from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from campaign.fields.cholesky import CholeskySampler
from campaign.fields.correlation import Array, Correlation, autocorrelation_distance
from campaign.fields.cross_correlation import gaussian_matrix, lower_factor
from campaign.fields.properties import PROPERTIES, distributions
from campaign.fields.reference_grid import Mask, ReferenceGrid
from campaign.fields.samplers import CirculantSampler, KroneckerSampler, Sampler
from campaign.fields.strengths import LayerSoil, StrengthSampler
from campaign.scene.layers import interfaces_of, layer_at, layer_scenes, tops_of
from campaign.scene.scene import Scene
from campaign.scene.sections import RandomField
from solver.surface import Surface

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
    field, correlation, grid = scene.field, correlation_of(scene.field), reference_grid(scene, width, height)
    method = AUTOMATIC if field.sampler == "auto" else field.sampler
    cells = grid.cells_with(soil if method == "cholesky" else None)
    gaussian = gaussian_sampler(method, correlation, grid, cells, directory)
    tops = tops_of(scene)
    if not scene.layer:
        return StrengthSampler(grid, cells, gaussian, (soil_of_layer(scene, tops[0]),))
    interfaces, soils = interfaces_of(scene), []
    for number, (layer, top) in enumerate(zip(layer_scenes(scene), tops, strict=True)):
        has_own = number > 0 and scene.layer[number - 1].field == "own"
        own = soil_of_layer(layer, top, number if has_own else 0)
        soils.append(own._replace(cells=grid.cells_with(partial(_is_in, interfaces, number))))
    return StrengthSampler(grid, cells, gaussian, tuple(soils), layer_at(interfaces, *np.meshgrid(grid.x, grid.y)))


def reference_grid(scene: Scene, width: float, height: float) -> ReferenceGrid:
    """Return the grid on which the fields of a scene are drawn, over a box of `width` x `height` [m]."""
    correlation = correlation_of(scene.field)
    finest = min(correlation.horizontal, correlation.vertical)
    return ReferenceGrid.covering(width, height, scene.field.resolution or finest / CELLS_PER_DISTANCE)


def soil_of_layer(scene: Scene, top: Surface, field: int = 0) -> LayerSoil:
    """Return what the [soil] of a scene below its top makes of the common Gaussian fields, or of those of a layer."""
    laws = distributions(scene)
    means = {row.name: row.reference(scene) for row in PROPERTIES if row.name not in laws}
    trends = {row.name: trend for row in PROPERTIES if (trend := row.trend(scene, top)) is not None}
    pairs = {pair: rho for pair, rho in scene.field.cross_correlations().items() if laws.keys() >= {*pair}}
    matrix = gaussian_matrix(laws, pairs, scene.field.cross_correlation_of)
    return LayerSoil(laws, lower_factor(matrix), field=field, means=means, trends=trends)


def _is_in(interfaces: tuple[Surface, ...], number: int, x: Array, y: Array) -> NDArray[np.bool_]:
    return np.asarray(layer_at(interfaces, x, y) == number)


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
