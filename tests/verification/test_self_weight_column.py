"""A column that settles under its own weight by up to several cells (finite strain).

With ``sigma = M ln J`` and constant cross-section (AMPLE's one-dimensional compaction, in logarithmic strain)

    sigma_yy(Y) = -rho0 g (H - Y)
    y(Y) = M / (rho0 g) (exp(-rho0 g (H - Y) / M) - exp(-rho0 g H / M))

Strain is constant in a cell as long as no domain crosses its sides, so at small strain the stress of a particle is that
of the middle of its cell: wrong by ``rho0 g h / 4``, of first order.

The domains of uGIMP particles keep their length ``h / 2`` while their spacing shrinks to ``F h / 2``, so they come to
overlap. Across a cell acts the stress ``sum_p V_p s_p chi(x_p) / h``, with ``chi`` the share of a domain in the cell,
and the ``V_p chi(x_p)`` add up to ``h (1 + eps cos(...))`` with (Poisson summation, first harmonic)

    eps(F) = 2 sinc(2 / F) sinc(1 / F),   sinc(x) = sin(pi x) / (pi x)

so equilibrium wants a stress that is wrong by ``eps`` in a pattern that drifts from cell to cell. That is the floor of
uGIMP at finite strain, on any grid; domains that follow the strain (cpGIMP) have none. Place has an error of first
order, because a settled surface lies between nodes. The linear basis does not converge at all.
"""

import numpy as np
import pytest
from driver import LINEAR, UGIMP, Row, divergence_row, elastic_soil, lattice, observed_orders, orders_row

from solver.constants import STANDARD_GRAVITY
from solver.grid import allocate_grid
from solver.particles import allocate_particles
from solver.scheme import STRESS_UPDATES, Scheme
from solver.step import advance, allocate_workspace

HEIGHT, DENSITY = 8.0, 1000.0  # m, kg/m3
WEIGHT = DENSITY * STANDARD_GRAVITY
DAMPED = Scheme(STRESS_UPDATES["musl"], 1.0, 0.2)
LADDER = (8, 16, 32)  # cells


def settle(cells, squash, half_length=UGIMP):
    """Return relative rms errors at rest: of stress, of its mean over a cell (over ``rho0 g H``), of place.

    Place is over the settlement, and a cell is one of those before the settlement.
    Gravity grows over ten wave transits and then holds for forty; ``squash = rho0 g H / M``.
    """
    cell, modulus = HEIGHT / cells, WEIGHT * HEIGHT / squash
    x, Y = lattice(cell, HEIGHT, cell / 2.0)
    column = allocate_particles(x, Y, cell**2 / 4.0, DENSITY)
    grid, work = allocate_grid(cell, HEIGHT + cell, cell, half_length), allocate_workspace(x.size)
    steps = 40 * cells
    duration = 10.0 * HEIGHT / np.sqrt(modulus / DENSITY)
    soil, dt = elastic_soil(modulus, 0.0), duration / steps
    advance(column, grid, work, (soil,), DAMPED, 0.0, STANDARD_GRAVITY / duration, dt, steps)
    advance(column, grid, work, (soil,), DAMPED, STANDARD_GRAVITY, 0.0, dt, 4 * steps)
    stress = -WEIGHT * (HEIGHT - Y)
    place = modulus / WEIGHT * (np.exp(stress / modulus) - np.exp(-squash))
    settlement = HEIGHT - modulus / WEIGHT * (1.0 - np.exp(-squash))
    excess = (column.stress_yy - stress) / (WEIGHT * HEIGHT)
    return (
        np.sqrt(np.mean(excess**2)),
        np.sqrt(np.mean(np.mean(excess.reshape(cells, -1), axis=1) ** 2)),
        np.sqrt(np.mean((column.y - place) ** 2)) / settlement,
    )


def overlap_floor(squash):
    """Return the rms of ``eps`` times the stress over the column, over ``rho0 g H``."""
    share = np.linspace(0.0, 1.0, 1001)  # of the weight that lies above
    stretch = np.exp(-squash * share)
    return np.sqrt(np.mean((share * 2.0 * np.sinc(2.0 / stretch) * np.sinc(1.0 / stretch)) ** 2) / 2.0)


def test_stress_at_small_strain_converges_with_first_order():
    errors = np.array([settle(cells, squash=0.01)[0] for cells in LADDER])
    np.testing.assert_allclose(errors, 0.25 / np.array(LADDER), rtol=0.2)
    assert observed_orders(errors).min() > 1.0


def test_stress_at_five_percent_is_right_to_a_percent_at_sixteen_cells():
    errors = [settle(cells, squash=0.05)[0] for cells in LADDER]
    assert errors[1] < 0.01
    assert observed_orders(errors).min() > 1.2


def test_place_at_thirty_percent_converges_while_stress_keeps_a_floor():
    stress_errors, cell_errors, place_errors = zip(*(settle(cells, squash=0.3) for cells in LADDER), strict=True)
    assert max(stress_errors) < 0.04
    assert min(stress_errors) > 0.02  # should it fall below, the domains have learnt to follow the strain
    assert cell_errors[-1] == pytest.approx(overlap_floor(0.3), rel=0.25)
    assert place_errors[-1] < 0.006
    assert observed_orders(place_errors).min() > 0.6


def test_linear_basis_does_not_converge_once_particles_cross_cells():
    errors = [settle(cells, squash=0.3, half_length=LINEAR)[0] for cells in LADDER]
    assert min(errors) > 0.1
    assert observed_orders(errors).max() < 0.2


def rows():
    small, moderate, large = ([settle(cells, squash) for cells in LADDER] for squash in (0.01, 0.05, 0.3))
    linear = [settle(cells, 0.3, LINEAR)[0] for cells in LADDER]
    fine, floor = [settle(cells, 0.3)[1] for cells in (64, 128)], overlap_floor(0.3)
    return [
        orders_row(f"Self-weight column, {case}", 1, 0.8, errors, "32 cells")
        for case, errors in (
            (f"1 % strain: stress (h / 4 H = {0.25 / LADDER[-1]:.2%})", [e[0] for e in small]),
            ("5 % strain: stress", [e[0] for e in moderate]),
            ("30 % strain: stress", [e[0] for e in large]),
            ("30 % strain: place", [e[2] for e in large]),
        )
    ] + [
        Row(
            "Self-weight column, 30 % strain: mean stress of a cell",
            f"floor {floor:.2%}, where domains overlap",
            f"{large[-1][1]:.2%}, {fine[0]:.2%}, {fine[1]:.2%} at 32, 64, 128 cells",
            f"{fine[1] / floor - 1.0:+.0%} of the floor",
            abs(fine[1] / floor - 1.0) < 0.25,
        ),
        divergence_row("Self-weight column, 30 % strain: stress, linear basis", linear, "32 cells"),
    ]
