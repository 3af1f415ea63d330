"""The polynomials that stand in for the C library, and both softening laws."""

import numpy as np
import pytest
from pointwise import evaluate_cosine, evaluate_exp_decay, evaluate_sine

from solver.softening import Softening, Strength, remaining_shares, softened_strength


def test_exp_decay_equals_the_library_to_1e_11():
    x = np.concatenate([np.linspace(0.0, 32.0, 20_001), np.logspace(-12, 0, 1000)])
    found = np.empty_like(x)
    evaluate_exp_decay(x, found)
    np.testing.assert_allclose(found, np.exp(-x), rtol=1e-11, atol=0.0)


def test_exp_decay_far_out_is_as_good_as_nothing():
    x = np.array([33.0, 1e3, 1e300, np.inf])
    found = np.empty_like(x)
    evaluate_exp_decay(x, found)
    assert np.all((found >= 0.0) & (found < 2e-14))


def test_sine_equals_the_library_to_1e_11():
    x = np.concatenate([np.linspace(0.0, np.pi / 2, 20_001), np.logspace(-12, 0, 1000)])
    found = np.empty_like(x)
    evaluate_sine(x, found)
    np.testing.assert_allclose(found, np.sin(x), rtol=1e-11, atol=0.0)


def test_cosine_equals_the_library_to_1e_11():
    x = np.linspace(0.0, np.pi / 2, 20_001)
    found = np.empty_like(x)
    evaluate_cosine(x, found)
    np.testing.assert_allclose(found, np.cos(x), rtol=0.0, atol=1e-11)


@pytest.mark.parametrize(
    ("is_linear", "law"), [(False, lambda x: np.exp(-x)), (True, lambda x: np.maximum(0.0, 1.0 - x))]
)
@pytest.mark.parametrize("rate", [0.0, 0.35, 50.0])
def test_share_of_the_drop_that_is_left(is_linear, law, rate):
    plastic_strain = np.linspace(0.0, 10.0, 1001)
    found = remaining_shares(plastic_strain, Softening(rate, is_linear))
    np.testing.assert_allclose(found, law(rate * plastic_strain), rtol=0.0, atol=1e-11)


@pytest.mark.parametrize("is_linear", [False, True])
@pytest.mark.parametrize(
    ("plastic_strain", "cohesion", "friction"), [(0.0, 20e3, np.radians(10.0)), (1e6, 10e3, np.radians(5.0))]
)
def test_strength_runs_from_peak_to_residual(is_linear, plastic_strain, cohesion, friction):
    strength = Strength(20e3, np.radians(10.0), 10e3, np.radians(5.0))
    found = softened_strength(plastic_strain, strength, Softening(0.35, is_linear))
    np.testing.assert_allclose(found, [cohesion * np.cos(friction), np.sin(friction)], rtol=1e-11)
