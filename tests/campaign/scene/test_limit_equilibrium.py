"""Bishop's method gives the factors of safety of published slopes."""

import math

import numpy as np
import pytest

from campaign.scene.layers import lower_of
from campaign.scene.limit_equilibrium import Strata, critical_circle, factor_on
from solver.surface import Surface, slope_surface
from solver.water import Water

TWO_TO_ONE = np.arctan(0.5)
UNIT_WEIGHT = 20e3  # N/m3


def one_soil(cohesion, friction_angle):
    """Return ground of one soil, from Pa and degrees."""
    return Strata((cohesion,), (np.radians(friction_angle),), (UNIT_WEIGHT,))


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
    found = critical_circle(surface, one_soil(cohesion, friction))
    assert found.factor == pytest.approx(factor, rel=0.01)


def test_a_vertical_cut_without_friction_has_fellenius_stability_number():
    """N = gamma H / c = 3.83 for circles (Fellenius 1927)."""
    surface = Surface(np.array([0.0, 30.0, 30.0, 60.0]), np.array([13.0, 13.0, 3.0, 3.0]), 30.0)
    assert critical_circle(surface, one_soil(20e3, 0.0)).factor * 10.0 == pytest.approx(3.83, rel=0.02)


def test_the_critical_circle_of_a_steep_slope_passes_through_its_toe():
    found = critical_circle(slope_surface(15.0, np.pi / 4, 20.0, 40.0, 4.0), one_soil(20e3, 10.0))
    assert found.exit == pytest.approx(35.0, abs=0.1)
    assert found.y - found.radius > 0.0


def test_a_factor_of_safety_keeps_when_lengths_and_cohesion_grow_alike():
    small = critical_circle(slope_surface(1.0, np.pi / 4, 2.0, 2.0, 0.5), one_soil(1e3, 15.0))
    large = critical_circle(slope_surface(10.0, np.pi / 4, 20.0, 20.0, 5.0), one_soil(10e3, 15.0))
    assert small.factor == pytest.approx(large.factor, rel=1e-9)
    assert 10.0 * small.radius == pytest.approx(large.radius, rel=1e-9)


CUT = slope_surface(10.0, np.radians(40.0), 25.0, 30.0, 6.0)
DRAWN = (
    Surface(np.array([0.0, 70.0]), np.array([9.0, 6.0])),
    Surface(np.array([0.0, 30.0, 70.0]), np.array([3.0, 5.0, 2.0])),
)
TOPS = tuple(lower_of(CUT, top) for top in DRAWN)
CLAY_BETWEEN = Strata((6e3, 35e3, 30e3), (np.radians(33.0), 0.0, np.radians(30.0)), (19e3, 17e3, 21e3), TOPS)


def bishop(circle, surface, strata, slices=2000):
    """Evaluate Bishop's formula slice by slice, each of the layers by itself."""
    edges = np.linspace(circle.entry, circle.exit, slices + 1)
    width, centres, factor = edges[1] - edges[0], 0.5 * (edges[1:] + edges[:-1]), 1.0
    heights = np.transpose([line.height_at(centres) for line in (surface, *strata.interfaces)]).tolist()
    for _ in range(50):
        driving = resisting = 0.0
        for x, at in zip(centres.tolist(), heights, strict=True):
            base = circle.y - (circle.radius**2 - (x - circle.x) ** 2) ** 0.5
            weight, layer = 0.0, 0
            for number, top in enumerate(at):
                bottom = at[number + 1] if number + 1 < len(at) else base
                weight += strata.unit_weight[number] * width * max(top - max(bottom, base), 0.0)
                layer = number if base < top else layer
            sine = (circle.x - x) / circle.radius
            tangent = math.tan(strata.friction_angle[layer])
            share = (1.0 - sine**2) ** 0.5 + sine * tangent / factor
            driving += weight * sine
            resisting += (strata.cohesion[layer] * width + weight * tangent) / share
        if abs(resisting / driving - factor) < 1e-9:
            return factor
        factor = resisting / driving
    raise AssertionError("it does not converge")


def test_a_layered_cut_has_the_factor_of_many_slices():
    """On the same circle, whose 30 slices have the mean strength over their bases."""
    found = critical_circle(CUT, CLAY_BETWEEN)
    assert found.factor == pytest.approx(bishop(found, CUT, CLAY_BETWEEN), rel=5e-3)
    assert found.factor == pytest.approx(factor_on(found, CUT, CLAY_BETWEEN), rel=1e-9)


def test_one_soil_in_two_layers_is_one_soil():
    twice = Strata((20e3,) * 2, (np.radians(10.0),) * 2, (UNIT_WEIGHT,) * 2, TOPS[:1])
    one, two = critical_circle(CUT, one_soil(20e3, 10.0)), critical_circle(CUT, twice)
    assert two.factor == pytest.approx(one.factor, rel=1e-12)
    assert (two.entry, two.exit) == pytest.approx((one.entry, one.exit))


def test_a_circle_stays_above_what_is_strong():
    found = critical_circle(CUT, CLAY_BETWEEN._replace(cohesion=(6e3, 35e3, 3e6)))
    x = np.linspace(found.entry, found.exit, 50)
    assert np.min(found.elevation(x) - TOPS[1].height_at(x)) > -0.1


