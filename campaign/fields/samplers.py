"""Standard Gaussian random fields with a prescribed correlation, on a grid, by two exact methods.

Every sampler, that of `campaign.fields.cholesky` included, is a fixed linear map A of white noise with A A^T = C, the
correlation matrix of the points, and keeps two parts apart: `correlate` applies A, `draw` feeds it. A draw is any
number of independent fields, and the first of many are those of a draw of few. The products are summed in an order that
depends on neither the number of threads nor the BLAS library.
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy import fft, linalg

from campaign.errors import SamplerError
from campaign.fields.correlation import Array, Correlation
from solver._jit import exact

MEMORY_LIMIT = 4 * 10**9
"""Bytes that a sampler may use; as much as a Cholesky factor of 22,000 points."""

LEAST_EIGENVALUE = -1e-12
"""Most negative eigenvalue of a circulant matrix, relative to the largest, that still counts as rounding."""


class Sampler(Protocol):
    """Anything that draws independent standard Gaussian fields."""

    def draw(self, rng: np.random.Generator, n: int) -> Array:
        """Draw `n` fields, an array of shape (n, ...), whose trailing shape is that of the sampler's points."""
        ...


class KroneckerSampler:
    """Field on a grid as A_y Z A_x^T, exact where the correlation is a product of one in x and one in y.

    The factors are symmetric square roots from an eigendecomposition. They exist for numerically singular matrices too,
    for which negative eigenvalues, which are rounding errors, count as zero.

    Parameters
    ----------
    correlation : Correlation
        Separable correlation.
    x, y : ndarray of shape (nx,) and (ny,)
        Coordinates of the columns and the rows of the grid [m].

    Attributes
    ----------
    clip_mass : float
        Larger of the two shares of the trace that clipping took away; of the order of 1e-15.

    Raises
    ------
    SamplerError
        If the correlation is not separable, or the grid is too long.
    """

    def __init__(self, correlation: Correlation, x: Array, y: Array) -> None:
        if not correlation.is_separable:
            raise SamplerError(
                f"The {correlation.kind} correlation at {np.degrees(correlation.angle):g} degrees is not a product of "
                'one in x and one in y, which the sampler "kronecker" needs; use the sampler "circulant".'
            )
        refuse_large(8 * max(x.size, y.size) ** 2, f"A Kronecker factor of {max(x.size, y.size)} points")
        self._root_x, clip_x = symmetric_root(correlation(x[:, None] - x, 0.0))
        self._root_y, clip_y = symmetric_root(correlation(0.0, y[:, None] - y))
        self.clip_mass = max(clip_x, clip_y)

    def correlate(self, noise: Array) -> Array:
        """Turn white noise of shape (n, ny, nx) into n fields of the same shape."""
        return np.stack([multiply(multiply(self._root_y, z), self._root_x) for z in noise])

    def draw(self, rng: np.random.Generator, n: int) -> Array:
        """Draw `n` independent fields, shape (n, ny, nx)."""
        return self.correlate(rng.standard_normal((n, len(self._root_y), len(self._root_x))))


