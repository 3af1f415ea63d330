"""Gaussian fields that honour data: an unconditional draw plus the kriged difference between the data and the draw.

The properties of a soil are mixtures of independent standard fields, w_j of field j, so that a datum of any property,
in any layer that shares these fields, is a linear function of them: d_k = sum_j w_kj U_j(p_k), with an error of its own
where it was measured so. Given all data,

    U_j(x) <- U_j(x) + sum_k C(x - p_k) w_kj lambda_k,   K lambda = d - sum_j w_j U_j(p) - error,
    K_kl = C(p_k - p_l) sum_j w_kj w_lj + error variance of k if k = l,

is exact: simple cokriging (Journel and Huijbregts 1978, Mining Geostatistics, ch. VII; Chilès and Delfiner 2012,
Geostatistics, section 7.3). What kriging needs of the data is computed once; a draw costs two triangular solutions and
a matrix-vector product. All sums have a fixed order.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.errors import SamplerError
from campaign.fields.correlation import Array, Correlation
from campaign.fields.reference_grid import ReferenceGrid

LEAST_PIVOT = 1e-10
"""Least share of a datum's variance that the data before it must leave open."""


class Datum(NamedTuple):
    """What is known of independent standard fields in a cell of the grid.

    Attributes
    ----------
    cell : tuple of int
        Row and column; a field has one value in a cell.
    weights : ndarray of shape (j,)
        Of the fields; their squares sum to 1.
    value : float
        Of the mixture.
    error_variance : float
        Of the measurement, in the same unit.
    """

    cell: tuple[int, int]
    weights: Array
    value: float
    error_variance: float


class Conditioning:
    """The data of some independent fields of one correlation, and what kriging with them needs.

    Parameters
    ----------
    data : sequence of Datum
        At most one in a cell has the same weights; see `merged`.
    correlation : Correlation
        Of each of the fields.
    grid : ReferenceGrid
        On which they are drawn.
    cells : ndarray of shape (ny, nx)
        Those of which a draw has values, in row order; they hold those of the data.

    Raises
    ------
    SamplerError
        If a datum follows from the others but for rounding.
    """

    def __init__(
        self, data: Sequence[Datum], correlation: Correlation, grid: ReferenceGrid, cells: NDArray[np.bool_]
    ) -> None:
        self.weights = np.array([datum.weights for datum in data])
        self.values = np.array([datum.value for datum in data])
        self.errors = np.sqrt([datum.error_variance for datum in data])
        rows, columns = np.array([datum.cell for datum in data]).T
        self.places = (np.cumsum(cells.ravel()) - 1)[rows * grid.shape[1] + columns]
        x, y = (each[cells] for each in np.meshgrid(grid.x, grid.y))
        here = x[self.places], y[self.places]
        self.kernel = correlation(here[0][:, None] - x, here[1][:, None] - y)
        overlap = sum(np.multiply.outer(each, each) for each in self.weights.T)
        self.factor = self._factor(self.kernel[:, self.places] * overlap + np.diag(self.errors**2))

    def _factor(self, matrix: Array) -> Array:
        """Return the lower Cholesky factor of the matrix of the data."""
        left, factor = matrix.copy(), np.zeros_like(matrix)
        for k in range(len(matrix)):
            if left[k, k] < LEAST_PIVOT:
                raise SamplerError(
                    "Data of borings lie so close together, compared with the correlation lengths, that some follow "
                    "from the others; give the borings a noise, for instance noise = 0.05, or leave some out."
                )
            factor[k:, k] = left[k:, k] / np.sqrt(left[k, k])
            left[k:, k:] -= np.multiply.outer(factor[k:, k], factor[k:, k])
        return factor

    def _times_inverse(self, vector: Array) -> Array:
        """Return K^-1 v by substitution, forward and back."""
        z = self._forward(vector)
        for k in reversed(range(z.size)):
            z[k] /= self.factor[k, k]
            z[:k] -= self.factor[k, :k] * z[k]
        return z

    def _forward(self, vectors: Array) -> Array:
        """Return L^-1 v for v of shape (data,) or (data, n)."""
        z = vectors.copy()
        for k in range(len(z)):
            z[k] /= self.factor[k, k]
            z[k + 1 :] -= np.multiply.outer(self.factor[k + 1 :, k], z[k])
        return z

    def conditioned(self, fields: Array, rng: np.random.Generator) -> Array:
        """Return independent fields (n, ...) of a draw, n the first of those that have weights, as the data want them.

        Parameters
        ----------
        fields : ndarray
            Not modified.
        rng : numpy.random.Generator
            For the errors of measurement.
        """
        flat = fields.reshape(len(fields), -1)
        drawn = self.errors * rng.standard_normal(self.errors.size)
        for weight, field in zip(self.weights.T, flat, strict=False):
            drawn = drawn + weight * field[self.places]
        return np.asarray((flat + self._kriged(self.values - drawn, len(flat))).reshape(fields.shape))

    @cached_property
    def means(self) -> Array:
        """What the data make of the mean of each field, (j, cells); 0 far from all of them."""
        return self._kriged(self.values, self.weights.shape[1])

    def _kriged(self, differences: Array, count: int) -> Array:
        lambdas = self._times_inverse(differences)
        total = np.zeros((count, self.kernel.shape[1]))
        for weights, factor, kernel in zip(self.weights, lambdas, self.kernel, strict=True):
            total += np.multiply.outer(factor * weights[:count], kernel)
        return total

    def variance(self, weights: Array) -> Array:
        """Return the variance that the data leave to a mixture of the fields, (cells,); 1 far from all of them.

        Parameters
        ----------
        weights : ndarray of shape (j,)
            Of the fields, with squares that sum to 1.
        """
        overlap = sum(own * other for own, other in zip(self.weights.T, weights, strict=True))
        known = self._forward(np.asarray(overlap)[:, None] * self.kernel)
        return np.asarray(np.maximum(1.0 - np.sum(known**2, axis=0), 0.0))


def merged(data: Sequence[Datum]) -> list[Datum]:
    """Return the data with those of one property in one cell, which has one value, as their mean."""
    groups: dict[tuple[object, ...], list[Datum]] = {}
    for datum in data:
        groups.setdefault((datum.cell, *datum.weights.tolist()), []).append(datum)
    return [
        group[0]._replace(
            value=sum(datum.value for datum in group) / len(group),
            error_variance=sum(datum.error_variance for datum in group) / len(group) ** 2,
        )
        for group in groups.values()
    ]
