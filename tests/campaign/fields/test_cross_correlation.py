"""Cross-correlation of any number of Gaussian fields, by the lower Cholesky factor of their matrix."""

from math import log, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from campaign.fields.cross_correlation import NotPositiveDefiniteError, correlated, gaussian_matrix, lower_factor
from campaign.fields.marginals import Lognormal

LAWS = {"a": Lognormal(1.0, 0.1), "b": Lognormal(2.0, 0.3), "c": Lognormal(3.0, 0.5)}


def random_correlation_matrix(n, seed):
    """Normalised Gram matrix of random vectors."""
    vectors = np.random.default_rng(seed).standard_normal((n, n + 2))
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    matrix = vectors @ vectors.T
    np.fill_diagonal(matrix, 1.0)
    return matrix


@pytest.mark.parametrize("n", [1, 2, 3, 4, 6])
def test_the_factor_is_the_cholesky_factor(n):
    """The oracle is LAPACK."""
    matrix = random_correlation_matrix(n, seed=n)
    np.testing.assert_allclose(lower_factor(matrix), np.linalg.cholesky(matrix), rtol=0.0, atol=1e-14)


@given(rho=st.floats(-0.999, 0.999), z=st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0)))
def test_two_fields_are_mixed_as_the_paper_has_it(rho, z):
    """Eq. (3) and (4), bit for bit: Z_1, and rho Z_1 + sqrt(1 - rho^2) Z_2."""
    first, second = (np.array([value]) for value in z)
    mixed = correlated(lower_factor(np.array([[1.0, rho], [rho, 1.0]])), [first, second])
    assert np.array_equal(mixed[0], first)
    assert np.array_equal(mixed[1], rho * first + sqrt(1.0 - rho**2) * second)


def test_fields_that_come_later_change_nothing_in_those_before():
    matrix = random_correlation_matrix(4, seed=1)
    fields = np.random.default_rng(2).standard_normal((4, 5, 3))
    four = correlated(lower_factor(matrix), fields)
    for n in (1, 2, 3):
        few = correlated(lower_factor(matrix[:n, :n]), fields[:n])
        assert all(np.array_equal(one, other) for one, other in zip(few, four, strict=False))


def test_every_entry_of_lognormal_fields_is_converted():
    """rho_G = ln(1 + rho COV_1 COV_2) / (sigma_1 sigma_2), sigma^2 = ln(1 + COV^2); pairs not named are independent."""
    matrix = gaussian_matrix(LAWS, {("a", "b"): -0.5, ("c", "b"): 0.4}, "lognormal")
    sigma = {name: sqrt(log(1.0 + law.cov**2)) for name, law in LAWS.items()}
    a_b = log(1.0 - 0.5 * 0.1 * 0.3) / (sigma["a"] * sigma["b"])
    b_c = log(1.0 + 0.4 * 0.3 * 0.5) / (sigma["b"] * sigma["c"])
    np.testing.assert_allclose(matrix, [[1.0, a_b, 0.0], [a_b, 1.0, b_c], [0.0, b_c, 1.0]], rtol=1e-14)
    assert gaussian_matrix(LAWS, {("c", "b"): 0.4}, "gaussian")[1, 2] == 0.4


def with_third(rho):
    """With 0.8 and 0.8 the third must lie between 0.8^2 - (1 - 0.8^2) = 0.28 and 1: the determinant is 0 at both."""
    return np.array([[1.0, 0.8, 0.8], [0.8, 1.0, rho], [0.8, rho, 1.0]])


@pytest.mark.parametrize("rho", [-1.0, 0.0, 0.28 - 1e-9])
def test_correlations_that_exclude_each_other_are_refused(rho):
    with pytest.raises(NotPositiveDefiniteError, match="not positive definite"):
        lower_factor(with_third(rho))


@pytest.mark.parametrize("rho", [0.28 + 1e-9, 0.64, 0.999])
def test_correlations_that_are_only_just_possible_are_accepted(rho):
    factor = lower_factor(with_third(rho))
    np.testing.assert_allclose(factor @ factor.T, with_third(rho), atol=1e-14)
