"""Mohr-Coulomb ground with a cut-off of tension: the return on random trials in every region, and what cracks.

Two oracles without any thought of regions. For associated flow the return is the nearest point, in the energy norm, of
the polyhedron of all nine planes, a least-distance problem (Lawson and Hanson 1974, ch. 23). For any flow it solves
Koiter's conditions, ``s = trial - D sum_k lambda_k b_k``, ``lambda_k >= 0``, ``f_k(s) <= 0``, ``lambda_k f_k(s) = 0``:
all sets of up to three of the nine planes are tried.
"""

import itertools

import numpy as np
import pytest
from driver import Row
from pointwise import COHESION, drive, law_of, normals, principal, random_trials, return_by, stiffness, strength_of
from scipy.optimize import nnls

from solver._jit import kernel
from solver.constants import LANE_COUNT
from solver.lanes import load, store
from solver.laws.registry import update_stress

TENSION = "mohr-coulomb-tension"
SOILS = [
    (10.0, 0.0, 0.0),
    (10.0, 5.0, 0.3),
    (25.0, 0.0, 0.5),
    (35.0, 12.0, 0.9),
    (35.0, 0.0, 0.0),
    (20.0, 20.0, 0.0),
    (45.0, 45.0, 0.6),
]
"""phi and psi in deg, and the cut-off over ``c cot(phi)``."""
ASSOCIATED = [soil for soil in SOILS if soil[0] == soil[1]]
REGIONS = ("elastic", "Mohr-Coulomb", "plane", "edge", "apex", "both", "both at s1 = s2", "both at s2 = s3")


def soil_of(phi, psi, share):
    """Return law, strength and cut-off (Pa)."""
    cutoff = share * COHESION / np.tan(np.radians(phi))
    return law_of(TENSION, psi, tension_cutoff=cutoff), strength_of(COHESION, np.radians(phi)), cutoff


def planes_of(phi, cutoff):
    """Return gradients (9, 3) and right-hand sides (9,) of all planes, ``gradients @ s <= rhs``."""
    mohr_coulomb = np.full(6, 2.0 * COHESION * np.cos(np.radians(phi)))
    return np.vstack([normals(np.sin(np.radians(phi))), np.eye(3)]), np.append(mohr_coulomb, np.full(3, cutoff))


def returned(soil, n, seed):
    """Return principal stresses (n, 3), smallest first, before and after the return, and the plastic strain (n,)."""
    law, strength, _ = soil_of(*soil)
    trial = random_trials(n, seed)
    stress, flow = return_by(law, trial, strength)
    return principal(trial), principal(stress), flow


def largest_excess(soil, n=20_000):
    """Return the largest ``f`` after the return over the trial stress, of any plane."""
    gradients, rhs = planes_of(soil[0], soil_of(*soil)[2])
    before, after, _ = returned(soil, n, 1)
    return ((after @ gradients.T - rhs).max(axis=1) / (np.abs(before).max(axis=1) + COHESION)).max()


def least_work(soil, n=20_000):
    """Return the least plastic work ``s : D^-1 (trial - s)`` over ``trial : D^-1 : trial``."""
    law, _, _ = soil_of(*soil)
    before, after, _ = returned(soil, n, 2)
    compliance = np.linalg.inv(stiffness(law))
    work = np.einsum("ni,ij,nj->n", after, compliance, before - after)
    return (work / np.einsum("ni,ij,nj->n", before, compliance, before)).min()


def distance_to_koiter(soil, n=3000):
    """Return for each yielding trial (k,) the difference to the nearest solution over the trial, inf without one."""
    law, _, cutoff = soil_of(*soil)
    gradients, rhs = planes_of(soil[0], cutoff)
    flows = np.vstack([normals(law.sin_dilation), np.eye(3)]) @ stiffness(law)
    before, after, _ = returned(soil, n, 3)
    size = np.abs(before).max(axis=1) + COHESION
    excess = before @ gradients.T - rhs
    nearest = np.where(excess.max(axis=1) <= 0.0, np.nan, np.inf)
    for count in (1, 2, 3):
        for active in map(list, itertools.combinations(range(9), count)):
            matrix = gradients[active] @ flows[active].T
            if np.linalg.cond(matrix) > 1e10:
                continue
            multipliers = np.linalg.solve(matrix, excess[:, active].T).T
            stress = before - multipliers @ flows[active]
            admissible = (stress @ gradients.T - rhs).max(axis=1) <= 1e-9 * size
            solves = admissible & (multipliers >= -1e-12).all(axis=1)
            distance = np.abs(np.sort(stress, axis=1) - after).max(axis=1) / size
            nearest[solves] = np.minimum(nearest, distance)[solves]
    return nearest[~np.isnan(nearest)]


