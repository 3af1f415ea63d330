"""Softening in a band across the grid: stress against displacement of a sheared ring on ``h``, ``h / 2``, ``h / 4``.

The thickness of the closed form (``shear_band``) is the internal length, or, with local softening, that of a band.
"""

import numpy as np
import pytest
from driver import Row
from scipy.optimize import minimize_scalar
from shear_band import PEAK, WEAK_SHARE, closed_form
from shear_ring import compliance, shear_force

from solver.internal_length import BAND_THICKNESS
from solver.slip_to_residual import SHARE_LEFT, rate_of

RATE, LENGTH = 1.875, 1.25
CELLS = (0.5, 0.25, 0.125)


def after_yield(cell, rate, internal_length):
    """Return displacement and stress once the band has formed."""
    displacement, stress = shear_force(cell, rate, internal_length)
    has_formed = displacement > 1.3 * PEAK * compliance()
    return displacement[has_formed], stress[has_formed]


def largest_error(cell):
    """Return the largest deviation from the closed form with the internal length, relative to it."""
    displacement, stress = after_yield(cell, RATE, LENGTH)
    return float(np.max(np.abs(stress / closed_form(displacement, compliance(), RATE, LENGTH, 0.0) - 1.0)))


def local_thickness(cell):
    """Return the thickness in m of a band that softens locally, fitted to the stress."""
    displacement, stress = after_yield(cell, RATE, 0.0)
    misfit = minimize_scalar(
        lambda thickness: float(np.sum((closed_form(displacement, compliance(), RATE, thickness, 0.0) - stress) ** 2)),
        bounds=(0.1 * cell, 10.0 * cell),
        method="bounded",
    )
    return float(misfit.x)


@pytest.mark.parametrize(
    "cell",
    [
        pytest.param(0.5, marks=pytest.mark.xfail(strict=True, reason="5.4 %: the coarsest cells that resolve it")),
        pytest.param(0.25, marks=pytest.mark.slow),
        pytest.param(0.125, marks=pytest.mark.slow),
    ],
)
def test_non_local_softening_follows_the_closed_form(cell):
    """Within 5 % at all displacements."""
    assert largest_error(cell) < 0.05


def test_a_band_that_softens_locally_is_as_thick_as_allowed_for():
    """Measured 2.11 and 2.12 cells: what ``nonlocal_softening`` allows for."""
    np.testing.assert_allclose(local_thickness(CELLS[0]) / CELLS[0], BAND_THICKNESS, rtol=0.02)


def share_left(thickness):
    """Return what is left of the drop after the slip to residual if a band softens over ``thickness`` (m)."""
    return SHARE_LEFT ** (LENGTH / thickness)


@pytest.mark.slow
def test_a_band_across_the_grid_has_lost_95_percent_after_the_slip_to_residual():
    """Between what bands of 2.0 and 2.6 cells allow, since the sum of variances takes them for 2.1 cells thick."""
    cell, slip_to_residual = CELLS[1], 0.55
    displacement, stress = shear_force(cell, rate_of(slip_to_residual, LENGTH, is_linear=False), LENGTH)
    left = np.interp(slip_to_residual, displacement - compliance() * stress, stress) / (WEAK_SHARE * PEAK)
    thin, thick = (np.sqrt(LENGTH**2 + (cells**2 - BAND_THICKNESS**2) * cell**2) for cells in (2.0, 2.6))
    assert share_left(thin) < left < share_left(thick)


def rows():
    """Return the lines of the verification table."""
    errors = [largest_error(cell) for cell in CELLS]
    thickness = [local_thickness(cell) / cell for cell in CELLS[:2]]
    deviation = max(abs(cells / BAND_THICKNESS - 1.0) for cells in thickness)
    return [
        Row(
            f"Softening ring, internal length {LENGTH} m, cells 0.5, 0.25, 0.125 m: stress",
            "within 5 % of the closed form",
            ", ".join(f"{error:.1%}" for error in errors),
            f"{max(errors):.1%}",
            max(errors) < 0.05,
        ),
        Row(
            "Softening ring, local, cells 0.5, 0.25 m: thickness of the band",
            f"{BAND_THICKNESS} cells, as allowed for",
            ", ".join(f"{cells:.2f}" for cells in thickness),
            f"{deviation:.1%}",
            deviation < 0.02,
        ),
    ]
