"""The Cholesky decomposition method of Ma et al.: any positive definite correlation, any points, one large matrix.

The factor depends, in its last bits, on the processor and on the number of threads. It is therefore computed once for a
campaign and kept in a file with its checksum, which every rank, and every later continuation, maps into memory.
"""

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from campaign.errors import SamplerError
from campaign.fields.correlation import Array, Correlation
from campaign.fields.samplers import refuse_large
from campaign.files import publish, temporary_name, write_atomically
from solver._jit import exact

FACTOR_FILE = "field_factor.npy"


class CholeskySampler:
    """Field at scattered points as L z, with the lower Cholesky factor L of their correlation matrix.

    Parameters
    ----------
    correlation : Correlation
        Any correlation that is positive definite in double precision.
    x, y : ndarray of shape (n,)
        Coordinates of the points [m].
    directory : Path, optional
        Where the factor is kept, or found. Without one it is held in memory alone.

    Raises
    ------
    SamplerError
        If the factor is too large, does not exist, or the one in the directory is damaged or of another field.

    Notes
    -----
    A pickled sampler carries its arguments, not the factor: other ranks open the file that the first one wrote, or,
    without a directory, factorise again.
    """

    def __init__(self, correlation: Correlation, x: Array, y: Array, directory: Path | None = None) -> None:
        self._arguments = correlation, x, y, directory
        if directory is None:
            self._factor = cholesky_factor(correlation, x, y)
        else:
            self._factor = kept_factor(correlation, x, y, directory / FACTOR_FILE)

    def __reduce__(self) -> tuple[Any, ...]:
        return CholeskySampler, self._arguments

    def correlate(self, noise: Array) -> Array:
        """Turn white noise of shape (n, points) into n fields of the same shape."""
        return np.asarray(multiply_lower(self._factor, noise))

    def draw(self, rng: np.random.Generator, n: int) -> Array:
        """Draw `n` independent fields, shape (n, points)."""
        return self.correlate(rng.standard_normal((n, len(self._factor))))


def cholesky_factor(correlation: Correlation, x: Array, y: Array) -> Array:
    """Factorise the correlation matrix of scattered points.

    Parameters
    ----------
    correlation : Correlation
        Any correlation that is positive definite in double precision.
    x, y : ndarray of shape (n,)
        Coordinates of the points [m].

    Returns
    -------
    ndarray of shape (n, n)
        Lower triangular L with L L^T = C, columns contiguous.

    Raises
    ------
    SamplerError
        If the factor is too large, or the matrix is numerically singular.
    """
    refuse_large(8 * x.size**2, f"A Cholesky factor of {x.size} points")
    matrix = np.empty((x.size, x.size), order="F")
    for block in np.array_split(np.arange(x.size), max(1, x.size // 256)):
        matrix[:, block] = correlation(x[:, None] - x[block], y[:, None] - y[block])
    try:
        return np.asarray(linalg.cholesky(matrix, lower=True, overwrite_a=True, check_finite=False))
    except linalg.LinAlgError as error:
        raise SamplerError(
            f"The {correlation.kind} correlation matrix of {x.size} points is numerically singular: the points are so "
            "close, compared with the autocorrelation distances, that rounding makes it indefinite and it has no "
            f'Cholesky factor. Use the sampler "{"kronecker" if correlation.is_separable else "circulant"}", which '
            "needs none."
        ) from error


def kept_factor(correlation: Correlation, x: Array, y: Array, path: Path) -> Array:
    """Map the factor in a file into memory, read-only, after computing it if there is none yet."""
    checksum = path.with_name(path.name + ".sha256")
    # The checksum is written last: a factor without one is a factor whose writing was cut short.
    if not checksum.exists():
        with open(temporary_name(path), "wb") as file:
            np.save(file, cholesky_factor(correlation, x, y))
        publish(temporary_name(path), path)
        write_atomically(checksum, f"{sha256(path)}  {path.name}\n".encode())
    if not path.exists() or sha256(path) != checksum.read_text().split()[0]:
        raise SamplerError(
            f"The field factor {path} is missing or damaged: it does not match its checksum in {checksum.name}. "
            "Restore both from a copy, or delete both and start the campaign again."
        )
    return matching(np.asarray(np.load(path, mmap_mode="r")), correlation, x, y, path)


def matching(factor: Array, correlation: Correlation, x: Array, y: Array, path: Path) -> Array:
    """Return the factor if its first column, L_i1 = C_i1, is that of the correlation and the points."""
    first_column = correlation(x - x[0], y - y[0])
    if factor.shape != (x.size, x.size) or not np.allclose(factor[:, 0], first_column, rtol=0.0, atol=1e-12):
        raise SamplerError(
            f"The field factor {path} belongs to another field, of {len(factor)} points; this one has {x.size} points. "
            "Choose another output directory for a campaign with another field."
        )
    return factor


def sha256(path: Path) -> str:
    """Return the SHA-256 checksum of a file, in hexadecimal."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def multiply_lower(lower: NDArray[np.float64], vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Multiply each of the vectors (m, n) by a lower triangular matrix, column by column as it lies in memory."""
    product = np.zeros_like(vectors)
    _add_product(product, lower, vectors)
    return product


@exact
def _add_product(product: NDArray[np.float64], lower: NDArray[np.float64], vectors: NDArray[np.float64]) -> None:
    for j in range(lower.shape[0]):
        column = lower[j:, j]
        for f in range(vectors.shape[0]):
            # One sum at a time, over views from zero on: the compiler makes vector instructions of it.
            target, z = product[f, j:], vectors[f, j]
            for i in range(column.size):
                target[i] += column[i] * z
