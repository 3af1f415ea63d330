"""Tresca ground: a prism around the hydrostatic axis, and what Mohr-Coulomb becomes without friction."""

import numpy as np
import pytest
from pointwise import COHESION, drive, follow_law, law_of, principal, random_trials, return_by, strength_of

LAW = law_of("tresca")
FRICTIONLESS = strength_of(COHESION, 0.0)


def test_the_return_is_that_of_mohr_coulomb_without_friction_to_round_off():
    trial = random_trials(100_000, seed=31)
    stress, flow = return_by(LAW, trial, FRICTIONLESS)
    expected, expected_flow = return_by(law_of("mohr-coulomb"), trial, FRICTIONLESS)
    size = np.abs(trial).max(axis=0)
    assert np.all(np.abs(stress - expected) <= 1e-13 * size)
    assert np.all(np.abs(flow - expected_flow) * LAW.shear_modulus <= 1e-13 * size)


def test_what_yields_returns_to_the_prism_and_keeps_its_mean_stress():
    trial = random_trials(100_000, seed=32)
    stress, flow = return_by(LAW, trial, FRICTIONLESS)
    (s3, _, s1), size = principal(stress).T, np.abs(trial).max(axis=0)
    yields = np.ptp(principal(trial), axis=1) > 2.0 * COHESION
    assert 0.1 < yields.mean() < 0.9
    assert np.all(np.abs(s1 - s3 - 2.0 * COHESION)[yields] <= 1e-12 * size[yields])
    np.testing.assert_array_equal(stress[:, ~yields], trial[:, ~yields])
    assert np.all(flow[~yields] == 0.0)
    assert np.all(np.abs(stress[:3].mean(axis=0) - trial[:3].mean(axis=0)) <= 1e-13 * size)


def test_the_return_is_the_nearest_point_of_the_prism():
    """Associated flow is a projection in the energy norm: no admissible stress around the answer lies nearer."""
    rng = np.random.default_rng(33)
    trial = random_trials(200, seed=33)
    stress, _ = return_by(LAW, trial, FRICTIONLESS)
    for p in range(trial.shape[1]):
        nearby = stress[:, [p]] + rng.normal(0.0, 0.1 * COHESION, (4, 500))
        admissible, _ = return_by(LAW, nearby, FRICTIONLESS)
        assert np.all(
            energy(trial[:, [p]] - admissible) >= energy(trial[:, [p]] - stress[:, [p]]) * (1.0 - 1e-9) - 1e-12
        )


def energy(stress):
    """Return ``s : D^-1 : s`` in Pa, of stresses (4, n)."""
    p = stress[:3].mean(axis=0)
    deviator = np.sum((stress[:3] - p) ** 2, axis=0) + 2.0 * stress[3] ** 2
    return deviator / (2.0 * LAW.shear_modulus) + p**2 / LAW.bulk_modulus


def test_a_friction_angle_is_not_read():
    trial = random_trials(1000, seed=34)
    np.testing.assert_array_equal(
        return_by(LAW, trial, strength_of(COHESION, 0.5))[0], return_by(LAW, trial, FRICTIONLESS)[0]
    )


@pytest.mark.parametrize("direction", [(1.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.6, -0.6, 0.8)])
def test_undrained_shear_bears_its_strength_and_dissipates_it(direction):
    """The radius of Mohr's circle is ``s_u``, the work ``2 s_u`` a unit of ``e1``, and ``d eps_p = 2 e1 / sqrt(3)``."""
    increment = 1e-4 * np.array(direction)
    largest = np.hypot(increment[0], increment[2])
    xx, yy, _, xy, _ = drive(LAW, np.array([-50e3, -120e3, -80e3, 0.0]), increment, 1000, FRICTIONLESS)
    assert np.hypot(0.5 * (xx - yy), xy) == pytest.approx(COHESION, rel=1e-9)
    work = xx * increment[0] + yy * increment[1] + 2.0 * xy * increment[2]
    assert work == pytest.approx(2.0 * COHESION * largest, rel=1e-9)
    history = follow_law(LAW, np.array([-50e3, -120e3, -80e3, 0.0]), np.tile(increment, (1000, 1)), FRICTIONLESS)
    assert history[-1, 4] - history[-2, 4] == pytest.approx(2.0 / np.sqrt(3.0) * largest, rel=1e-9)


def test_strength_softens_to_the_residual_one():
    law = law_of("tresca", rate=50.0)
    xx, yy, _, xy, _ = drive(law, np.array([-50e3, -50e3, -50e3, 0.0]), np.array([0.0, 0.0, 1e-3]), 2000, FRICTIONLESS)
    assert np.hypot(0.5 * (xx - yy), xy) == pytest.approx(FRICTIONLESS.cohesion_residual, rel=1e-9)
