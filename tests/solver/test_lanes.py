"""Lanes are floats, eight at once: the same lines give the same numbers."""

import math

import numpy as np
import pytest
from pointwise import law_of

from solver._jit import inlined, kernel
from solver.constants import LANE_COUNT
from solver.lanes import (
    anywhere,
    bits,
    lane_numbers,
    load,
    spill_1,
    spill_2,
    splat,
    store,
    total,
    up_1,
    up_2,
    where,
)
from solver.laws.registry import law_names, update_stress
from solver.softening import Strength


@inlined
def every_operation(a, b):
    """Return something that all operations and both branches have a part in."""
    value = math.sqrt(max(a * a + 1, b)) / 3 - (-min(a, 0.2))
    value *= 2
    value -= abs(b)
    is_odd = (a > b) & (b <= 1.0) | (a < -0.5) | (a == b)
    if anywhere(is_odd):
        value = where(is_odd, 1.0 / (2.0 + abs(b)), value)
    return value


@kernel
def on_lanes(a, b, result):
    for k in range(0, a.size, LANE_COUNT):
        store(result, k, every_operation(load(a, k), load(b, k)))


@kernel
def on_floats(a, b, result):
    for k in range(a.size):
        result[k] = every_operation(a[k], b[k])


def test_a_function_of_floats_is_one_of_lanes():
    a, b = np.random.default_rng(1).normal(size=(2, 800))
    b[3] = a[3]
    vector, scalar = np.empty(800), np.empty(800)
    on_lanes(a, b, vector)
    on_floats(a, b, scalar)
    np.testing.assert_array_equal(vector, scalar)
    np.testing.assert_allclose(vector, [every_operation(*pair) for pair in zip(a, b, strict=True)], atol=1e-14)


@kernel
def moved(a, up, spilled):
    store(up, 0, up_1(load(a, 0)))
    store(spilled, 0, spill_1(load(a, 0)))
    store(up, LANE_COUNT, up_2(load(a, 0)))
    store(spilled, LANE_COUNT, spill_2(load(a, 0)))


def test_lanes_move_up_and_spill_over():
    a, up, spilled = np.arange(1.0, 9.0), np.empty((2, 8)), np.empty((2, 8))
    moved(a, up, spilled)
    for k in (1, 2):
        np.testing.assert_array_equal(np.concatenate([up[k - 1], spilled[k - 1]])[k : k + 8], a)
        assert up[k - 1].sum() + spilled[k - 1].sum() == a.sum()


@kernel
def sum_and_bits(a):
    return total(load(a, 0) + splat(1.0) * lane_numbers()), bits(load(a, 0) > 0.0)


def test_a_sum_over_lanes_and_a_mask_as_bits():
    assert sum_and_bits(np.array([1.0, -1.0, 2.0, 0.0, np.nan, 1.0, -3.0, 4.0]))[1] == 0b10100101
    assert sum_and_bits(np.arange(8.0))[0] == 56.0


@kernel
def largest_and_least(a, b, result):
    store(result, 0, max(load(a, 0), load(b, 0)))
    store(result, LANE_COUNT, min(load(a, 0), load(b, 0)))


def test_a_first_argument_that_is_not_a_number_stays():
    """So a bad stress does not become a good one on its way through ``max(f, 0)``."""
    a, b, result = np.full(8, np.nan), np.zeros(8), np.empty((2, 8))
    largest_and_least(a, b, result)
    assert np.isnan(result).all()


@kernel
def update_lanes(law, stress, strain, kappa, c, phi, result):
    for k in range(0, kappa.size, LANE_COUNT):
        n = kappa.size
        trial = load(stress, k), load(stress, n + k), load(stress, 2 * n + k), load(stress, 3 * n + k)
        increment = load(strain, k), load(strain, n + k), load(strain, 2 * n + k)
        strength = Strength(load(c, k), load(phi, k), 0.5 * load(c, k), 0.5 * load(phi, k))
        new = update_stress(law, trial, increment, load(kappa, k), strength, 1.0)
        store(result, k, new[0])
        store(result, n + k, new[1])
        store(result, 2 * n + k, new[2])
        store(result, 3 * n + k, new[3])
        store(result, 4 * n + k, new[4])


@kernel
def update_floats(law, stress, strain, kappa, c, phi, result):
    for p in range(kappa.size):
        strength = Strength(c[p], phi[p], 0.5 * c[p], 0.5 * phi[p])
        trial = stress[0, p], stress[1, p], stress[2, p], stress[3, p]
        increment = strain[0, p], strain[1, p], strain[2, p]
        result[0, p], result[1, p], result[2, p], result[3, p], result[4, p] = update_stress(
            law, trial, increment, kappa[p], strength, 1.0
        )


@pytest.mark.parametrize("name", law_names())
@pytest.mark.parametrize("psi", [0.0, 8.0])
def test_a_law_of_lanes_is_the_law_of_a_point(name, psi):
    """On the plane, the edges, the apex and inside, to round-off; stresses of 40 kPa, strength of 10 kPa."""
    rng, n = np.random.default_rng(7), 4000
    stress, strain = rng.normal(0.0, 4e4, (4, n)), rng.normal(0.0, 1e-3, (3, n))
    kappa, c, phi = rng.uniform(0.0, 1.0, n), rng.uniform(0.0, 2e4, n), rng.uniform(0.0, 0.7, n)
    vector, scalar = np.empty((5, n)), np.empty((5, n))
    arguments = law_of(name, psi=psi, rate=2.0), stress, strain, kappa, c, phi
    update_lanes(*arguments, vector)
    update_floats(*arguments, scalar)
    for found, expected in zip(vector, scalar, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())
    assert 0.5 < np.mean(scalar[4] > kappa) < 1.0
