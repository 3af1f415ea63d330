"""Bishop's method gives the factors of safety of published slopes."""

import numpy as np
import pytest

from campaign.scene.limit_equilibrium import critical_circle
from solver.surface import Surface, slope_surface

TWO_TO_ONE = np.arctan(0.5)
UNIT_WEIGHT = 20e3  # N/m3


@pytest.mark.parametrize(
    ("height", "angle", "foundation", "cohesion", "friction", "factor"),
    [
        pytest.param(15.0, np.pi / 4, 4.0, 20e3, 10.0, 0.734, id="critical toe circle of an independent script"),
        pytest.param(15.0, np.pi / 4, 4.0, 10e3, 5.0, 0.366, id="the same with residual strength"),
        pytest.param(10.0, np.pi / 4, 5.0, 12.38e3, 20.0, 1.00, id="Dawson, Roth and Drescher 1999"),
        pytest.param(10.0, TWO_TO_ONE, 0.01, 10e3, 20.0, 1.38, id="Bishop and Morgenstern, c / gamma H = 0.05"),
        pytest.param(10.0, TWO_TO_ONE, 10.0, 50e3, 0.0, 1.47, id="Taylor, undrained, depth factor 2"),
    ],
)
def test_published_slopes(height, angle, foundation, cohesion, friction, factor):
    surface = slope_surface(height, angle, crest=3.0 * height, plain=3.0 * height, foundation=foundation)
    found = critical_circle(surface, cohesion, np.radians(friction), UNIT_WEIGHT)
    assert found.factor == pytest.approx(factor, rel=0.01)


def test_a_vertical_cut_without_friction_has_fellenius_stability_number():
    """N = gamma H / c = 3.83 for circles (Fellenius 1927)."""
    surface = Surface(np.array([0.0, 30.0, 30.0, 60.0]), np.array([13.0, 13.0, 3.0, 3.0]), 30.0)
    assert critical_circle(surface, 20e3, 0.0, UNIT_WEIGHT).factor * 10.0 == pytest.approx(3.83, rel=0.02)


def test_the_critical_circle_of_a_steep_slope_passes_through_its_toe():
    found = critical_circle(slope_surface(15.0, np.pi / 4, 20.0, 40.0, 4.0), 20e3, np.radians(10.0), UNIT_WEIGHT)
    assert found.exit == pytest.approx(35.0, abs=0.1)
    assert found.y - found.radius > 0.0


def test_a_factor_of_safety_keeps_when_lengths_and_cohesion_grow_alike():
    small = critical_circle(slope_surface(1.0, np.pi / 4, 2.0, 2.0, 0.5), 1e3, np.radians(15.0), UNIT_WEIGHT)
    large = critical_circle(slope_surface(10.0, np.pi / 4, 20.0, 20.0, 5.0), 10e3, np.radians(15.0), UNIT_WEIGHT)
    assert small.factor == pytest.approx(large.factor, rel=1e-9)
    assert 10.0 * small.radius == pytest.approx(large.radius, rel=1e-9)