def distance_to_projection(soil, n=3000):
    """Return the largest difference to the nearest point of the polyhedron over the trial, for associated flow."""
    law, _, cutoff = soil_of(*soil)
    gradients, rhs = planes_of(soil[0], cutoff)
    root = np.linalg.cholesky(stiffness(law))  # s = root z: the energy norm of s is the Euclidean one of z
    before, after, _ = returned(soil, n, 4)
    largest = 0.0
    for trial, found in zip(before, after, strict=True):
        size = np.abs(trial).max() + COHESION
        matrix = np.vstack([-(gradients @ root).T, (gradients @ trial - rhs)[None] / size])
        multipliers, gap = nnls(matrix, np.append(np.zeros(3), 1.0))
        residual = matrix @ multipliers - np.append(np.zeros(3), 1.0)
        nearest = trial if gap < 1e-12 else trial - root @ residual[:3] / residual[3] * size
        largest = max(largest, np.abs(np.sort(nearest) - found).max() / size)
    return largest


def counts(soil, n=20_000):
    """Return how many trials come to each of ``REGIONS``."""
    _, _, cutoff = soil_of(*soil)
    before, after, flow = returned(soil, n, 1)
    s3, s2, s1 = after.T
    gradients, rhs = planes_of(soil[0], cutoff)
    tolerance = 1e-9 * (np.abs(before).max(axis=1) + COHESION)
    on_mohr_coulomb = np.abs((after @ gradients[:6].T - rhs[:6]).max(axis=1)) < tolerance
    is_cut = np.abs(s1 - cutoff) < tolerance
    upper, lower = s1 - s2 < tolerance, s2 - s3 < tolerance
    alone = np.select([upper & lower, upper], [4, 3], 2)
    both = np.select([upper, lower], [6, 7], 5)
    region = np.where(is_cut, np.where(on_mohr_coulomb & ~(upper & lower), both, alone), 1)
    return np.bincount(np.where(flow == 0.0, 0, region), minlength=len(REGIONS))


@pytest.mark.parametrize("soil", SOILS)
def test_returned_stress_is_within_all_planes_and_dissipates(soil):
    assert largest_excess(soil) <= 1e-12
    assert least_work(soil) >= -1e-12


@pytest.mark.parametrize("soil", SOILS)
def test_the_return_solves_koiters_conditions(soil):
    assert distance_to_koiter(soil).max() < 1e-9


@pytest.mark.parametrize("soil", ASSOCIATED)
def test_associated_return_is_the_nearest_point(soil):
    assert distance_to_projection(soil) < 1e-8


def test_random_trials_reach_every_region():
    assert np.min([counts(soil) for soil in SOILS]) > 10


@pytest.mark.parametrize(("phi", "psi"), [(0.0, 0.0), (10.0, 0.0), (35.0, 12.0)])
def test_a_cutoff_beyond_the_apex_is_mohr_coulomb_bit_for_bit(phi, psi):
    strength, trial = strength_of(COHESION, np.radians(phi)), random_trials(50_000, seed=5)
    beyond = law_of(TENSION, psi, tension_cutoff=1.001 * COHESION / np.tan(np.radians(max(phi, 1.0))))
    expected = return_by(law_of("mohr-coulomb", psi), trial, strength)
    for law in (beyond, law_of(TENSION, psi)) if phi else (law_of(TENSION, psi),):
        for found, other in zip(return_by(law, trial, strength), expected, strict=True):
            np.testing.assert_array_equal(found, other)


