"""The return mapping on random trial stresses in every region: yield, order, idempotence, and Koiter's conditions.

The oracle tries all sets of active planes without any thought of regions (``koiter_solutions``); for associated flow
the return is also the projection on the elastic domain in the energy norm, a non-negative least squares fit.
"""

import numpy as np
import pytest
from driver import Row
from pointwise import (
    COHESION,
    koiter_solutions,
    normals,
    principal,
    random_trials,
    return_stress,
    soil_of,
    stiffness,
)
from scipy.optimize import nnls

SOILS = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 20.0), (35.0, 0.0), (35.0, 12.0), (45.0, 45.0)]  # phi, psi in deg
REGIONS = ("elastic", "plane", "upper edge", "lower edge", "apex")


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


def excess_and_change(phi, psi):
    """Return ``f`` after the return, and the change by a second one, over the trial (n,), and the stresses (4, n)."""
    trial, phi, soil = random_trials(100_000, seed=1), np.radians(phi), soil_of(psi)
    stress, _ = return_stress(trial, COHESION, phi, soil)
    again, flow_again = return_stress(stress, COHESION, phi, soil)
    size = np.abs(trial).max(axis=0) + COHESION
    change = np.maximum(np.abs(again - stress).max(axis=0), soil.shear_modulus * flow_again)
    return yield_value(stress, COHESION, phi) / size, change / size, trial, stress


def disorder(trial, stress):
    """Return how far each point (n,) has lost the order or the directions of its principal stresses, over the trial.

    Isotropy: the in-plane deviator shrinks along itself, and ``zz`` keeps its place among the principal stresses.
    """
    size = np.abs(trial).max(axis=0) + COHESION
    before, after = (np.array([0.5 * (s[0] - s[1]), s[3]]) for s in (trial, stress))
    radius_before, radius_after = np.hypot(*before), np.hypot(*after)
    turned = np.abs(before[0] * after[1] - before[1] * after[0]) / np.maximum(radius_before, 1e-300)
    reversed_by = np.maximum(0.0, -np.sum(before * after, axis=0)) / np.maximum(radius_before, 1e-300)
    worst = np.maximum(turned, reversed_by)
    for sign in (1.0, -1.0):
        gap_before, gap_after = (
            0.5 * (s[0] + s[1]) + sign * radius - s[2] for s, radius in ((trial, radius_before), (stress, radius_after))
        )
        worst = np.maximum(worst, np.maximum(0.0, -np.sign(gap_before) * gap_after))
    return worst / size


def distance_to_koiter(phi, psi, n=400):
    """Return the largest difference to Koiter's solution over the trial, and how many trials had only the apex."""
    trial, sin_phi, soil = random_trials(n, seed=3), np.sin(np.radians(phi)), soil_of(psi)
    c_cos_phi = COHESION * np.cos(np.radians(phi))
    stress, _ = return_stress(trial, COHESION, np.radians(phi), soil)
    largest, beyond = 0.0, 0
    for before, found in zip(principal(trial), principal(stress), strict=True):
        if (before[2] - before[0]) + (before[2] + before[0]) * sin_phi <= 2.0 * c_cos_phi:
            continue
        solutions = koiter_solutions(before, c_cos_phi, sin_phi, soil)
        if not solutions:
            assert psi == 0.0
            assert before.mean() > c_cos_phi / sin_phi
            solutions, beyond = [np.full(3, c_cos_phi / sin_phi)], beyond + 1
        distance = max(np.abs(found - np.sort(expected)).max() for expected in solutions)
        largest = max(largest, distance / (np.abs(before).max() + COHESION))
    return largest, beyond


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_returned_stress_is_admissible_and_stays_where_it_is(phi, psi):
    excess, change, _, _ = excess_and_change(phi, psi)
    assert excess.max() <= 1e-12
    assert change.max() <= 1e-12


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_order_and_directions_of_the_principal_stresses_are_kept(phi, psi):
    _, _, trial, stress = excess_and_change(phi, psi)
    assert disorder(trial, stress).max() <= 1e-12


@pytest.mark.parametrize(("phi", "psi"), SOILS)
def test_return_is_the_only_solution_of_koiters_conditions(phi, psi):
    """Where no combination of planes solves them (``psi = 0`` beyond the apex) the stress is the apex."""
    assert distance_to_koiter(phi, psi)[0] < 1e-9


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


def rows():
    worst, counts = np.zeros(4), np.zeros(5, int)
    for phi, psi in SOILS:
        excess, change, trial, stress = excess_and_change(phi, psi)
        found = excess.max(), change.max(), disorder(trial, stress).max(), distance_to_koiter(phi, psi)[0]
        worst = np.maximum(worst, found)
        counts += np.bincount(region_of(trial, stress, COHESION, np.radians(phi)), minlength=5)
    return [
        Row(
            f"Return mapping, {len(SOILS)} soils x 100,000 trials",
            "every region",
            ", ".join(f"{name} {count:,}" for name, count in zip(REGIONS, counts, strict=True)),
            "",
            bool(counts.min() > 500),
        ),
        *(
            Row(f"Return mapping, {name}", f"{target:.0e} of the trial stress", "", f"{found:.0e}", found <= target)
            for name, found, target in zip(
                (
                    "largest f",
                    "largest change by a second return",
                    "order and directions",
                    "against Koiter's conditions (400 trials a soil)",
                ),
                worst,
                (1e-12, 1e-12, 1e-12, 1e-9),
                strict=True,
            )
        ),
    ]
