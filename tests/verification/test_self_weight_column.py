"""A column that settles under its own weight by up to several cells (finite strain).

With ``sigma = M ln J`` and constant cross-section (AMPLE's one-dimensional compaction, in logarithmic strain)

    sigma_yy(Y) = -rho0 g (H - Y)
    y(Y) = M / (rho0 g) (exp(-rho0 g (H - Y) / M) - exp(-rho0 g H / M))

The domains of uGIMP particles keep their length while their spacing shrinks, so they come to overlap: errors of stress
fall with the cell only down to a floor that grows with the strain. The linear basis does not converge at all.
"""

import numpy as np
from driver import LINEAR, UGIMP, elastic_soil, lattice, observed_orders, orders_row

from solver.grid import allocate_grid
from solver.model import STANDARD_GRAVITY
from solver.particles import allocate_particles
from solver.step import STRESS_UPDATES, Scheme, advance, allocate_workspace

HEIGHT, DENSITY = 8.0, 1000.0  # m, kg/m3
WEIGHT = DENSITY * STANDARD_GRAVITY
DAMPED = Scheme(STRESS_UPDATES["musl"], 1.0, 0.2)
LADDER = (8, 16, 32)  # cells


def settle(cells, squash, half_length=UGIMP):
    """Return relative rms errors of stress (over ``rho0 g H``) and place (over the settlement) at rest.

    Gravity grows over ten wave transits and then holds for forty; ``squash = rho0 g H / M``.
    """
    cell, modulus = HEIGHT / cells, WEIGHT * HEIGHT / squash
    x, Y = lattice(cell, HEIGHT, cell / 2.0)
    column = allocate_particles(x, Y, cell**2 / 4.0, DENSITY)
    grid, work = allocate_grid(cell, HEIGHT + cell, cell, half_length), allocate_workspace(x.size)
    steps = 40 * cells
    duration = 10.0 * HEIGHT / np.sqrt(modulus / DENSITY)
    soil, dt = elastic_soil(modulus, 0.0), duration / steps
    advance(column, grid, work, soil, DAMPED, 0.0, STANDARD_GRAVITY / duration, dt, steps)
    advance(column, grid, work, soil, DAMPED, STANDARD_GRAVITY, 0.0, dt, 4 * steps)
    stress = -WEIGHT * (HEIGHT - Y)
    place = modulus / WEIGHT * (np.exp(stress / modulus) - np.exp(-squash))
    settlement = HEIGHT - modulus / WEIGHT * (1.0 - np.exp(-squash))
    return (
        np.sqrt(np.mean((column.stress_yy - stress) ** 2)) / (WEIGHT * HEIGHT),
        np.sqrt(np.mean((column.y - place) ** 2)) / settlement,
    )


def test_stress_at_small_strain_converges_with_first_order():
    errors = [settle(cells, squash=0.01)[0] for cells in LADDER]
    assert errors[-1] < 0.01
    assert observed_orders(errors).min() > 1.0


def test_stress_at_five_percent_is_right_to_a_percent_at_sixteen_cells():
    errors = [settle(cells, squash=0.05)[0] for cells in LADDER]
    assert errors[1] < 0.01
    assert observed_orders(errors).min() > 1.2


def test_place_at_thirty_percent_converges_while_stress_keeps_a_floor():
    stress_errors, place_errors = zip(*(settle(cells, squash=0.3) for cells in LADDER), strict=True)
    assert max(stress_errors) < 0.04
    assert min(stress_errors) > 0.02  # should it fall below, the domains have learnt to follow the strain
    assert place_errors[-1] < 0.006
    assert observed_orders(place_errors).min() > 0.6


def test_linear_basis_does_not_converge_once_particles_cross_cells():
    errors = [settle(cells, squash=0.3, half_length=LINEAR)[0] for cells in LADDER]
    assert min(errors) > 0.1
    assert observed_orders(errors).max() < 0.2


def rows():
    small, moderate, large = ([settle(cells, squash) for cells in LADDER] for squash in (0.01, 0.05, 0.3))
    linear = [settle(cells, 0.3, LINEAR)[0] for cells in LADDER]
    return [
        orders_row(f"Self-weight column, {case}", expected, errors, "32 cells")
        for case, expected, errors in (
            ("1 % strain: stress", "order 1.5 to 2", [e[0] for e in small]),
            ("5 % strain: stress", "order 1.5 to 2", [e[0] for e in moderate]),
            ("30 % strain: stress", "order 1.5 to 2", [e[0] for e in large]),
            ("30 % strain: place", "order 1.5 to 2", [e[1] for e in large]),
            ("30 % strain: stress, linear basis", "no convergence", linear),
        )
    ]
