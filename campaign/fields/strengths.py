"""The random soil properties of a realization as cross-correlated fields on a grid of their own.

The field belongs to the ground, not to the mesh: it is drawn on a reference grid, and a particle reads it once, at its
initial place. Realization k is therefore the same ground on every mesh. Equations are those of section 2.1 of Ma,
Rezania and Mousavi Nezhad. Which properties there are says `campaign.fields.properties`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.errors import SamplerError
from campaign.fields.conditioning import Conditioning
from campaign.fields.correlation import Array
from campaign.fields.cross_correlation import correlated
from campaign.fields.marginals import Lognormal
from campaign.fields.properties import BY_NAME, PROPERTIES
from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.samplers import Sampler
from campaign.fields.trend import Trend
from campaign.seeds import BASELINE, Stream, generator

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Strengths:
    """The random properties of one realization, on the reference grid.

    Parameters
    ----------
    grid : ReferenceGrid
        Where the values are.
    names : tuple of str
        Of the n properties, see `campaign.fields.properties`.
    values : ndarray of shape (n, ny, nx)
        Without trends, in SI units, of the layer in which the centre of a cell lies; NaN in cells that the sampler left
        out as not in the ground, and where a property that varies in another layer does not.
    by_layer : tuple of ndarrays of shape (n, ny, nx)
        The values that each of several layers has, or would have, in all cells; constant ones too. Empty for one.
    trends : tuple of mapping
        Of each layer: by what the values of a property grow with depth, by its name.
    layer : ndarray of shape (ny, nx), optional
        Number of the layer in which the centre of each cell lies; None for a single one.
    random : ndarray of shape (layers, n), optional
        Which properties are random in which layer; None for all.
    """

    grid: ReferenceGrid
    names: tuple[str, ...]
    values: Array
    by_layer: tuple[Array, ...] = ()
    trends: tuple[Mapping[str, Trend], ...] = ()
    layer: NDArray[np.intp] | None = None
    random: NDArray[np.bool_] | None = None

    def __getitem__(self, name: str) -> Array:
        """Return the values of a property with its trend, shape (ny, nx)."""
        layer = 0 if self.layer is None else self.layer
        return self._grown(name, self.values[self.names.index(name)], self.grid.x, self.grid.y[:, None], layer)

    def _grown(self, name: str, values: Array, x: Array, y: Array, layer: NDArray[np.integer[Any]] | int) -> Array:
        """Return values that were drawn without trend for places `x`, `y` [m] in layers with it."""
        for number, trends in enumerate(self.trends):
            if name in trends:
                values = np.where(layer == number, values * trends[name](x, y), values)
        return values

    def random_values(self) -> Array:
        """Return the values without trend of what is random anywhere, (n, ny, nx); NaN in layers where it is not."""
        if self.random is None:
            return self.values
        layer = np.zeros(self.grid.shape, dtype=np.intp) if self.layer is None else self.layer
        is_here = self.random.T[:, layer]  # (n, ny, nx)
        return np.where(is_here, self.values, np.nan)[self.random.any(axis=0)]

    def to_dataset(self) -> "xr.Dataset":
        """Return the fields as an xarray dataset by elevation `y` and place `x` (m)."""
        import xarray as xr

        fields = {
            row.name: (
                ("y", "x"),
                self[row.name],
                {"units": row.unit.si, "long_name": row.long_name, "symbol": row.symbol},
            )
            for row in (BY_NAME[name] for name in self.names)
        }
        places = {
            "x": ("x", self.grid.x, {"units": "m", "long_name": "horizontal place"}),
            "y": ("y", self.grid.y, {"units": "m", "long_name": "elevation"}),
        }
        return xr.Dataset(fields, places)

    def at(self, x: Array, y: Array, layer: NDArray[np.integer[Any]] | int = 0) -> dict[str, Array]:
        """Read the properties, by name, at the initial places `x`, `y` [m] of particles; each of the shape of `x`.

        The trend is that at the place, the rest that of its cell.
        A cell that an interface cuts has the soil of several layers, and `layer` is the number of the particle's own.

        Raises
        ------
        ValueError
            If a place is outside the grid, or in a cell that was left out.
        """
        row, column = self.grid.index(x, y)
        values = self.values[:, row, column]
        for number, own in enumerate(self.by_layer):
            values = np.where(layer == number, own[:, row, column], values)
        if missing := np.flatnonzero(np.isnan(values).any(axis=0)).tolist():
            raise ValueError(
                f"The place ({np.ravel(x)[missing[0]]:g} m, {np.ravel(y)[missing[0]]:g} m) is not in the ground for "
                'which the random field was built; use the sampler "circulant", which fills the whole box.'
            )
        return {name: self._grown(name, own, x, y, layer) for name, own in zip(self.names, values, strict=True)}


class LayerSoil(NamedTuple):
    """What the soil of a layer makes of Gaussian fields.

    Attributes
    ----------
    marginals : mapping
        Distribution [SI] of each property that has one by name, in the order of the table of properties. Those without
        variation keep their fields, so that what is correlated with them stays the same.
    factor : ndarray of shape (n, n)
        Lower Cholesky factor of the cross-correlations of their Gaussian fields.
    field : int
        Number of the layer if it has a field of its own, 0 if it has a part of that of all.
    cells : ndarray of shape (ny, nx), optional
        The cells in which the layer may be read, those where it is at the centre or at a corner; None for all.
    means : mapping, optional
        Value [SI] without trend of the properties by name that have no distribution.
    trends : mapping, optional
        By what values of properties grow with depth, by name.
    """

    marginals: Mapping[str, Lognormal]
    factor: Array
    field: int = 0
    cells: NDArray[np.bool_] | None = None
    means: Mapping[str, float] = {}
    trends: Mapping[str, Trend] = {}

    def is_random(self, name: str) -> bool:
        """Whether a property varies in it at random."""
        return name in self.marginals and self.marginals[name].cov > 0.0

    @property
    def places(self) -> list[int]:
        """Numbers of the independent fields that its properties have."""
        return [place for place, row in enumerate(PROPERTIES) if row.name in self.marginals]

    def weights(self, name: str) -> Array:
        """Return what a property has of each independent field; one for each row of the table of properties."""
        weights = np.zeros(len(PROPERTIES))
        weights[self.places] = self.factor[[*self.marginals].index(name)]
        return weights


@dataclass(frozen=True)
class StrengthSampler:
    """Everything that turns the identity of a realization into soil properties; can be pickled.

    Parameters
    ----------
    grid : ReferenceGrid
        Where fields are drawn.
    cells : ndarray of shape (ny, nx)
        The cells, in row order, for which `gaussian` draws values.
    gaussian : Sampler
        Draws independent standard Gaussian fields.
    layers : tuple of LayerSoil
        From the surface down.
    layer : ndarray of shape (ny, nx), optional
        Number of the layer in which the centre of each cell lies; None for a single one.
    data : mapping
        What is known of the independent fields, by the number of the layer that has its own.
    """

    grid: ReferenceGrid
    cells: NDArray[np.bool_]
    gaussian: Sampler
    layers: tuple[LayerSoil, ...]
    layer: NDArray[np.intp] | None = None
    data: Mapping[int, Conditioning] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the properties that vary in any layer, at random or with depth, in the order of the table."""
        return tuple(
            row.name
            for row in PROPERTIES
            if any(layer.is_random(row.name) or row.name in layer.trends for layer in self.layers)
        )

    def draw(self, seed: int, realization: int) -> Strengths:
        """Draw the properties of one realization, or their means everywhere, given the data, for `BASELINE`.

        Raises
        ------
        SamplerError
            If a value reaches the limit of its property.
        """
        random = np.array([[layer.is_random(name) for name in self.names] for layer in self.layers])
        if realization == BASELINE:
            fields = {number: known.means for number, known in self.data.items()}
        else:
            fields = self._independent(seed, realization) if random.any() else {}
        by_layer = [self._of_layer(number, fields, realization) for number in range(len(self.layers))]
        trends, is_random = tuple(layer.trends for layer in self.layers), None if random.all() else random
        if self.layer is None:
            return Strengths(self.grid, self.names, by_layer[0], trends=trends, random=is_random)
        values = np.full_like(by_layer[0], np.nan)
        for number, own in enumerate(by_layer):
            varies = random[number] | [name in trends[number] for name in self.names]
            is_here = (self.layer == number) & varies[:, None, None]
            values[is_here] = own[is_here]
        return Strengths(self.grid, self.names, values, tuple(by_layer), trends, self.layer, is_random)

    def _independent(self, seed: int, realization: int) -> dict[int, Array]:
        """Draw the independent Gaussian fields of all properties, by the number of the layer that has its own."""
        # Each property has a Gaussian field of its own, whichever others are random.
        used = {name for layer in self.layers for name in layer.marginals}
        count = 1 + max(place for place, row in enumerate(PROPERTIES) if row.name in used)
        drawn = {
            number: self.gaussian.draw(
                generator(seed, Stream.LAYER if number else Stream.FIELD, realization, number), count
            )
            for number in sorted({layer.field for layer in self.layers})
        }
        return drawn | {
            number: known.conditioned(drawn[number], generator(seed, Stream.NOISE, realization, number))
            for number, known in self.data.items()
        }

    def _of_layer(self, number: int, fields: Mapping[int, Array], realization: int) -> Array:
        """Return the properties in the soil of a layer, (n, ny, nx)."""
        layer = self.layers[number]
        independent = fields.get(layer.field)
        values = np.full((len(self.names), *self.grid.shape), np.nan)
        mixed = [] if independent is None else correlated(layer.factor, independent[layer.places])
        drawn = dict(zip(layer.marginals, mixed, strict=False))
        for name, value in zip(self.names, values, strict=True):
            law = layer.marginals.get(name)
            mean = layer.means[name] if law is None else law.mean
            if law is None or name not in drawn:
                value[self.cells] = mean
            elif realization == BASELINE:
                value[self.cells] = law.mean_given(drawn[name], self.data[layer.field].variance(layer.weights(name)))
            else:
                value[self.cells] = np.ravel(law(drawn[name]))
            if name in drawn:
                is_read = self.cells if layer.cells is None else self.cells & layer.cells
                trend = layer.trends.get(name)
                largest = value if trend is None else value * trend(self.grid.x, self.grid.y[:, None])
                refuse_beyond_limit(name, float(np.max(largest[is_read], initial=0.0)), realization, number)
        return values


def refuse_beyond_limit(name: str, largest: float, realization: int, layer: int = 0) -> None:
    """Raise a SamplerError if the `largest` value of a property [SI] in a layer reaches its limit."""
    row = BY_NAME[name]
    if largest >= row.limit:
        keys = (row.mean_key, row.cov_key)
        mean_key, cov_key = (f"layer.{layer}.{key.partition('.')[2]}" if layer else key for key in keys)
        raise SamplerError(
            f"Realization {realization} has a {row.long_name} of {row.unit.show(largest)}, which must be below "
            f"{row.unit.show(row.limit)}. A lognormal distribution is unbounded; lower {mean_key} or {cov_key}."
        )
