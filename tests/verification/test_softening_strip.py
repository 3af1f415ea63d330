"""Softening in a band along the grid: force against displacement of a sheared strip.

All slip ends up in one row of cells in the middle of the strip; ``shear_band`` has the closed form. A band of one row
is half as thick as bands across the grid (``test_softening_ring``), which the average allows for, so it softens too
soon on coarse cells.
"""

import numpy as np
from driver import Row
from shear_band import PEAK, WEAK_SHARE, closed_form
from shear_strip import COARSE_CELL, RESIDUAL, compliance, shear_force

from solver.slip_to_residual import rate_of

CELLS = COARSE_CELL * np.array([1.0, 0.5, 0.25])
RATE, LENGTH = 6.0, 2.0  # 4, 8 and 16 cells in the length
LOCAL_RATE = 3.0


def curves(cells, rates, internal_length):
    """Return displacement (m) and the mean shear stress (Pa) on each mesh, from yield on."""
    found = [shear_force(cell, rate, internal_length) for cell, rate in zip(cells, rates, strict=True)]
    displacement = found[0][0]
    yielding = displacement > PEAK * compliance()
    return displacement[yielding], np.array([stress[yielding] for _, stress in found])


def spread(stress):
    """Return the largest difference between meshes over the finest one's stress."""
    return float(np.max(np.ptp(stress, axis=0) / stress[-1]))


def errors():
    """Return the largest deviation from the closed form on each mesh, inertia of the drive included."""
    displacement, stress = curves(CELLS, [RATE] * 3, LENGTH)
    return np.max(np.abs(stress / closed_form(displacement, compliance(), RATE, LENGTH, RESIDUAL) - 1.0), axis=1)


def test_non_local_softening_converges_to_the_closed_form():
    """Within 5 % on the coarsest mesh, and twice as near on the others."""
    coarsest, *others = errors()
    assert coarsest < 0.05
    assert max(others) < 0.025


def test_local_softening_gives_a_curve_for_each_mesh():
    """At the same rate half the cell uses up strength twice as fast."""
    assert spread(curves(CELLS[:2], [LOCAL_RATE] * 2, 0.0)[1]) > 0.15


def test_local_softening_scaled_with_the_cell_gives_one_curve_in_a_band():
    """The band is one cell, so the rate in proportion to the cell keeps slip to strength."""
    assert spread(curves(CELLS[:2], [LOCAL_RATE, 0.5 * LOCAL_RATE], 0.0)[1]) < 0.05


SLIP_TO_RESIDUAL = 0.7
"""In m; less than 0.4 m would snap back, as the elastic strip gives more than the band takes."""


def lost_share(cell):
    """Return the share of the drop in strength that a band has lost after ``SLIP_TO_RESIDUAL``, and its tolerance."""
    displacement, stress = shear_force(cell, rate_of(SLIP_TO_RESIDUAL, LENGTH, is_linear=False), LENGTH)
    drop = WEAK_SHARE * PEAK - RESIDUAL
    slip = displacement - compliance() * stress
    at_the_slip = float(np.interp(SLIP_TO_RESIDUAL, slip, stress))
    return 1.0 - (at_the_slip - RESIDUAL) / drop, 0.025 * at_the_slip / drop


def test_a_band_has_lost_95_percent_after_the_slip_to_residual():
    """Within the 2.5 % of the stress that are allowed to cells of an eighth of the internal length."""
    lost, tolerance = lost_share(COARSE_CELL / 2.0)
    np.testing.assert_allclose(lost, 0.95, atol=tolerance)


def rows():
    """Return the lines of the verification table."""
    non_local = errors()
    scaled = spread(curves(CELLS[:2], [LOCAL_RATE, 0.5 * LOCAL_RATE], 0.0)[1])
    lengths = ", ".join(f"{LENGTH / cell:g}" for cell in CELLS)
    lost, tolerance = lost_share(COARSE_CELL / 2.0)
    return [
        Row(
            f"Softening strip along the grid, {lengths} cells in the internal length: stress",
            "within 5 % of the closed form",
            ", ".join(f"{error:.1%}" for error in non_local),
            f"{max(non_local):.1%}",
            max(non_local) < 0.05,
        ),
        Row(
            "Softening strip along the grid, rate in proportion to the cell, h and h / 2: stress",
            "one curve within 5 %",
            f"{scaled:.1%} apart",
            f"{scaled:.1%}",
            scaled < 0.05,
        ),
        Row(
            f"Softening strip, slip to residual {SLIP_TO_RESIDUAL} m: strength lost after it",
            f"95 % within {tolerance:.1%} (2.5 % of the stress)",
            f"{lost:.1%}",
            f"{lost - 0.95:+.1%}",
            abs(lost - 0.95) < tolerance,
        ),
    ]
