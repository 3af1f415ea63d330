"""Fields whose correlation reaches so far that they hardly change from cell to cell.

A periodic grid must be several correlation lengths long, which for a ground of 75 m in a field of 10 km is 4 GB of
places outside the ground. There the field is drawn at fewer columns and rows, as far apart as the correlation stays
near 1, and is linear between them, scaled so that its variance is 1 everywhere. Where nodes are few, a Cholesky factor
of their correlation takes the place of the periodic grid. In the limit of perfect correlation this is exact.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.fields.cholesky import multiply_lower
from campaign.fields.correlation import Array, Correlation
from campaign.fields.embedding import circulant_bytes
from campaign.fields.samplers import CirculantSampler, refuse_large

LARGEST_EMBEDDING = 10**9
"""Bytes of a periodic grid from which on fewer nodes are drawn."""

LOST = 2e-3
"""Of the correlation between two neighbouring nodes along an axis."""

FEW = 1500
"""Nodes of which the correlation matrix is factorised."""

LEAST_PIVOT = 1e-12
"""Share of the variance of a node below which the nodes before it say all of it."""


class Nodes(NamedTuple):
    """Columns or rows at which a field is drawn, and the n cells between them.

    Attributes
    ----------
    stride : int
        Cells from one to the next.
    number : int
        Of the nodes.
    before : ndarray of shape (n,)
        Number of the node at or before a cell, of at most `number - 2`.
    share : ndarray of shape (n,)
        Of the way to the next one.
    """

    stride: int
    number: int
    before: NDArray[np.intp]
    share: Array

    @classmethod
    def along(cls, n: int, stride: int) -> "Nodes":
        """Return as many as n cells take."""
        number = _number(n, stride)
        before = np.minimum(np.arange(n) // stride, max(number - 2, 0))
        return cls(stride, number, before, np.arange(n) / stride - before)

    def between(self, values: Array, axis: int) -> Array:
        """Interpolate values at the nodes, along an axis of an array."""
        share = np.expand_dims(self.share, tuple(range(1, values.ndim - axis)))
        after = np.minimum(self.before + 1, self.number - 1)
        here, there = np.take(values, self.before, axis=axis), np.take(values, after, axis=axis)
        return np.asarray((1.0 - share) * here + share * there)


class StretchedSampler:
    """Field on a grid, linear between nodes that are almost perfectly correlated with their neighbours.

    Parameters
    ----------
    correlation : Correlation
    shape : tuple of int
        Rows and columns (ny, nx) of the grid.
    spacing : float
        Distance of neighbouring points [m].

    Raises
    ------
    SamplerError
        If the grid, or that of the nodes, is too large.
    """

    def __init__(self, correlation: Correlation, shape: tuple[int, int], spacing: float) -> None:
        refuse_large(24 * shape[0] * shape[1], f"A field of {shape[1]} x {shape[0]} points")
        strides = strides_of(correlation, shape, spacing)
        self.rows, self.columns = (Nodes.along(*each) for each in zip(shape, strides, strict=True))
        apart = spacing * self.rows.stride, spacing * self.columns.stride
        count = self.rows.number, self.columns.number
        self.nodes: FewPoints | CirculantSampler = (
            FewPoints(correlation, count, apart)
            if count[0] * count[1] <= FEW
            else CirculantSampler(correlation, count, apart)
        )
        self._scale = 1.0 / np.sqrt(self._variance(correlation, apart))

    def _variance(self, correlation: Correlation, apart: tuple[float, float]) -> Array:
        """Return the variance of what is linear between nodes, (ny, nx)."""
        y, x = ((1.0 - nodes.share, nodes.share) for nodes in (self.rows, self.columns))
        total = np.zeros((y[0].size, x[0].size))
        for a, b, c, d in np.ndindex(2, 2, 2, 2):
            weight = np.multiply.outer(y[a] * y[b], x[c] * x[d])
            total += weight * correlation((c - d) * apart[1], (a - b) * apart[0])
        return total

    def correlate(self, noise: Array) -> Array:
        """Turn white noise, of the shape that the sampler of the nodes takes, into fields of shape (n, ny, nx)."""
        return self._spread(self.nodes.correlate(noise))

    def draw(self, rng: np.random.Generator, n: int) -> Array:
        """Draw `n` independent fields, shape (n, ny, nx)."""
        return self._spread(self.nodes.draw(rng, n))

    def _spread(self, drawn: Array) -> Array:
        return np.asarray(self.columns.between(self.rows.between(drawn, 1), 2) * self._scale)


class FewPoints:
    """Field on a small grid as L z, with a Cholesky factor that exists for singular matrices too.

    Parameters are as of `CirculantSampler`.
    """

    def __init__(self, correlation: Correlation, shape: tuple[int, int], spacing: tuple[float, float]) -> None:
        self.shape = shape
        y, x = (each.ravel() for each in np.indices(shape))
        left = correlation((x[:, None] - x) * spacing[1], (y[:, None] - y) * spacing[0])
        self._factor = np.zeros(left.shape, order="F")
        for k in range(x.size):
            if left[k, k] > LEAST_PIVOT:
                self._factor[k:, k] = left[k:, k] / np.sqrt(left[k, k])
                left[k:, k:] -= np.multiply.outer(self._factor[k:, k], self._factor[k:, k])

    def correlate(self, noise: Array) -> Array:
        """Turn white noise of shape (n, points) into n fields of shape (ny, nx)."""
        return np.asarray(multiply_lower(self._factor, noise)).reshape(-1, *self.shape)

    def draw(self, rng: np.random.Generator, n: int) -> Array:
        """Draw `n` independent fields, shape (n, ny, nx)."""
        return self.correlate(rng.standard_normal((n, len(self._factor))))


def strides_of(correlation: Correlation, shape: tuple[int, int], spacing: float) -> tuple[int, int]:
    """Return how many rows, and how many columns, are between nodes that are as far apart as `LOST` allows."""
    return (
        _stride(lambda cells: float(correlation(0.0, cells * spacing)), shape[0]),
        _stride(lambda cells: float(correlation(cells * spacing, 0.0)), shape[1]),
    )


def stretched_bytes(correlation: Correlation, shape: tuple[int, int], spacing: float) -> tuple[float, float]:
    """Return bounds of the memory [bytes] of a `StretchedSampler`."""
    strides, whole = strides_of(correlation, shape, spacing), 24.0 * shape[0] * shape[1]
    rows, columns = (_number(*each) for each in zip(shape, strides, strict=True))
    if rows * columns <= FEW:
        factor = 16.0 * (rows * columns) ** 2
        return whole + factor, whole + factor
    apart = spacing * strides[0], spacing * strides[1]
    least, most = circulant_bytes(correlation, (rows, columns), apart)
    return whole + least, whole + most


def _number(n: int, stride: int) -> int:
    return 1 if n == 1 else -(-(n - 1) // stride) + 1


def _stride(correlation: Callable[[int], float], cells: int) -> int:
    """Return the largest number of cells over which a correlation loses no more than `LOST`, from 1 to all of them."""
    low, high = 1, max(cells - 1, 1)
    while low < high:
        middle = (low + high + 1) // 2
        low, high = (middle, high) if correlation(middle) >= 1.0 - LOST else (low, middle - 1)
    return low
