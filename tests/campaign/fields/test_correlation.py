"""Autocorrelation formulas against their definitions."""

from math import cos, exp, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import gamma, kv

from campaign.fields.correlation import KERNELS, Correlation, autocorrelation_distance

lags = st.floats(-100.0, 100.0)
angles = st.floats(-3.0, 3.0)


@pytest.mark.parametrize("kind", KERNELS)
def test_autocorrelation_distance_is_where_the_correlation_is_1_over_e(kind):
    correlation = Correlation(kind, 20.0, 2.0)
    assert correlation(0.0, 0.0) == 1.0
    assert correlation(20.0, 0.0) == pytest.approx(exp(-1.0), rel=1e-15)
    assert correlation(0.0, 2.0) == pytest.approx(exp(-1.0), rel=1e-15)


def test_printed_formula_of_ma_2023():
    """Eq. (1) with one distance per axis: exp(-sqrt((dx/20)^2 + (dy/2)^2))."""
    assert Correlation("exponential", 20.0, 2.0)(30.0, 4.0) == pytest.approx(exp(-sqrt(1.5**2 + 2.0**2)), rel=1e-15)
    assert Correlation("separable-exponential", 20.0, 2.0)(30.0, -4.0) == pytest.approx(exp(-1.5 - 2.0), rel=1e-15)
    assert Correlation("squared-exponential", 20.0, 2.0)(30.0, 4.0) == pytest.approx(exp(-(1.5**2) - 4.0), rel=1e-15)


@pytest.mark.parametrize("kind", KERNELS)
def test_scale_of_fluctuation_is_the_integral_of_the_correlation(kind):
    """Theta is the integral over the whole line, by quadrature, along either axis; Vanmarcke (1983)."""
    theta = 3.0
    distance = autocorrelation_distance(theta, kind)
    correlation = Correlation(kind, distance, distance)
    for direction in ((1.0, 0.0), (0.0, 1.0)):
        half, _ = quad(lambda s, d=direction: float(correlation(s * d[0], s * d[1])), 0.0, np.inf, epsabs=1e-12)
        assert 2.0 * half == pytest.approx(theta, rel=1e-9)


@pytest.mark.parametrize("kind", KERNELS)
@given(s=lags, angle=angles)
def test_fabric_turns_counter_clockwise(kind, s, angle):
    """A step along the inclined fabric is correlated like a horizontal step in level fabric; across it, vertical."""
    level, inclined = Correlation(kind, 20.0, 2.0), Correlation(kind, 20.0, 2.0, angle)
    assert inclined(s * cos(angle), s * sin(angle)) == pytest.approx(level(s, 0.0), rel=1e-9, abs=1e-15)
    assert inclined(-s * sin(angle), s * cos(angle)) == pytest.approx(level(0.0, s), rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("kind", KERNELS)
@given(dx=lags, dy=lags, angle=angles)
def test_correlation_is_even_and_at_most_one(kind, dx, dy, angle):
    correlation = Correlation(kind, 20.0, 2.0, angle)
    assert correlation(dx, dy) == correlation(-dx, -dy)
    assert (-0.07 if kind == "cosine-exponential" else 0.0) <= correlation(dx, dy) <= 1.0


@pytest.mark.parametrize("kind", KERNELS)
def test_no_wave_has_a_negative_variance_in_the_plane(kind):
    """The transform of the correlation over the plane, by a lattice of 64 distances with 8 points in each.

    On such a lattice the transform is a sum of the true one over all aliases, and none of these is negative.
    """
    x = np.fft.fftfreq(512, 1.0 / 64.0)
    density = np.fft.fft2(Correlation(kind, 1.0, 1.0)(x, x[:, None])).real
    assert density.min() > -1e-13 * density.max()


def test_a_wave_shorter_than_its_decay_would_have_a_negative_variance():
    """exp(-t) cos(b t) is positive definite in the plane up to b = 1, and no longer at b = 1.1 (Yaglom 1987)."""
    x = np.fft.fftfreq(512, 1.0 / 64.0)
    t = np.hypot(x, x[:, None])
    density = np.fft.fft2(np.exp(-t) * np.cos(1.1 * t)).real
    assert density.min() < -1e-3 * density.max()


def test_formulas_of_smooth_and_bedded_soil():
    """Against the general Matérn formula with the Bessel function K, and the sphere's overlap at half its diameter."""
    r = np.array([0.1, 0.7, 2.0])
    for kind, order in (("matern-3/2", 1.5), ("matern-5/2", 2.5)):
        a = brentq(lambda a, nu=order: matern(nu, a) - exp(-1.0), 1.0, 5.0, xtol=1e-14)
        np.testing.assert_allclose(Correlation(kind, 1.0, 1.0)(r, 0.0), matern(order, a * r), rtol=1e-12)
    radius = brentq(lambda d: 1.0 - 1.5 / d + 0.5 / d**3 - exp(-1.0), 1.1, 10.0, xtol=1e-14)
    assert Correlation("spherical", 1.0, 1.0)(radius / 2.0, 0.0) == pytest.approx(0.3125)
    assert Correlation("spherical", 1.0, 1.0)(1.0001 * radius, 0.0) == 0.0
    quarter = brentq(lambda t: exp(-t) * cos(t) - exp(-1.0), 0.1, 1.0, xtol=1e-14)
    assert Correlation("cosine-exponential", 1.0, 1.0)(pi / 2.0 / quarter, 0.0) == pytest.approx(0.0, abs=1e-15)


def matern(order, t):
    return 2.0 ** (1.0 - order) / gamma(order) * t**order * kv(order, t)


@pytest.mark.parametrize("kind", KERNELS)
def test_separable_means_product_of_the_axes(kind):
    dx, dy = np.linspace(-40.0, 40.0, 9), np.linspace(-4.0, 4.0, 7)[:, None]
    for angle in (0.0, 0.3, pi):
        correlation = Correlation(kind, 20.0, 2.0, angle)
        product = correlation(dx, 0.0) * correlation(0.0, dy)
        assert correlation.is_separable == np.allclose(correlation(dx, dy), product, rtol=1e-12)


def test_reach_is_that_of_the_turned_ellipse():
    """Extremes of x = L1 cos t cos a - L2 sin t sin a over the ellipse, scanned."""
    t, a = np.linspace(0.0, 2.0 * np.pi, 100_001), 0.4
    x = 20.0 * np.cos(t) * cos(a) - 2.0 * np.sin(t) * sin(a)
    y = 20.0 * np.cos(t) * sin(a) + 2.0 * np.sin(t) * cos(a)
    assert Correlation("exponential", 20.0, 2.0, a).reach == pytest.approx((x.max(), y.max()), rel=1e-8)
