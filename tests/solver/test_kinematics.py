"""Rotation of stress and change of volume."""

import numpy as np
import pytest
from pointwise import rotate

from solver.kinematics import volume_ratio

STRESS = (-100e3, -250e3, 30e3)  # xx, yy, xy in Pa


def turned(stress, angle):
    """Return the components of ``stress`` after a counter-clockwise turn of the body, by ``R sigma R^T``."""
    xx, yy, xy = stress
    R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    tensor = R @ np.array([[xx, xy], [xy, yy]]) @ R.T
    return tensor[0, 0], tensor[1, 1], tensor[0, 1]


@pytest.mark.parametrize("angle", [1e-6, 0.1, -0.7, 3.0])
def test_rotation_is_exact_for_its_half_angle_tangent(angle):
    """A counter-clockwise turn has ``W_xy = -angle``; Cayley's rotation reads it as ``-2 tan(angle / 2)``."""
    found = rotate(STRESS, -2.0 * np.tan(angle / 2.0), 1)
    np.testing.assert_allclose(found, turned(STRESS, angle), rtol=0.0, atol=1e-14 * 250e3)


@pytest.mark.parametrize("steps_per_turn", [20, 200, 2000])
def test_full_turns_keep_the_invariants(steps_per_turn):
    """The first-order update would multiply the deviator by ``exp(8 pi^2 / n)`` a turn: 1.48 for n = 200."""
    xx, yy, xy = rotate(STRESS, 2.0 * np.pi / steps_per_turn, 10 * steps_per_turn)
    assert xx + yy == pytest.approx(STRESS[0] + STRESS[1], rel=1e-12)
    assert np.hypot(xx - yy, 2.0 * xy) == pytest.approx(np.hypot(150e3, 60e3), rel=1e-11)


def test_rotation_error_of_a_turn_falls_with_the_square_of_the_increment():
    """``2 atan(w / 2) = w - w^3 / 12``: a turn in n steps ends short by ``2 pi (2 pi / n)^2 / 12``."""
    errors = [np.linalg.norm(np.subtract(rotate(STRESS, -2.0 * np.pi / n, n), STRESS)) for n in (100, 200, 400)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 2.0, atol=0.01)


def test_volume_ratio_is_the_determinant():
    rng = np.random.default_rng(3)
    for gradient in rng.normal(0.0, 0.2, (100, 2, 2)):
        assert volume_ratio(*gradient.ravel()) == pytest.approx(np.linalg.det(np.eye(2) + gradient), rel=1e-13)


def test_volume_follows_finite_shear_and_stretch():
    steps = 1000
    assert volume_ratio(0.0, 0.3, 0.0, 0.0) == 1.0
    assert volume_ratio(np.expm1(np.log(2.0) / steps), 0.0, 0.0, 0.0) ** steps == pytest.approx(2.0, rel=1e-12)
