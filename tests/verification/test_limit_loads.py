"""Limit loads of perfectly plastic ground without dilation, with and without volumetric locking.

Ten cells per characteristic length, four particles a cell. Each cured load is within 5 % of the exact one or of the
established one; plain uGIMP is 10 to 35 % too strong, and its loads have no plateau but grow with displacement.
"""

import math

import numpy as np
import pytest
from driver import Row
from quasi_static import PRANDTL, bearing_pressure, factor_of_safety, quasi_static_model

from solver.surface import Surface, slope_surface
from solver.water import Water

UNIT_WEIGHT = 20e3


def vertical_cut(cells, locking, first):
    """Return ``gamma H / c`` at collapse over 3.776, which rigorous bounds enclose between 3.7752 and 3.7769."""
    height = 10.0
    cut = Surface(np.array([0.0, 15.0, 15.0, 25.0]), np.array([15.0, 15.0, 5.0, 5.0]))
    model = quasi_static_model(cut, height / cells, UNIT_WEIGHT, locking)
    return factor_of_safety(model, UNIT_WEIGHT * height / 3.776, 0.0, first)


def dawson(cells, locking, first):
    """Dawson, Roth and Drescher (1999, Geotechnique 49:835): 45 degrees, factor of safety 1 by limit analysis."""
    model = quasi_static_model(slope_surface(10.0, math.pi / 4, 10.0, 10.0, 5.0), 10.0 / cells, UNIT_WEIGHT, locking)
    return factor_of_safety(model, 12.38e3, math.radians(20.0), first)


def griffiths_lane(cells, locking, first):
    """Griffiths and Lane (1999, Geotechnique 49:387) example 1: 2:1 on a firm base; charts 1.38, FEM 1.4."""
    surface = slope_surface(10.0, math.atan(0.5), 12.0, 12.0, 0.0)
    model = quasi_static_model(surface, 10.0 / cells, UNIT_WEIGHT, locking)
    return factor_of_safety(model, 0.05 * UNIT_WEIGHT * 10.0, math.radians(20.0), first)


def ma2023(cells, locking, first):
    """The slope of the built-in scene: 0.734 by Bishop's method on the critical toe circle."""
    model = quasi_static_model(slope_surface(15.0, math.pi / 4, 20.0, 20.0, 4.0), 15.0 / cells, UNIT_WEIGHT, locking)
    return factor_of_safety(model, 20e3, math.radians(10.0), first)


def test_prandtl_strip_load_has_a_plateau_at_its_limit():
    pressure = bearing_pressure(5, "cell-average")
    assert pressure[-1] == pytest.approx(PRANDTL, rel=0.05)
    assert pressure[-1] == pytest.approx(pressure[-15], rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["tresca", "drucker-prager"])
def test_every_law_of_frictionless_ground_bears_the_strip_load(law):
    """In plane strain the circle of Drucker-Prager is that of Tresca, so their limit load is the same."""
    pressure = bearing_pressure(5, "cell-average", law=law)
    assert pressure[-1] == pytest.approx(PRANDTL, rel=0.05)
    assert pressure[-1] == pytest.approx(pressure[-15], rel=0.01)


def test_plain_gimp_has_no_plateau_under_the_strip_load():
    pressure = bearing_pressure(5, "none")
    assert pressure[-1] > 1.15 * PRANDTL
    assert pressure[-1] > 1.03 * pressure[-15]


@pytest.mark.slow
def test_prandtl_strip_load_converges():
    """First order in the cell, whichever node the width is measured to; the extrapolated loads agree."""
    coarse, fine = (bearing_pressure(cells, "cell-average")[-1] for cells in (5, 10))
    assert abs(fine / PRANDTL - 1.0) < 0.7 * abs(coarse / PRANDTL - 1.0)
    nominal_coarse, nominal_fine = coarse * 1.1, fine * 1.05
    assert 2.0 * fine - coarse == pytest.approx(PRANDTL, rel=0.01)
    assert 2.0 * nominal_fine - nominal_coarse == pytest.approx(PRANDTL, rel=0.01)


def bishop_morgenstern(cells, locking, first):
    """4:1 with a pore pressure ratio of 0.35: 1.97 - 1.78 r_u by the coefficients of Bishop and Morgenstern (1960).

    ``c / gamma H`` is 0.025, and firm ground lies a quarter of the height below the toe.
    """
    height, unit_weight = 31.0, 16e3
    surface = slope_surface(height, math.atan(0.25), 40.0, 40.0, 0.25 * height)
    model = quasi_static_model(surface, height / cells, unit_weight, locking)._replace(water=Water(ratio=0.35))
    return factor_of_safety(model, 0.025 * unit_weight * height, math.radians(20.0), first)


SLOPES = [
    (dawson, 10, 1.0, 0.95),
    (griffiths_lane, 10, 1.38, 1.30),
    (ma2023, 15, 0.734, 0.69),
    (bishop_morgenstern, 15, 1.97 - 1.78 * 0.35, 1.28),
]


@pytest.mark.parametrize(("slope", "cells", "expected", "first"), SLOPES)
def test_factor_of_safety_of_a_slope(slope, cells, expected, first):
    assert slope(cells, "cell-average", first) == pytest.approx(expected, rel=0.03)


@pytest.mark.slow
def test_plain_gimp_holds_a_slope_that_fails():
    assert dawson(10, "none", 1.1) > 1.15


@pytest.mark.slow
def test_vertical_cut():
    """One cell wide bands around a cut of ten cells: 5.6 % too strong, half of it with twenty."""
    coarse, fine = (vertical_cut(cells, "cell-average", 0.98) for cells in (10, 20))
    assert coarse == pytest.approx(1.0, abs=0.065)
    assert fine == pytest.approx(1.0, abs=0.04)


def load_row(name, locking, exact, found):
    """Return the line of a load that was found to be ``found`` times the exact one; 5 % are accepted."""
    method = {"cell-average": "", "none": ", plain uGIMP"}[locking]
    return Row(
        f"{name}{method}",
        f"{exact:.3f} within 5 %",
        f"{exact * found:.3f}",
        f"{found - 1.0:+.1%}",
        abs(found - 1.0) < 0.05,
    )


def rows():
    table = []
    for locking in ("cell-average", "none"):
        for cells in (5, 10):
            load = bearing_pressure(cells, locking)[-1]
            name = f"Strip load on Tresca ground over c, {2 * cells} cells wide"
            table.append(load_row(name, locking, PRANDTL, load / PRANDTL))
        for name, slope, cells, exact, first in (
            ("Vertical cut, stability number, 10 cells", vertical_cut, 10, 3.776, 0.98),
            ("Vertical cut, stability number, 20 cells", vertical_cut, 20, 3.776, 0.98),
            ("Slope of Dawson et al., factor of safety", dawson, 10, 1.0, 0.95),
            ("Slope of Griffiths and Lane, factor of safety", griffiths_lane, 10, 1.38, 1.30),
            ("Slope of `ma2023`, factor of safety", ma2023, 15, 0.734, 0.69),
            ("Slope with r_u = 0.35, factor of safety", bishop_morgenstern, 15, 1.97 - 1.78 * 0.35, 1.28),
        ):
            factor = slope(cells, locking, first)
            table.append(load_row(name, locking, exact, factor if slope is vertical_cut else factor / exact))
    return table
