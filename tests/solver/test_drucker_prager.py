"""The cone of Drucker and Prager: where its return lands, and that plane strain has the strength of Mohr-Coulomb."""

import numpy as np
import pytest
from pointwise import COHESION, drive, follow_law, law_of, random_trials, return_by, strength_of

from solver.laws.drucker_prager import plane_strain_match

SOILS = [(10.0, 0.0), (20.0, 5.0), (30.0, 30.0), (35.0, 12.0)]  # phi, psi in degrees


def invariants(stress):
    """Return mean stress and ``sqrt(J2)`` of stresses (4, n)."""
    p = stress[:3].mean(axis=0)
    return p, np.sqrt(0.5 * np.sum((stress[:3] - p) ** 2, axis=0) + stress[3] ** 2)


def cone(phi, law):
    """Return ``eta`` and ``xi`` of the cone, ``phi`` in rad."""
    ratio = plane_strain_match(np.sin(phi), law.flow_slope)
    return ratio * np.sin(phi), ratio * np.cos(phi)


def test_with_associated_flow_the_match_is_that_of_drucker_and_prager():
    """``eta = 3 tan(phi) / sqrt(9 + 12 tan(phi)^2)``, ``xi = 3 / sqrt(9 + 12 tan(phi)^2)``; flow has the same slope."""
    for degrees in (1.0, 10.0, 35.0, 60.0):
        law, phi = law_of("drucker-prager", degrees), np.radians(degrees)
        root = np.sqrt(9.0 + 12.0 * np.tan(phi) ** 2)
        np.testing.assert_allclose(cone(phi, law), [3.0 * np.tan(phi) / root, 3.0 / root], rtol=1e-14)
        assert law.flow_slope == pytest.approx(3.0 * np.tan(phi) / root, rel=1e-14)


def test_without_dilation_the_match_is_sine_and_cosine():
    phi = np.radians(25.0)
    np.testing.assert_allclose(cone(phi, law_of("drucker-prager", 0.0)), [np.sin(phi), np.cos(phi)], rtol=1e-15)


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_what_yields_returns_to_the_cone_or_its_apex_and_the_rest_is_untouched(phi, psi):
    law, strength = law_of("drucker-prager", psi), strength_of(COHESION, np.radians(phi))
    eta, xi = cone(np.radians(phi), law)
    trial = random_trials(20_000, seed=21)
    stress, flow = return_by(law, trial, strength)
    (p_trial, size_trial), (p, size) = invariants(trial), invariants(stress)
    f_trial, f = size_trial + eta * p_trial - xi * COHESION, size + eta * p - xi * COHESION
    largest = np.abs(trial).max(axis=0) + COHESION
    np.testing.assert_array_equal(stress[:, f_trial < 0.0], trial[:, f_trial < 0.0])
    assert np.all(flow[f_trial < 0.0] == 0.0)
    assert np.all(np.abs(f)[f_trial > 0.0] < 1e-11 * largest[f_trial > 0.0])
    at_apex = size < 1e-9 * largest
    np.testing.assert_allclose(p[at_apex], COHESION / np.tan(np.radians(phi)), rtol=1e-9)
    assert 100 < at_apex.sum() < 15_000
    plastic = np.stack([trial[k] - stress[k] for k in range(4)])[:, ~at_apex & (f_trial > 0.0)]
    ratio = invariants(plastic)[0] / law.bulk_modulus / (invariants(plastic)[1] / law.shear_modulus)
    np.testing.assert_allclose(ratio, law.flow_slope, atol=1e-9)


def test_plastic_strain_is_that_of_the_relaxed_stress():
    """``sqrt(2/3 e:e)`` with ``e`` the deviator of ``D^-1 (trial - stress)``."""
    law = law_of("drucker-prager", 12.0)
    trial = random_trials(1000, seed=22)
    stress, flow = return_by(law, trial, strength_of(COHESION, np.radians(35.0)))
    size = invariants(trial - stress)[1]
    np.testing.assert_allclose(flow, size / (np.sqrt(3.0) * law.shear_modulus), rtol=1e-9, atol=1e-16)


@pytest.mark.parametrize(("phi", "psi"), SOILS)
@pytest.mark.parametrize("direction", [(1.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.6, -0.6, 0.8)])
def test_in_plane_strain_collapse_is_that_of_mohr_coulomb(phi, psi, direction):
    """``R + m sin(phi) = c cos(phi)`` in the plane, and dilation of ``sin(psi)`` times the shear, along any path.

    Shear is imposed, and with it the dilation that collapse asks for, so that the pressure stays bounded.
    """
    law, angle = law_of("drucker-prager", psi), np.radians(phi)
    shear = np.array(direction)
    dilation = np.sin(np.radians(psi)) * np.hypot(shear[0] - shear[1], 2.0 * shear[2])
    increment = 1e-4 * (shear + 0.5 * dilation * np.array([1.0, 1.0, 0.0]))
    start = np.array([-200e3, -200e3, -200e3, 0.0])
    xx, yy, zz, xy, _ = drive(law, start, increment, 4000, strength_of(COHESION, angle))
    mean, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    assert radius + mean * np.sin(angle) == pytest.approx(COHESION * np.cos(angle), rel=1e-9)
    _, size = invariants(np.array([[xx], [yy], [zz], [xy]]))
    assert zz - (xx + yy + zz) / 3.0 == pytest.approx(-2.0 / 3.0 * law.flow_slope * size[0], rel=1e-9, abs=1e-6)


def test_dissipation_is_what_flow_takes_from_the_stress():
    """At collapse ``sigma : d eps_p`` is ``(xi c + (eta_g - eta) p) lambda``, with ``lambda = sqrt(3) d eps_p``."""
    law, angle = law_of("drucker-prager", 5.0), np.radians(20.0)
    eta, xi = cone(angle, law)
    shear = np.array([0.6e-4, -0.6e-4, 0.8e-4])
    dilation = np.sin(np.radians(5.0)) * 2e-4
    strain = np.tile(shear + 0.5 * dilation * np.array([1.0, 1.0, 0.0]), (4000, 1))
    history = follow_law(law, np.array([-200e3, -200e3, -200e3, 0.0]), strain, strength_of(COHESION, angle))
    (xx, yy, zz, xy, before), (*_, after) = history[-1], history[-2]
    work = xx * strain[0, 0] + yy * strain[0, 1] + 2.0 * xy * strain[0, 2]
    p, multiplier = (xx + yy + zz) / 3.0, np.sqrt(3.0) * (before - after)
    assert work == pytest.approx((xi * COHESION + (law.flow_slope - eta) * p) * multiplier, rel=1e-8)
