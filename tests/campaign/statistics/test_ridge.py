"""Leaving one value out in closed form is leaving it out."""

import numpy as np
import pytest

from campaign.statistics import ridge as module
from campaign.statistics.ridge import explained_by, ridge

RNG = np.random.default_rng(11)
PREDICTORS = RNG.normal(size=(30, 4)) @ RNG.normal(size=(4, 4))
OUTCOME = PREDICTORS @ [1.0, 0.0, -0.5, 0.2] + RNG.normal(size=30)


def foretold(penalty):
    """Return the share of the variance that 30 fits, each without one value, foretell of it."""
    missed, about_mean = [], []
    for k in range(30):
        kept = np.arange(30) != k
        x, y = PREDICTORS[kept], OUTCOME[kept]
        centred = x - x.mean(axis=0)
        slope = np.linalg.solve(centred.T @ centred + penalty * np.eye(4), centred.T @ (y - y.mean()))
        missed.append(OUTCOME[k] - y.mean() - (PREDICTORS[k] - x.mean(axis=0)) @ slope)
        about_mean.append(OUTCOME[k] - y.mean())
    return 1 - np.sum(np.square(missed)) / np.sum(np.square(about_mean))


def test_linear_regression_foretells_what_thirty_fits_do():
    assert explained_by(PREDICTORS, OUTCOME) == pytest.approx(foretold(0.0), rel=1e-10)


def test_a_small_penalty_leaves_linear_regression(monkeypatch):
    monkeypatch.setattr(module, "PENALTIES", np.array([1e-14]))
    fit = ridge(PREDICTORS, OUTCOME)
    design = np.column_stack([np.ones(30), PREDICTORS])
    expected = np.linalg.lstsq(design, OUTCOME, rcond=None)[0]
    np.testing.assert_allclose(fit.coefficients, expected[1:], rtol=1e-9)
    np.testing.assert_allclose(fit.operator @ fit.operator.T, np.linalg.inv(design.T @ design)[1:, 1:], rtol=1e-8)
    about_mean = np.mean((OUTCOME - OUTCOME.mean()) ** 2) * (30 / 29) ** 2
    assert fit.variance == pytest.approx((1 - foretold(0.0)) * about_mean)


def test_the_penalty_is_that_which_foretells_most():
    fit = ridge(PREDICTORS, OUTCOME)
    scale = np.mean(np.linalg.svd(PREDICTORS - PREDICTORS.mean(axis=0), compute_uv=False) ** 2)
    # The mean of the others is not the mean of all, which changes a penalised fit by a part in n^2.
    shares = [foretold(penalty * scale) for penalty in module.PENALTIES]
    assert fit.explained == pytest.approx(max(shares), abs=2e-3)