class CirculantSampler:
    """Field on a grid cut from a periodic one, whose correlation matrix the Fourier transform makes diagonal.

    The period grows until the eigenvalues of the circulant matrix are non-negative up to rounding; then the field is
    exact. The real and the imaginary part of one complex transform are two independent fields.

    Parameters
    ----------
    correlation : Correlation
        Any correlation.
    shape : tuple of int
        Rows and columns (ny, nx) of the grid.
    spacing : float or tuple of float
        Distance of neighbouring points [m], or that of rows and that of columns.

    Attributes
    ----------
    torus : tuple of int
        Rows and columns of the periodic grid.
    least_eigenvalue : float
        Most negative eigenvalue over the largest one, at least `LEAST_EIGENVALUE`.
    clip_mass : float
        Sum of the negative eigenvalues, which count as zero, over the trace.

    Raises
    ------
    SamplerError
        If no affordable period has non-negative eigenvalues.

    Notes
    -----
    Dietrich and Newsam (1997), doi:10.1137/S1064827592240555.
    """

    def __init__(self, correlation: Correlation, shape: tuple[int, int], spacing: float | tuple[float, float]) -> None:
        self.shape = shape
        self.torus = smallest_torus(shape)
        apart = spacing if isinstance(spacing, tuple) else (spacing, spacing)
        eigenvalues = circulant_eigenvalues(correlation, self.torus, apart)
        while eigenvalues.min() < LEAST_EIGENVALUE * eigenvalues.max():
            self.torus = larger_torus(self.torus, correlation, apart)
            eigenvalues = circulant_eigenvalues(correlation, self.torus, apart)
        kept = eigenvalues.clip(min=0.0)
        self.least_eigenvalue = float(eigenvalues.min() / eigenvalues.max())
        self.clip_mass = float((kept - eigenvalues).sum() / eigenvalues.sum())
        self._amplitude = np.sqrt(kept / kept.size)

    def correlate(self, noise: Array) -> Array:
        """Turn white noise of shape (*torus, 2) into two fields of shape (2, ny, nx)."""
        modes = noise.view(np.complex128)[..., 0] * self._amplitude
        rows, columns = self.shape
        # Only these rows are wanted, so that the second transform has no need of the others.
        strip = fft.fft(modes, axis=0, overwrite_x=True, workers=1)[:rows]
        field = fft.fft(strip, axis=1, workers=1)[:, :columns]
        return np.stack([field.real, field.imag])

    def draw(self, rng: np.random.Generator, n: int) -> Array:
        """Draw `n` independent fields, shape (n, ny, nx), two a transform."""
        pairs = [self.correlate(rng.standard_normal((*self.torus, 2))) for _ in range((n + 1) // 2)]
        return np.concatenate(pairs)[:n]


def symmetric_root(matrix: Array) -> tuple[Array, float]:
    """Return the symmetric square root of a positive semi-definite matrix, and the share of its trace clipped."""
    eigenvalues, vectors = linalg.eigh(matrix)
    kept = eigenvalues.clip(min=0.0)
    root = (vectors * np.sqrt(kept)) @ vectors.T
    return root, float((kept - eigenvalues).sum() / eigenvalues.sum())


def smallest_torus(shape: tuple[int, int]) -> tuple[int, int]:
    """Return the smallest periodic grid, fast to transform, that is too large for any lag within `shape` to wrap."""
    rows, columns = (fft.next_fast_len(2 * n - 1) for n in shape)
    return rows, columns


def larger_torus(torus: tuple[int, int], correlation: Correlation, spacing: tuple[float, float]) -> tuple[int, int]:
    """Lengthen the period that is the shorter one, measured in autocorrelation distances."""
    reach_x, reach_y = correlation.reach
    rows, columns = torus
    if rows / reach_y < columns / reach_x * (spacing[1] / spacing[0]):
        rows = fft.next_fast_len(rows + rows // 8 + 1)
    else:
        columns = fft.next_fast_len(columns + columns // 8 + 1)
    return rows, columns


def circulant_eigenvalues(correlation: Correlation, torus: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return the transform of the correlation with the origin of a periodic grid; lags are the shorter ones."""
    rows, columns = torus
    # Eigenvalues, amplitudes, noise, modes and the field: eight numbers a point at the same time.
    size = f"{spacing[1] * columns:.0f} m x {spacing[0] * rows:.0f} m"
    refuse_large(64 * rows * columns, f"A circulant embedding of {size}")
    y, x = (apart * n * fft.fftfreq(n) for apart, n in zip(spacing, torus, strict=True))
    # At half the period a lag and its opposite are the same point; the real part takes the mean of their correlations.
    return np.asarray(fft.fft2(correlation(x, y[:, None]), workers=1).real)


def refuse_large(n_bytes: int, what: str) -> None:
    """Raise a SamplerError for anything above `MEMORY_LIMIT`."""
    if n_bytes > MEMORY_LIMIT:
        raise SamplerError(
            f"{what} takes {n_bytes / 1e9:.1f} GB of memory, and the limit is {MEMORY_LIMIT / 1e9:.1f} GB; "
            "use a coarser field resolution or another sampler."
        )


def multiply(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Multiply two matrices in the order of their inner index."""
    product = np.zeros((a.shape[0], b.shape[1]))
    _add_product(product, a, b)
    return product


@exact
def _add_product(product: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64]) -> None:
    for i in range(a.shape[0]):
        for k in range(a.shape[1]):
            a_ik = a[i, k]
            for j in range(b.shape[1]):
                product[i, j] += a_ik * b[k, j]
