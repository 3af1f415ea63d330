"""Cross-correlation of the random properties: the matrix that a scene asks for, and Gaussian fields that have it."""

from collections.abc import Mapping, Sequence
from math import sqrt

import numpy as np

from campaign.fields.correlation import Array
from campaign.fields.marginals import Lognormal, gaussian_cross_correlation

Pair = tuple[str, str]

LEAST_PIVOT = 1e-12
"""Least share of a field's variance that the fields before it must leave to itself."""


class NotPositiveDefiniteError(ValueError):
    """No random fields have these cross-correlations."""


def gaussian_matrix(marginals: Mapping[str, Lognormal], pairs: Mapping[Pair, float], of: str) -> Array:
    """Return the correlation matrix of the Gaussian fields behind some properties.

    Parameters
    ----------
    marginals : mapping
        Distribution of each property by name, in the order of the matrix.
    pairs : mapping
        Cross-correlation of two properties; those that are not named are independent.
    of : str
        "gaussian" if `pairs` are of the Gaussian fields, "lognormal" if they are of the properties themselves.

    Returns
    -------
    ndarray of shape (n, n)
    """
    names = list(marginals)
    matrix = np.eye(len(names))
    for (one, other), rho in pairs.items():
        gaussian = gaussian_cross_correlation(rho, marginals[one], marginals[other]) if of == "lognormal" else rho
        i, j = names.index(one), names.index(other)
        matrix[i, j] = matrix[j, i] = gaussian
    return matrix


def lower_factor(matrix: Array) -> Array:
    """Return the lower Cholesky factor L, L L^T = `matrix`, of a correlation matrix (n, n), always in the same order.

    For two properties it is [[1, 0], [rho, sqrt(1 - rho^2)]], eq. (4) of Ma et al.

    Raises
    ------
    NotPositiveDefiniteError
        If the matrix has none.
    """
    factor = np.zeros_like(matrix)
    for i, row in enumerate(matrix.tolist()):
        for j in range(i):
            done = sum(factor[i, k] * factor[j, k] for k in range(j))
            factor[i, j] = (row[j] - done) / factor[j, j]
        left = row[i] - sum(float(entry) ** 2 for entry in factor[i, :i])
        if left < LEAST_PIVOT:
            raise NotPositiveDefiniteError(f"The correlation matrix {matrix.tolist()} is not positive definite.")
        factor[i, i] = sqrt(left)
    return factor


def correlated(factor: Array, fields: Sequence[Array] | Array) -> list[Array]:
    """Mix independent Gaussian fields so that they have the correlation L L^T; sums are in the order of the fields.

    Parameters
    ----------
    factor : ndarray of shape (n, n)
        Lower triangular L.
    fields : sequence of n ndarrays
        Not modified.
    """
    mixed = []
    for i, row in enumerate(factor.tolist()):
        total = row[0] * fields[0]
        for weight, field in zip(row[1 : i + 1], fields[1 : i + 1], strict=True):
            total = total + weight * field
        mixed.append(total)
    return mixed