@pytest.mark.parametrize("cutoff", [0.0, 3e3])
def test_ground_that_is_stretched_bears_the_cutoff(cutoff):
    """``s_xx = T`` and, as only that direction opens, ``s_yy = s_zz = nu / (1 - nu) T``."""
    law = law_of(TENSION, tension_cutoff=cutoff)
    xx, yy, zz, xy, opened = drive(law, np.zeros(4), np.array([1e-5, 0.0, 0.0]), 50, strength_of(COHESION, 0.2))
    np.testing.assert_allclose([xx, yy, zz, xy], cutoff * np.array([1.0, 0.35 / 0.65, 0.35 / 0.65, 0.0]), atol=1e-9)
    elastic = cutoff / (law.bulk_modulus + 4.0 * law.shear_modulus / 3.0)
    assert opened == pytest.approx(2.0 / 3.0 * (5e-4 - elastic), rel=1e-9)


def test_softening_takes_as_much_of_the_cutoff_as_of_cohesion():
    """From 20 to 10 kPa of cohesion, and so from 3 to 1.5 kPa of tension."""
    law = law_of(TENSION, rate=50.0, tension_cutoff=3e3)
    stretched = drive(law, np.zeros(4), np.array([1e-3, 0.0, 0.0]), 1000, strength_of(COHESION, 0.2))
    assert stretched[0] == pytest.approx(1.5e3, rel=1e-9)


def test_ground_that_shears_under_pressure_does_not_know_of_the_cutoff():
    strength, start = strength_of(COHESION, np.radians(10.0)), np.array([-100e3, -100e3, -100e3, 0.0])
    found, expected = (
        drive(law, start, np.array([0.0, 0.0, 1e-3]), 100, strength)
        for law in (law_of(TENSION, rate=2.0, tension_cutoff=0.0), law_of("mohr-coulomb", rate=2.0))
    )
    np.testing.assert_allclose(found, expected, rtol=1e-13)


@kernel
def update_eight_at_once(law, stress, strength, result):
    for p in range(0, stress.shape[1], LANE_COUNT):
        n = stress.shape[1]
        trial = load(stress, p), load(stress, n + p), load(stress, 2 * n + p), load(stress, 3 * n + p)
        found = update_stress(law, trial, (0.0, 0.0, 0.0), load(result, 4 * n + p), strength, 1.0)
        store(result, p, found[0])
        store(result, n + p, found[1])
        store(result, 2 * n + p, found[2])
        store(result, 3 * n + p, found[3])
        store(result, 4 * n + p, found[4])


def test_eight_lanes_are_eight_points():
    law, strength, _ = soil_of(25.0, 5.0, 0.3)
    trial = random_trials(8 * 500, seed=6)
    result = np.zeros((5, trial.shape[1]))
    update_eight_at_once(law, trial, strength, result)
    stress, flow = return_by(law, trial, strength)
    np.testing.assert_allclose(result[:4], stress, rtol=0.0, atol=1e-12 * np.abs(trial).max())
    np.testing.assert_allclose(result[4], flow, rtol=1e-12, atol=1e-16)


def rows():
    found = np.sum([counts(soil) for soil in SOILS], axis=0)
    koiter = max(distance_to_koiter(soil).max() for soil in SOILS)
    projection = max(distance_to_projection(soil) for soil in ASSOCIATED)
    excess = max(largest_excess(soil) for soil in SOILS)
    return [
        Row(
            f"Tension cut-off, {len(SOILS)} soils x 20,000 trials",
            "every region",
            ", ".join(f"{name} {count:,}" for name, count in zip(REGIONS, found, strict=True)),
            "",
            bool(found.min() > 100),
        ),
        Row("Tension cut-off, largest f", "1e-12 of the trial stress", "", f"{excess:.0e}", excess <= 1e-12),
        Row(
            "Tension cut-off, against Koiter's conditions",
            "1e-09 of the trial stress",
            "",
            f"{koiter:.0e}",
            koiter < 1e-9,
        ),
        Row("Tension cut-off, nearest point", "1e-08 of the trial stress", "", f"{projection:.0e}", projection < 1e-8),
    ]
