"""Gravity that acts all at once on an elastic column: twice the static stress at its base.

The base stops a column that falls, so a wave of stress ``rho c v = rho c g t`` leaves it and comes back from the free
top after ``2 L / c``: the stress at the base is a triangular wave between nothing and ``2 rho g L`` with the period
``4 L / c``. At height ``y``, in modes of ``k = (2 n + 1) pi / 2 L``,

    sigma_yy = -rho g sum_n 2 / (k^2 L) cos(k y) (1 - cos(k c t))

which is why gravity is brought on with damping or slowly before strength counts.
"""

import numpy as np
from driver import MUSL, Row, elastic_soil, lattice, observed_orders, orders_row

from solver.constants import STANDARD_GRAVITY
from solver.grid import allocate_grid
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

LENGTH, DENSITY, MODULUS = 8.0, 2000.0, 100e6  # m, kg/m3, Pa: a strain of 0.2 %
SPEED = np.sqrt(MODULUS / DENSITY)
PERIOD = 4.0 * LENGTH / SPEED
WEIGHT = DENSITY * STANDARD_GRAVITY * LENGTH  # Pa
PERIODS, COURANT = 2, 0.4
LADDER = (10, 20, 40)  # cells


def exact_stress(y, t, modes=2000):
    """Return ``sigma_yy`` in Pa at height ``y`` (m) and times ``t`` (s)."""
    k = (np.arange(modes) + 0.5) * np.pi / LENGTH
    shares = 2.0 / (k * LENGTH) ** 2 * np.cos(k * y)
    return -WEIGHT * (shares @ (1.0 - np.cos(np.outer(k, SPEED * t))))


def base_stress(cells):
    """Return times (s) and mean ``sigma_yy`` (Pa) in the lowest cell, whose middle is half a cell above the base."""
    cell = LENGTH / cells
    x, y = lattice(cell, LENGTH, 0.5 * cell)
    column = allocate_particles(x, y, 0.25 * cell**2, DENSITY)
    grid, work = allocate_grid(cell, LENGTH + cell, cell, 0.25), allocate_workspace(x.size)
    lowest, soil = y < cell, elastic_soil(MODULUS, 0.0)
    steps = int(np.ceil(PERIODS * PERIOD * SPEED / (COURANT * cell)))
    dt = PERIODS * PERIOD / steps
    stress = np.empty(steps)
    for step in range(steps):
        advance(column, grid, work, (soil,), MUSL, STANDARD_GRAVITY, 0.0, dt, 1)
        stress[step] = column.stress_yy[lowest].mean()
    return dt * np.arange(1, steps + 1), stress


def errors(cells):
    """Return errors of the largest stress, of the period (relative), and of the history (rms, over the weight)."""
    t, stress = base_stress(cells)
    exact = exact_stress(0.5 * LENGTH / cells, t)
    first, second = (t[part][np.argmin(stress[part])] for part in (t < PERIOD, t >= PERIOD))
    return (
        stress.min() / exact.min() - 1.0,
        (second - first) / PERIOD - 1.0,
        np.sqrt(np.mean((stress - exact) ** 2)) / WEIGHT,
    )


def test_modes_add_up_to_the_triangular_wave():
    t = np.array([0.25, 0.5, 0.75, 1.0]) * PERIOD
    np.testing.assert_allclose(exact_stress(0.0, t), -WEIGHT * np.array([1.0, 2.0, 1.0, 0.0]), atol=1e-3 * WEIGHT)


def test_stress_at_the_base_is_doubled_and_swings():
    peak_error, period_error, _ = errors(20)
    assert abs(peak_error) < 0.02
    assert abs(period_error) < 0.03


def test_history_converges_with_nearly_first_order():
    """The wave has kinks."""
    histories = [errors(cells)[2] for cells in LADDER]
    assert histories[-1] < 0.02
    assert observed_orders(histories).min() > 0.8


def rows():
    ladder = [errors(cells) for cells in LADDER]
    peak, period, _ = ladder[-1]
    return [
        Row(
            "Sudden gravity, stress in the lowest cell",
            "twice the static one within 2 %, period 4 L / c within 3 %",
            f"{2.0 * (1.0 + peak):.2f} times, period {period:+.1%} at 40 cells",
            f"{peak:+.1%}",
            abs(peak) < 0.02 and abs(period) < 0.03,
        ),
        orders_row("Sudden gravity, history of that stress", 1, 0.8, [e[2] for e in ladder], "40 cells"),
    ]
