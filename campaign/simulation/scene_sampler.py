"""The sampler that a scene asks for."""

from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from campaign.errors import SamplerError
from campaign.fields.cholesky import CholeskySampler
from campaign.fields.conditioning import Conditioning, Datum, merged
from campaign.fields.correlation import Array, Correlation, autocorrelation_distance
from campaign.fields.cross_correlation import gaussian_matrix, lower_factor
from campaign.fields.embedding import circulant_bytes
from campaign.fields.marginals import Lognormal
from campaign.fields.properties import PROPERTIES, distributions
from campaign.fields.reference_grid import Mask, ReferenceGrid
from campaign.fields.samplers import CirculantSampler, KroneckerSampler, Sampler
from campaign.fields.strengths import LayerSoil, StrengthSampler
from campaign.fields.stretched import LARGEST_EMBEDDING, StretchedSampler
from campaign.scene.boring_data import Measured, measured_in, standard_value
from campaign.scene.ground_surface import surface_of
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
    cells, soils = grid.cells_with(soil if method == "cholesky" else None), soils_of_layers(scene, grid)
    for datum in measured_in(scene):
        cells[_cell(grid, datum)] = True
    gaussian, data = gaussian_sampler(method, correlation, grid, cells, directory), data_of(scene, grid, cells)
    layer = layer_at(interfaces_of(scene), *np.meshgrid(grid.x, grid.y)) if scene.layer else None
    return StrengthSampler(grid, cells, gaussian, soils, layer, data)


def soils_of_layers(scene: Scene, grid: ReferenceGrid) -> tuple[LayerSoil, ...]:
    """Return what the soil of each layer makes of Gaussian fields, from the surface down."""
    tops, interfaces, soils = tops_of(scene), interfaces_of(scene), []
    for number, (layer, top) in enumerate(zip(layer_scenes(scene), tops, strict=True)):
        has_own = number > 0 and scene.layer[number - 1].field == "own"
        own = soil_of_layer(layer, top, number if has_own else 0)
        cells = grid.cells_with(partial(_is_in, interfaces, number)) if scene.layer else None
        soils.append(own._replace(cells=cells))
    return tuple(soils)


def data_of(scene: Scene, grid: ReferenceGrid, cells: NDArray[np.bool_]) -> dict[int, Conditioning]:
    """Return what borings tell of the independent fields, by the number of the layer that has its own.

    Raises
    ------
    SamplerError
        If some data follow from the others.
    """
    soils, found = soils_of_layers(scene, grid), dict[int, list[Datum]]()
    for measured in measured_in(scene):
        soil, name = soils[measured.layer], measured.name
        law = soil.marginals[name]
        error_variance = (Lognormal(1.0, measured.noise).sigma / law.sigma) ** 2
        value = standard_value(scene, measured, law)
        datum = Datum(_cell(grid, measured), soil.weights(name), value, error_variance)
        found.setdefault(soil.field, []).append(datum)
    correlation = correlation_of(scene.field)
    return {number: Conditioning(merged(data), correlation, grid, cells) for number, data in found.items()}


def refuse_crowded_data(scene: Scene) -> None:
    """Refuse borings of which some values follow from the others, before anything else is built.

    Raises
    ------
    SamplerError
        If there are such.
    """
    surface = surface_of(scene.geometry)
    grid = reference_grid(scene, surface.width, surface.top)
    cells = np.zeros(grid.shape, dtype=bool)
    for datum in measured_in(scene):
        cells[_cell(grid, datum)] = True
    data_of(scene, grid, cells)


def gaussian_means(scene: Scene, grid: ReferenceGrid) -> dict[int, dict[str, Array]]:
    """Return what borings make of the means of the standard Gaussian fields of the properties of each layer.

    Returns
    -------
    dict
        By number of the layer, of those with a field that has data, and by name; each of shape (ny, nx).
    """
    data = data_of(scene, grid, np.ones(grid.shape, dtype=bool))
    return {
        number: {name: (soil.weights(name) @ data[soil.field].means).reshape(grid.shape) for name in soil.marginals}
        for number, soil in enumerate(soils_of_layers(scene, grid))
        if soil.field in data
    }


def _cell(grid: ReferenceGrid, datum: Measured) -> tuple[int, int]:
    row, column = grid.index(np.array([datum.x]), np.array([datum.y]))
    return int(row[0]), int(column[0])


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


def circulant_sampler(correlation: Correlation, grid: ReferenceGrid) -> Sampler:
    """Build the sampler on a periodic grid, or, where that would be too large, on fewer nodes."""
    least, _ = circulant_bytes(correlation, grid.shape, (grid.resolution,) * 2)
    if least <= LARGEST_EMBEDDING:
        try:
            return CirculantSampler(correlation, grid.shape, grid.resolution)
        except SamplerError:  # the period had to be longer than was foreseen
            pass
    return StretchedSampler(correlation, grid.shape, grid.resolution)


def gaussian_sampler(
    method: str, correlation: Correlation, grid: ReferenceGrid, cells: NDArray[np.bool_], directory: Path | None
) -> Sampler:
    """Build the sampler of standard Gaussian fields on a grid by the name of its method."""
    if method == "kronecker":
        return KroneckerSampler(correlation, grid.x, grid.y)
    if method == "circulant":
        return circulant_sampler(correlation, grid)
    x, y = np.meshgrid(grid.x, grid.y)
    return CholeskySampler(correlation, x[cells], y[cells], directory)
