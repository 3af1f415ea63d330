"""The return mapping against Koiter's conditions, an energy projection, and closed forms of stress paths."""

import numpy as np
import pytest
from pointwise import follow, koiter_solutions, normals, principal, return_stress, stiffness
from scipy.optimize import brentq, nnls

from solver.model import make_soil
from solver.mohr_coulomb import equivalent_plastic_strain, mohr_coulomb, update_stress

E, NU = 70e6, 0.35
COHESION = 20e3  # Pa
SOILS = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 20.0), (35.0, 0.0), (35.0, 12.0), (45.0, 45.0)]  # phi, psi in deg
REGIONS = ("elastic", "plane", "upper edge", "lower edge", "apex")


def soil_of(psi, rate=0.0, is_linear=False):
    return make_soil(E, NU, np.radians(psi), 10e3, np.radians(5.0), rate, is_linear)


def random_trials(n, seed, cohesion=COHESION, mean=2.0, deviator=3.0):
    """Return stresses (4, n) in Pa of many magnitudes, over all orders of the principal stresses."""
    rng = np.random.default_rng(seed)
    scale = cohesion * 10.0 ** rng.uniform(-1.0, 1.5, n)
    isotropic = mean * rng.normal(size=n) * np.array([1.0, 1.0, 1.0, 0.0])[:, None]
    return scale * (isotropic + deviator * rng.uniform(0.0, 1.0, n) * rng.normal(size=(4, n)))


def yield_value(stress, cohesion, phi):
    s3, _, s1 = principal(stress).T
    return (s1 - s3) + (s1 + s3) * np.sin(phi) - 2.0 * cohesion * np.cos(phi)


def region_of(trial, stress, cohesion, phi):
    """Return the index in REGIONS of each point, told from the principal stresses after the return."""
    s3, s2, s1 = principal(stress).T
    size = np.abs(trial).max(axis=0)
    upper, lower = s1 - s2 < 1e-9 * size, s2 - s3 < 1e-9 * size
    region = np.where(upper & lower, 4, np.where(upper, 2, np.where(lower, 3, 1)))
    return np.where(yield_value(trial, cohesion, phi) <= 0.0, 0, region)


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_returned_stress_is_admissible_and_stays_where_it_is(phi, psi):
    trial, phi = random_trials(100_000, seed=1), np.radians(phi)
    soil = soil_of(psi)
    stress, _ = return_stress(trial, COHESION, phi, soil)
    again, flow_again = return_stress(stress, COHESION, phi, soil)
    size = np.abs(trial).max(axis=0) + COHESION
    assert np.all(yield_value(stress, COHESION, phi) <= 1e-12 * size)
    assert np.all(np.abs(again - stress) <= 1e-12 * size)
    assert np.all(flow_again <= 1e-12 * size / soil.shear_modulus)


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_order_and_directions_of_the_principal_stresses_are_kept(phi, psi):
    """Isotropy: the in-plane deviator shrinks along itself, and ``zz`` keeps its place among the principal stresses."""
    trial = random_trials(100_000, seed=2)
    stress, _ = return_stress(trial, COHESION, np.radians(phi), soil_of(psi))
    tolerance = 1e-12 * (np.abs(trial).max(axis=0) + COHESION)
    before, after = (np.array([0.5 * (s[0] - s[1]), s[3]]) for s in (trial, stress))
    size = np.hypot(*before)
    assert np.all(np.abs(before[0] * after[1] - before[1] * after[0]) <= tolerance * size)
    assert np.all(np.sum(before * after, axis=0) >= -tolerance * size)
    for s in (trial, stress):
        s[:2] = 0.5 * (s[0] + s[1]) + np.hypot(0.5 * (s[0] - s[1]), s[3]) * np.array([[1.0], [-1.0]])
    for low, high in ((1, 2), (2, 0)):
        was_ordered = trial[low] <= trial[high]
        difference = np.where(was_ordered, stress[high] - stress[low], stress[low] - stress[high])
        assert np.all(difference >= -tolerance)


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_return_is_the_only_solution_of_koiters_conditions(phi, psi):
    """Where no combination of planes solves them (``psi = 0`` beyond the apex) the stress is the apex."""
    trial, sin_phi = random_trials(400, seed=3), np.sin(np.radians(phi))
    soil = soil_of(psi)
    stress, _ = return_stress(trial, COHESION, np.radians(phi), soil)
    c_cos_phi = COHESION * np.cos(np.radians(phi))
    for before, found in zip(principal(trial), principal(stress), strict=True):
        if (before[2] - before[0]) + (before[2] + before[0]) * sin_phi <= 2.0 * c_cos_phi:
            continue
        solutions = koiter_solutions(before, c_cos_phi, sin_phi, soil)
        if not solutions:
            assert psi == 0.0
            assert before.mean() > c_cos_phi / sin_phi
            solutions = [np.full(3, c_cos_phi / sin_phi)]
        size = np.abs(before).max() + COHESION
        for expected in solutions:
            np.testing.assert_allclose(found, np.sort(expected), rtol=0.0, atol=1e-9 * size)


