"""Stress paths of Mohr-Coulomb soil: closed forms, and the rate equations integrated to round-off.

With the out-of-plane stress in the middle, ``S = (s_xx + s_yy) / 2``, ``R = hypot((s_xx - s_yy) / 2, s_xy)``

    f = 2 (R + S sin(phi) - c cos(phi)),  flow b = dR / dsigma (no dilation),  kappa' = lambda' sqrt(2/3 b : b)
    sigma' = D (eps' - lambda' b),  lambda' = (df/dsigma : D eps') / (df/dsigma : D b - df/dkappa sqrt(2/3 b : b))

The solver returns to the surface with the strength of the increment's start, so its error is of first order.
"""

import numpy as np
import pytest
from driver import Row, observed_orders, orders_row
from pointwise import COHESION, follow, soil_of, strength_of
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from solver.laws.registry import update_stress

PHI, PRESSURE = np.radians(10.0), 100e3  # rad, Pa
RESIDUAL_COHESION, RESIDUAL_PHI = 10e3, np.radians(5.0)
INCREMENTS = (4e-3, 2e-3, 1e-3, 5e-4)
TURNING_STEPS = (50, 100, 200, 400)
LAWS = {"exponential": lambda x: np.exp(-x), "linear": lambda x: 1.0 - x}
RATE = 2.0
STRENGTH = strength_of(COHESION, PHI)
STEADY_SHEAR = COHESION * np.cos(PHI) + PRESSURE * np.sin(PHI)


def compression_strength():
    """Return the axial stress over ``p0 K_p + 2 c sqrt(K_p)`` after compression at constant lateral stress ``p0``."""
    soil = soil_of(0.0)
    K_p = (1.0 + np.sin(PHI)) / (1.0 - np.sin(PHI))
    stress, plastic_strain = (-PRESSURE, -PRESSURE, -PRESSURE, 0.0), 0.0

    def compressed(lateral):
        return update_stress(soil, tuple(stress), (lateral, -1e-4, 0.0), plastic_strain, STRENGTH, 1.0)

    for _ in range(60):
        lateral = brentq(lambda strain: compressed(strain)[0] + PRESSURE, 0.0, 2e-4, xtol=1e-18)
        *stress, plastic_strain = compressed(lateral)
    assert plastic_strain > 1e-3
    return -stress[1] / (PRESSURE * K_p + 2.0 * COHESION * np.sqrt(K_p))


def march(strain_at, steps, soil):
    """Return the history (steps, 5) of hydrostatic soil along ``strain_at`` (t in 0..1), columns xx, yy, xy."""
    strain = np.diff(strain_at(np.linspace(0.0, 1.0, steps + 1)), axis=0)
    history = np.empty((steps, 5))
    follow(np.array([-PRESSURE, -PRESSURE, -PRESSURE, 0.0]), strain, STRENGTH, soil, 1.0, history)
    return history


def sheared(rate, is_linear, increment, end):
    """Return shear stress (Pa) after simple shear up to the engineering strain ``end``."""

    def strain_at(t):
        return np.stack([0.0 * t, 0.0 * t, 0.5 * end * t], axis=1)

    return march(strain_at, round(end / increment), soil_of(0.0, rate, is_linear))[-1, 3]


def exact_shear_stress(law, strain):
    """Solve ``tau = c(e) cos phi(e) + p sin phi(e)``, ``e = (gamma - tau / G) / sqrt(3)`` for ``tau``."""
    G = soil_of(0.0).shear_modulus

    def excess(tau):
        c, phi = strength(law, RATE * (strain - tau / G) / np.sqrt(3.0))
        return tau - c * np.cos(phi) - PRESSURE * np.sin(phi)

    return brentq(excess, 0.0, 100e3, xtol=1e-9)


def strength(law, x):
    """Return cohesion and friction angle at ``x = rate kappa``."""
    left = law(x)
    return RESIDUAL_COHESION + (COHESION - RESIDUAL_COHESION) * left, RESIDUAL_PHI + (PHI - RESIDUAL_PHI) * left


def turning_strain(t):
    """Return a strain path (..., 3) that turns the principal axes all the time and squeezes a little."""
    return np.stack([0.1 * t, -0.10005 * t, 0.1 * (1.0 - np.cos(2.0 * t))], axis=-1)


def elastic_rate(t):
    """Return the stress rate (xx, yy, zz, xy) of ``turning_strain`` without yielding."""
    soil, e = soil_of(0.0), np.array([0.1, -0.10005, 0.0, 0.2 * np.sin(2.0 * t)])
    lame = soil.bulk_modulus - 2.0 * soil.shear_modulus / 3.0
    return 2.0 * soil.shear_modulus * e + lame * e[:3].sum() * np.array([1.0, 1.0, 1.0, 0.0])


