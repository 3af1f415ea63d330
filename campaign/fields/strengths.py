"""Cohesion and friction angle as cross-correlated lognormal random fields on a grid of their own.

The field belongs to the ground, not to the mesh: it is drawn on a reference grid, and a particle reads it once, at its
initial place. Realization k is therefore the same ground on every mesh. Equations are those of section 2.1 of Ma,
Rezania and Mousavi Nezhad.
"""

from dataclasses import dataclass
from math import pi, sqrt
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from campaign.errors import SamplerError
from campaign.fields.cholesky import CholeskySampler
from campaign.fields.correlation import Array, Correlation, autocorrelation_distance
from campaign.fields.marginals import Constant, Lognormal, gaussian_cross_correlation
from campaign.fields.reference_grid import Mask, ReferenceGrid
from campaign.fields.samplers import CirculantSampler, KroneckerSampler, Sampler
from campaign.scene.sections import Cohesion, FrictionAngle, RandomField
from campaign.seeds import BASELINE, Stream, generator

if TYPE_CHECKING:
    import xarray as xr

AUTOMATIC = "circulant"
"""Sampler for any correlation and angle, and the only one without a matrix factorisation, whose last bits depend on the
processor and the number of threads."""

CELLS_PER_DISTANCE = 8
"""Cells of the reference grid per shorter autocorrelation distance, where the scene does not say."""


@dataclass(frozen=True)
class Strengths:
    """Peak strength of one realization, on the reference grid.

    Parameters
    ----------
    grid : ReferenceGrid
        Where the values are.
    cohesion, friction_angle : ndarray of shape (ny, nx)
        Cohesion [Pa] and friction angle [rad]; NaN in cells that the sampler left out as not in the ground.
    """

    grid: ReferenceGrid
    cohesion: Array
    friction_angle: Array

    def to_dataset(self) -> "xr.Dataset":
        """Return the fields as an xarray dataset by elevation `y` and place `x` (m)."""
        import xarray as xr

        about = {"cohesion": ("Pa", "peak cohesion"), "friction_angle": ("rad", "peak friction angle")}
        fields = {
            name: (("y", "x"), getattr(self, name), {"units": units, "long_name": long_name})
            for name, (units, long_name) in about.items()
        }
        places = {
            "x": ("x", self.grid.x, {"units": "m", "long_name": "horizontal place"}),
            "y": ("y", self.grid.y, {"units": "m", "long_name": "elevation"}),
        }
        return xr.Dataset(fields, places)

    def at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Read cohesion [Pa] and friction angle [rad] at the initial places `x`, `y` [m] of particles.

        Raises
        ------
        ValueError
            If a place is outside the grid, or in a cell that was left out.
        """
        cell = self.grid.index(x, y)
        cohesion, friction_angle = self.cohesion[cell], self.friction_angle[cell]
        if missing := np.flatnonzero(np.isnan(cohesion)).tolist():
            raise ValueError(
                f"The place ({np.ravel(x)[missing[0]]:g} m, {np.ravel(y)[missing[0]]:g} m) is not in the ground for "
                'which the random field was built; use the sampler "circulant", which fills the whole box.'
            )
        return cohesion, friction_angle


@dataclass(frozen=True)
class StrengthSampler:
    """Everything that turns the identity of a realization into strengths; can be pickled.

    Parameters
    ----------
    grid : ReferenceGrid
        Where fields are drawn.
    cells : ndarray of shape (ny, nx)
        The cells, in row order, for which `gaussian` draws values.
    gaussian : Sampler
        Draws two independent standard Gaussian fields.
    cohesion, friction_angle : Lognormal, Lognormal or Constant
        Marginal distributions [Pa, rad].
    cross_correlation : float
        Correlation of the two Gaussian fields.
    """

    grid: ReferenceGrid
    cells: NDArray[np.bool_]
    gaussian: Sampler
    cohesion: Lognormal
    friction_angle: Lognormal | Constant
    cross_correlation: float

    def draw(self, seed: int, realization: int) -> Strengths:
        """Draw the strengths of one realization, or the mean strengths for `BASELINE`.

        Raises
        ------
        SamplerError
            If a friction angle reaches 90 degrees.
        """
        if realization == BASELINE:
            return self._strengths(self.cohesion.mean, self.friction_angle.mean)
        first, second = self.gaussian.draw(generator(seed, Stream.FIELD, realization))
        rho = self.cross_correlation
        friction_angle = self.friction_angle(rho * first + sqrt(1.0 - rho**2) * second)  # eq. (4)
        if friction_angle.max() >= pi / 2:
            raise SamplerError(
                f"Realization {realization} has a friction angle of {np.degrees(friction_angle.max()):.1f} degrees, "
                "for a lognormal distribution is unbounded; lower soil.friction_angle.mean or soil.friction_angle.cov."
            )
        return self._strengths(self.cohesion(first), friction_angle)

    def _strengths(self, cohesion: Array | float, friction_angle: Array | float) -> Strengths:
        fields = np.full((2, *self.grid.shape), np.nan)
        fields[0, self.cells], fields[1, self.cells] = np.ravel(cohesion), np.ravel(friction_angle)
        return Strengths(self.grid, *fields)


def strength_sampler(
    field: RandomField,
    cohesion: Cohesion,
    friction_angle: FrictionAngle | None,
    width: float,
    height: float,
    directory: Path | None = None,
    soil: Mask | None = None,
) -> StrengthSampler:
    """Build the sampler of a scene.

    Parameters
    ----------
    field, cohesion, friction_angle : RandomField, Cohesion, FrictionAngle
        Sections of a scene: correlation and marginals; without a friction angle it is 0.
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
    correlation = correlation_of(field)
    finest = min(correlation.horizontal, correlation.vertical)
    grid = ReferenceGrid.covering(width, height, field.resolution or finest / CELLS_PER_DISTANCE)
    method = AUTOMATIC if field.sampler == "auto" else field.sampler
    cells = grid.cells_with(soil if method == "cholesky" else None)
    gaussian = gaussian_sampler(method, correlation, grid, cells, directory)
    first = Lognormal(cohesion.mean, cohesion.cov)
    second = Lognormal(friction_angle.mean, friction_angle.cov) if friction_angle else Constant(0.0)
    rho = field.cross_correlation
    if field.cross_correlation_of == "lognormal" and isinstance(second, Lognormal):
        rho = gaussian_cross_correlation(rho, first, second)
    return StrengthSampler(grid, cells, gaussian, first, second, rho)


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
