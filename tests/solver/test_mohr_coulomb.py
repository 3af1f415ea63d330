"""Limits of the return mapping; its regions and stress paths are in ``tests/verification``."""

import numpy as np
import pytest
from pointwise import COHESION, principal, random_trials, return_stress, soil_of

from solver.principal import equivalent_plastic_strain


def test_elastic_stress_is_untouched_bit_for_bit():
    """Also where principal stresses nearly coincide: what returns from the principal frame must not be re-assembled."""
    rng = np.random.default_rng(5)
    for spread in (1.0, 1e-4, 1e-8, 1e-12, 1e-15, 0.0):
        trial = spread * rng.normal(0.0, 1e3, (4, 20_000))
        trial[:3] -= rng.uniform(1e4, 1e5, 20_000)
        stress, flow = return_stress(trial, 1e15, np.radians(10.0), soil_of(0.0))
        assert np.all(flow == 0.0)
        np.testing.assert_array_equal(stress, trial)


def test_flow_without_dilation_keeps_the_mean_stress_but_at_the_apex():
    phi = np.radians(20.0)
    trial = random_trials(100_000, seed=6)
    stress, _ = return_stress(trial, COHESION, phi, soil_of(0.0))
    at_apex = np.ptp(principal(stress), axis=1) < 1e-9 * np.abs(trial).max(axis=0)
    drift = np.abs(stress[:3].mean(axis=0) - trial[:3].mean(axis=0))
    assert np.all(drift[~at_apex] <= 1e-12 * np.abs(trial).max(axis=0)[~at_apex])
    apex = COHESION / np.tan(phi)
    assert np.all(trial[:3].mean(axis=0)[at_apex] > apex * (1.0 - 1e-12))
    np.testing.assert_allclose(stress[:3, at_apex], apex, rtol=1e-12)


def test_cohesionless_soil_bears_no_tension():
    trial = random_trials(10_000, seed=7)
    stress, _ = return_stress(trial, 0.0, np.radians(30.0), soil_of(0.0))
    assert np.all(principal(stress)[:, 2] <= 1e-12 * np.abs(trial).max(axis=0))


def test_frictionless_soil_obeys_tresca_at_any_pressure():
    trial = random_trials(100_000, seed=8)
    stress, _ = return_stress(trial, COHESION, 0.0, soil_of(0.0))
    s3, _, s1 = principal(stress).T
    yielded = np.ptp(principal(trial), axis=1) > 2.0 * COHESION
    np.testing.assert_allclose((s1 - s3)[yielded], 2.0 * COHESION, rtol=0.0, atol=1e-10 * np.abs(trial).max())
    drift = np.abs(stress[:3].mean(axis=0) - trial[:3].mean(axis=0))
    assert np.all(drift <= 1e-12 * np.abs(trial).max(axis=0))


def test_plastic_strain_is_that_of_the_relaxed_stress():
    """``sqrt(2/3 e:e)`` with ``e`` the deviator of ``D^-1 (trial - stress)``, on full tensors."""
    trial = random_trials(1000, seed=9)
    soil = soil_of(12.0)
    stress, flow = return_stress(trial, COHESION, np.radians(35.0), soil)
    deviator = trial - stress
    deviator[:3] -= deviator[:3].mean(axis=0)
    strain = deviator / (2.0 * soil.shear_modulus)
    expected = np.sqrt(2.0 / 3.0 * (np.sum(strain[:3] ** 2, axis=0) + 2.0 * strain[3] ** 2))
    np.testing.assert_allclose(flow, expected, rtol=1e-9, atol=1e-16)
    assert equivalent_plastic_strain(3.0, 3.0, 3.0, 1.0) == 0.0


@pytest.mark.parametrize("place", range(6))
def test_nan_is_not_taken_for_strength(place):
    """A trial or a strength that is not a number must spread to the stress, where the march detects it."""
    values = np.array([-100e3, -300e3, -100e3, 80e3, COHESION, 0.2])
    values[place] = np.nan
    stress, flow = return_stress(values[:4, None], values[4], values[5], soil_of(0.0))
    assert np.isnan([*stress, flow]).any()