def plastic_rate(t, state, rate):
    """Return the rate of (xx, yy, zz, xy, kappa) without dilation, softening exponentially."""
    G, elastic = soil_of(0.0).shear_modulus, elastic_rate(t)
    mean, half, radius = in_plane(state)
    c, phi = strength(LAWS["exponential"], rate * state[4])
    fall_c, fall_phi = rate * (c - RESIDUAL_COHESION), rate * (phi - RESIDUAL_PHI)
    hardening = 2.0 * np.cos(phi) * fall_c - 2.0 * (mean * np.cos(phi) + c * np.sin(phi)) * fall_phi
    flow = np.array([half, -half, 0.0, state[3]]) / radius
    normal = flow + np.sin(phi) * np.array([1.0, 1.0, 0.0, 0.0])
    speed = np.sqrt(2.0 / 3.0 * contract(flow, flow))
    multiplier = contract(normal, elastic) / (2.0 * G * contract(normal, flow) - hardening * speed)
    assert multiplier > 0.0
    return np.append(elastic - 2.0 * G * multiplier * flow, multiplier * speed)


def integrated_path(rate):
    """Return (xx, yy, zz, xy, kappa) at the end of ``turning_strain`` by an eighth-order method."""

    def yield_value(t, state):
        mean, _, radius = in_plane(state)
        return 2.0 * radius + 2.0 * mean * np.sin(PHI) - 2.0 * COHESION * np.cos(PHI)

    yield_value.terminal = True
    accuracy = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-8}
    start = [-PRESSURE, -PRESSURE, -PRESSURE, 0.0, 0.0]
    elastic = solve_ivp(lambda t, _: np.append(elastic_rate(t), 0.0), (0.0, 1.0), start, events=yield_value, **accuracy)
    span, start = (elastic.t_events[0][0], 1.0), elastic.y_events[0][0]
    plastic = solve_ivp(plastic_rate, span, start, args=(rate,), **accuracy)
    mean, _, radius = in_plane(plastic.y)
    assert np.all(np.abs(plastic.y[2] - mean) < radius), "the out-of-plane stress is no longer in the middle"
    return plastic.y[:, -1]


def errors_on_turning_path(rate):
    """Return the largest errors of a stress at the end over the largest stress, for TURNING_STEPS."""
    exact = integrated_path(rate)[:4]
    found = [march(turning_strain, steps, soil_of(0.0, rate))[-1, :4] for steps in TURNING_STEPS]
    return [np.abs(stress - exact).max() / np.abs(exact).max() for stress in found]


def errors_in_simple_shear(is_linear):
    """Return relative errors of the shear stress at an engineering strain of 0.3, for INCREMENTS of it."""
    exact = exact_shear_stress(LAWS["linear" if is_linear else "exponential"], 0.3)
    return [abs(sheared(RATE, is_linear, step, 0.3) / exact - 1.0) for step in INCREMENTS]


def in_plane(state):
    """Return ``S``, half the difference of the in-plane normal stresses, and ``R``."""
    half = 0.5 * (state[0] - state[1])
    return 0.5 * (state[0] + state[1]), half, np.hypot(half, state[3])


def contract(a, b):
    """Return ``a : b`` of symmetric tensors (xx, yy, zz, xy)."""
    return a @ b + a[3] * b[3]


def test_plane_strain_compression_fails_at_the_rankine_stress():
    assert compression_strength() == pytest.approx(1.0, rel=1e-8)


def test_steady_simple_shear_bears_the_mohr_coulomb_strength():
    """``tau = c cos phi + p sin phi`` with the in-plane mean pressure, which does not change."""
    assert sheared(0.0, False, 1e-3, 0.1) == pytest.approx(STEADY_SHEAR, rel=1e-8)


@pytest.mark.parametrize("is_linear", [False, True])
def test_softening_in_simple_shear_lags_by_an_error_of_first_order(is_linear):
    errors = errors_in_simple_shear(is_linear)
    assert errors[2] < 1e-3
    np.testing.assert_allclose(observed_orders(errors), 1.0, atol=0.05)


@pytest.mark.parametrize("rate", [0.0, 2.0, 20.0])
def test_path_with_turning_axes_has_an_error_of_first_order(rate):
    errors = errors_on_turning_path(rate)
    assert errors[-1] < 1e-3
    np.testing.assert_allclose(observed_orders(errors), 1.0, atol=0.05)


def rows():
    compression = compression_strength() - 1.0
    shear = sheared(0.0, False, 1e-3, 0.1) / STEADY_SHEAR - 1.0
    return [
        *(
            Row(name, "closed form within 1e-8", "", f"{abs(error):.0e}", abs(error) < 1e-8)
            for name, error in (("Plane-strain compression", compression), ("Simple shear", shear))
        ),
        *(
            orders_row(name, 1, 0.95, errors, finest)
            for name, errors, finest in (
                ("Simple shear, exponential softening", errors_in_simple_shear(False), "increments of 5e-4"),
                ("Simple shear, linear softening", errors_in_simple_shear(True), "increments of 5e-4"),
                ("Turning principal axes", errors_on_turning_path(0.0), "400 increments"),
                ("Turning principal axes, softening", errors_on_turning_path(20.0), "400 increments"),
            )
        ),
    ]