def wet(strata, **water):
    return strata._replace(saturated_unit_weight=strata.unit_weight, water=Water(**water))


def test_a_published_slope_with_a_pore_pressure_ratio():
    """4:1, c / gamma H = 0.025, r_u = 0.35, firm ground at 1.25 H: 1.97 - 1.78 r_u = 1.35 by the coefficients of Bishop
    and Morgenstern (1960), 1.34 by another program."""
    surface = slope_surface(31.0, np.arctan(0.25), crest=60.0, plain=60.0, foundation=0.25 * 31.0)
    strata = Strata((12.5e3,), (np.radians(20.0),), (16e3,))
    assert critical_circle(surface, wet(strata, ratio=0.35)).factor == pytest.approx(1.345, rel=0.01)


def test_a_table_at_the_surface_is_a_ratio_in_saturated_ground():
    """``u = gamma_w d`` is ``r_u = gamma_w / gamma_sat``."""
    surface = slope_surface(10.0, TWO_TO_ONE, 30.0, 30.0, 5.0)
    table, ratio = (
        critical_circle(surface, wet(one_soil(10e3, 25.0), **water)).factor
        for water in ({"table": surface}, {"ratio": 9810.0 / UNIT_WEIGHT})
    )
    assert table == pytest.approx(ratio, rel=1e-9)


def test_a_table_below_all_circles_changes_nothing():
    surface = slope_surface(15.0, np.pi / 4, 20.0, 40.0, 4.0)
    dry = critical_circle(surface, one_soil(20e3, 10.0))
    table = Surface(np.array([0.0, surface.width]), np.array([0.5, 0.5]))
    assert critical_circle(surface, wet(one_soil(20e3, 10.0), table=table)) == dry


def test_a_slope_under_water_is_one_of_its_buoyant_weight():
    surface = slope_surface(10.0, TWO_TO_ONE, 30.0, 30.0, 5.0)
    level = Surface(np.array([0.0, surface.width]), np.array([20.0, 20.0]))
    under_water = critical_circle(surface, wet(one_soil(10e3, 25.0), table=level, level=20.0)).factor
    buoyant = Strata((10e3,), (np.radians(25.0),), (UNIT_WEIGHT - 9810.0,))
    assert under_water == pytest.approx(critical_circle(surface, buoyant).factor, rel=1e-9)


def test_drawdown_is_worse_than_the_lake_and_than_dry_ground():
    """Ground that stays full when the lake has gone: the classical case of upstream slopes of dams."""
    surface = slope_surface(10.0, TWO_TO_ONE, 30.0, 30.0, 5.0)
    lake = Surface(np.array([0.0, surface.width]), np.array([15.0, 15.0]))
    full, after, dry = (
        critical_circle(surface, wet(one_soil(10e3, 25.0), **water)).factor
        for water in ({"table": lake, "level": 15.0}, {"table": surface}, {})
    )
    assert after < dry < full


def grown(height, angle):
    """Return a slope in clay whose strength grows by 2 kPa/m from nothing at the level of the crest, and its F."""
    steep = Surface(np.array([0.0, 2.0, 2.0, 4.0]) * height, np.array([1.01, 1.01, 0.01, 0.01]) * height, 2.0 * height)
    surface = steep if angle == 90.0 else slope_surface(height, np.radians(angle), *[2.0 * height] * 2, 0.01 * height)
    crest = Surface(np.array([0.0, surface.width]), np.full(2, 1.01 * height))
    strata = Strata((0.0,), (0.0,), (16e3,), cohesion_gradient=(2e3,), friction_gradient=(0.0,), tops=(crest,))
    return surface, strata, critical_circle(surface, strata)


@pytest.mark.parametrize("angle", [30.0, 45.0, 60.0, 90.0])
def test_strength_that_grows_from_nothing_makes_the_factor_independent_of_the_height(angle):
    """F = N k / gamma (Gibson and Morgenstern 1962). A plane gives N = 2 cot(angle / 2), which a circle undercuts.

    For a vertical cut the plane is critical: N = 2, to which circles come within 0.3 %.
    """
    low, high = (grown(height, angle)[2].factor for height in (5.0, 20.0))
    number, plane = low * 16e3 / 2e3, 2.0 / np.tan(np.radians(angle) / 2.0)
    assert high == pytest.approx(low, rel=1e-9)
    assert number < 1.003 * plane
    assert number == pytest.approx(plane, rel=0.003) or angle < 90.0


@pytest.mark.parametrize("angle", [30.0, 45.0, 60.0])
def test_undrained_strength_along_a_circle_is_integrated_exactly(angle):
    """F = R int c ds / int W (x_c - x) dx, by 100,000 points on the same circle."""
    surface, _strata, circle = grown(10.0, angle)
    x = np.linspace(circle.entry, circle.exit, 100_001)
    x = 0.5 * (x[1:] + x[:-1])
    base, width = circle.elevation(x), (circle.exit - circle.entry) / 100_000
    strength = 2e3 * (10.1 - base) * circle.radius / np.sqrt(circle.radius**2 - (x - circle.x) ** 2)
    weight = 16e3 * (surface.height_at(x) - base)
    factor = circle.radius * np.sum(strength * width) / np.sum(weight * (circle.x - x) * width)
    assert circle.factor == pytest.approx(factor, rel=0.002)
