"""The random soil properties of a realization as cross-correlated fields on a grid of their own.

The field belongs to the ground, not to the mesh: it is drawn on a reference grid, and a particle reads it once, at its
initial place. Realization k is therefore the same ground on every mesh. Equations are those of section 2.1 of Ma,
Rezania and Mousavi Nezhad. Which properties there are says `campaign.fields.properties`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from campaign.errors import SamplerError
from campaign.fields.correlation import Array
from campaign.fields.cross_correlation import correlated
from campaign.fields.marginals import Lognormal
from campaign.fields.properties import BY_NAME, PROPERTIES
from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.samplers import Sampler
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
        In SI units; NaN in cells that the sampler left out as not in the ground.
    """

    grid: ReferenceGrid
    names: tuple[str, ...]
    values: Array

    def __getitem__(self, name: str) -> Array:
        """Return the values of a property, shape (ny, nx)."""
        return np.asarray(self.values[self.names.index(name)])

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

    def at(self, x: Array, y: Array) -> dict[str, Array]:
        """Read the properties, by name, at the initial places `x`, `y` [m] of particles; each of the shape of `x`.

        Raises
        ------
        ValueError
            If a place is outside the grid, or in a cell that was left out.
        """
        row, column = self.grid.index(x, y)
        values = self.values[:, row, column]
        if missing := np.flatnonzero(np.isnan(values[0])).tolist():
            raise ValueError(
                f"The place ({np.ravel(x)[missing[0]]:g} m, {np.ravel(y)[missing[0]]:g} m) is not in the ground for "
                'which the random field was built; use the sampler "circulant", which fills the whole box.'
            )
        return dict(zip(self.names, values, strict=True))


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
    marginals : mapping
        Distribution [SI] of each random property by name, in the order of the table of properties.
    factor : ndarray of shape (n, n)
        Lower Cholesky factor of the cross-correlations of the Gaussian fields.
    """

    grid: ReferenceGrid
    cells: NDArray[np.bool_]
    gaussian: Sampler
    marginals: Mapping[str, Lognormal]
    factor: Array

    def draw(self, seed: int, realization: int) -> Strengths:
        """Draw the properties of one realization, or their means everywhere for `BASELINE`.

        Raises
        ------
        SamplerError
            If a value reaches the limit of its property.
        """
        if realization == BASELINE:
            return self._strengths([np.asarray(law.mean) for law in self.marginals.values()])
        # Each property has a Gaussian field of its own, whichever others are random.
        own = [place for place, row in enumerate(PROPERTIES) if row.name in self.marginals]
        independent = self.gaussian.draw(generator(seed, Stream.FIELD, realization), own[-1] + 1)[own]
        mixed = correlated(self.factor, independent)
        fields = [law(field) for law, field in zip(self.marginals.values(), mixed, strict=True)]
        for name, field in zip(self.marginals, fields, strict=True):
            refuse_beyond_limit(name, float(field.max()), realization)
        return self._strengths(fields)

    def _strengths(self, fields: list[Array]) -> Strengths:
        values = np.full((len(fields), *self.grid.shape), np.nan)
        for value, field in zip(values, fields, strict=True):
            value[self.cells] = np.ravel(field)
        return Strengths(self.grid, tuple(self.marginals), values)


def refuse_beyond_limit(name: str, largest: float, realization: int) -> None:
    """Raise a SamplerError if the `largest` value of a property [SI] reaches its limit."""
    row = BY_NAME[name]
    if largest >= row.limit:
        raise SamplerError(
            f"Realization {realization} has a {row.long_name} of {row.unit.show(largest)}, which must be below "
            f"{row.unit.show(row.limit)}. A lognormal distribution is unbounded; lower {row.mean_key} or {row.cov_key}."
        )