@pytest.mark.parametrize("phi", [20.0, 45.0])
def test_associated_return_is_the_closest_point_in_the_energy_norm(phi):
    """Moreau: the projection on a cone is the point less its projection on the polar cone, a non-negative fit."""
    trial, phi = random_trials(500, seed=4), np.radians(phi)
    soil = soil_of(np.degrees(phi))
    stress, _ = return_stress(trial, COHESION, phi, soil)
    apex = COHESION / np.tan(phi)
    root = np.linalg.cholesky(stiffness(soil))  # sigma = root z: the energy norm of sigma is the Euclidean one of z
    generators = (normals(np.sin(phi)) @ root).T
    for before, found in zip(principal(trial), principal(stress), strict=True):
        z = np.linalg.solve(root, before - apex)
        expected = root @ (z - generators @ nnls(generators, z)[0]) + apex
        np.testing.assert_allclose(found, np.sort(expected), rtol=0.0, atol=1e-9 * (np.abs(before).max() + apex))


@pytest.mark.parametrize(("phi", "psi"), [soil for soil in SOILS if soil[0] > 0.0])
def test_random_trials_reach_every_region(phi, psi):
    trial, phi = random_trials(100_000, seed=1), np.radians(phi)
    stress, _ = return_stress(trial, COHESION, phi, soil_of(psi))
    count = np.bincount(region_of(trial, stress, COHESION, phi), minlength=5)
    assert dict(zip(REGIONS, count, strict=True)).keys() == set(REGIONS)
    assert count.min() > 500


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
    at_apex = region_of(trial, stress, COHESION, phi) == 4
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


def test_plane_strain_compression_fails_at_the_rankine_stress():
    """``sigma_1f = p0 K_p + 2 c sqrt(K_p)``, ``K_p = (1 + sin phi) / (1 - sin phi)``, at constant lateral stress."""
    p0, phi, soil = 100e3, np.radians(10.0), soil_of(0.0)
    K_p = (1.0 + np.sin(phi)) / (1.0 - np.sin(phi))
    stress, plastic_strain = (-p0, -p0, -p0, 0.0), 0.0

    def compressed(lateral):
        return update_stress(*stress, lateral, -1e-4, 0.0, plastic_strain, COHESION, phi, soil)

    for _ in range(60):
        lateral = brentq(lambda strain: compressed(strain)[0] + p0, 0.0, 2e-4, xtol=1e-18)
        *stress, plastic_strain = compressed(lateral)
    assert plastic_strain > 1e-3
    assert -stress[1] == pytest.approx(p0 * K_p + 2.0 * COHESION * np.sqrt(K_p), rel=1e-8)


def sheared(rate, is_linear, increment, end, pressure=100e3):
    """Return shear stress (Pa) after simple shear of a hydrostatic state up to the engineering strain ``end``."""
    steps = round(end / increment)
    strain = np.zeros((steps, 3))
    strain[:, 2] = 0.5 * increment
    history = np.empty((steps, 5))
    start = np.array([-pressure, -pressure, -pressure, 0.0])
    follow(start, strain, COHESION, np.radians(10.0), soil_of(0.0, rate, is_linear), history)
    return history[-1, 3]


def exact_shear_stress(law, strain, pressure=100e3):
    """Solve ``tau = c(e) cos phi(e) + p sin phi(e)``, ``e = (gamma - tau / G) / sqrt(3)`` for ``tau``."""
    G = soil_of(0.0).shear_modulus

    def excess(tau):
        left = law((strain - tau / G) / np.sqrt(3.0))
        c, phi = 10e3 + 10e3 * left, np.radians(5.0 + 5.0 * left)
        return tau - c * np.cos(phi) - pressure * np.sin(phi)

    return brentq(excess, 0.0, 100e3, xtol=1e-9)


def test_steady_simple_shear_bears_the_mohr_coulomb_strength():
    """``tau = c cos phi + p sin phi`` with the in-plane mean pressure, which does not change."""
    phi = np.radians(10.0)
    assert sheared(0.0, False, 1e-3, 0.1) == pytest.approx(COHESION * np.cos(phi) + 100e3 * np.sin(phi), rel=1e-8)


@pytest.mark.parametrize(("is_linear", "law"), [(False, lambda e: np.exp(-2.0 * e)), (True, lambda e: 1.0 - 2.0 * e)])
def test_softening_in_simple_shear_lags_by_an_error_of_first_order(is_linear, law):
    exact = exact_shear_stress(law, 0.3)
    errors = [abs(sheared(2.0, is_linear, increment, 0.3) / exact - 1.0) for increment in (4e-3, 2e-3, 1e-3, 5e-4)]
    assert errors[2] < 1e-3
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 1.0, atol=0.05)


@pytest.mark.parametrize("place", range(6))
def test_nan_is_not_taken_for_strength(place):
    """A trial or a strength that is not a number must spread to the stress, where the march detects it."""
    values = [-100e3, -300e3, -100e3, 80e3, COHESION, 0.2]
    values[place] = np.nan
    assert np.isnan(mohr_coulomb(*values, soil_of(0.0))).any()
