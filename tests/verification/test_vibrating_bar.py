"""A bar that is fixed at one end and vibrates along its axis in its first mode.

    u(X, t) = A sin(w t) sin(pi X / 2 L),  w = pi c / 2 L,  c = sqrt(E / rho)

Places belong to whole steps and velocities to half steps (leapfrog), hence the start with the velocity at ``-dt / 2``
and the kinetic energy from the mean of two velocities.
"""

import numpy as np
import pytest
from driver import (
    MUSL,
    SCHEMES,
    Row,
    elastic_soil,
    grid_without_walls,
    lattice,
    node_indices,
    observed_orders,
    orders_row,
)

from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

LENGTH, MODULUS, DENSITY = 25.0, 100.0, 1.0  # m, Pa, kg/m3
SPEED = np.sqrt(MODULUS / DENSITY)
FREQUENCY = np.pi * SPEED / (2.0 * LENGTH)  # rad/s
PERIOD = 2.0 * np.pi / FREQUENCY
PERIODS = 5


def fixed_free_bar(cell, half_length=0.25):
    """Return the bar, a grid on which it can only move along itself, and its mode shape (n,)."""
    X, y = lattice(LENGTH, cell, cell / 2.0)
    bar = allocate_particles(X, y + 2.0 * cell, cell**2 / 4.0, DENSITY)
    grid = grid_without_walls(LENGTH + 4.0 * cell, 5.0 * cell, cell, half_length)
    grid.free_x[node_indices(grid)[0] <= 0] = 0.0
    grid.free_y[:] = 0.0
    return bar, grid, np.sin(np.pi * X / (2.0 * LENGTH))


def vibrate(cells, amplitude, scheme=MUSL, courant=0.3, half_length=0.25):
    """Return rms displacement error over ``amplitude`` (m), and relative errors of period and energy."""
    cell = LENGTH / cells
    bar, grid, mode = fixed_free_bar(cell, half_length)
    X, work, soil = bar.x.copy(), allocate_workspace(bar.x.size), elastic_soil(MODULUS, 0.0)
    steps = round(PERIODS * PERIOD * SPEED / (courant * cell))
    dt = PERIODS * PERIOD / steps
    bar.velocity_x[:] = amplitude * FREQUENCY * mode * np.cos(FREQUENCY * dt / 2.0)
    time = dt * np.arange(1, steps + 1)
    error, share, energy = np.empty((3, steps))
    for k in range(steps):
        before = bar.velocity_x.copy()
        advance(bar, grid, work, soil, scheme, 0.0, 0.0, dt, 1)
        u = bar.x - X
        error[k] = np.mean((u - amplitude * np.sin(FREQUENCY * time[k]) * mode) ** 2)
        share[k] = u @ mode
        energy[k] = 0.5 * np.sum(bar.mass * (0.5 * (before + bar.velocity_x)) ** 2) + work.ledger[0]
    rising = np.flatnonzero((share[:-1] < 0.0) & (share[1:] >= 0.0))
    crossing = time[rising] - share[rising] * dt / (share[rising + 1] - share[rising])
    initial = 0.5 * np.sum(bar.mass * (amplitude * FREQUENCY * mode) ** 2)
    return (
        np.sqrt(error.mean()) / amplitude,
        np.diff(crossing).mean() / PERIOD - 1.0,
        energy[-steps // PERIODS :].mean() / initial - 1.0,
    )


@pytest.mark.parametrize("scheme", SCHEMES)
def test_period_amplitude_and_energy_without_cell_crossing(scheme):
    displacement_error, period_error, energy_error = vibrate(25, 0.16, SCHEMES[scheme])
    assert displacement_error < 0.01
    assert abs(period_error) < 0.001
    assert abs(energy_error) < 0.001


def test_period_converges_with_second_order():
    errors = [vibrate(cells, 1e-3)[1] for cells in (12, 25, 50)]
    assert observed_orders(errors).min() > 1.8


@pytest.mark.parametrize("scheme", SCHEMES)
def test_cell_crossing_costs_two_percent(scheme):
    """Amplitude 1.2 cells and 7 % strain, where ``E ln F`` itself differs from the linear solution."""
    displacement_error, period_error, energy_error = vibrate(25, 1.2, SCHEMES[scheme])
    assert displacement_error < 0.035
    assert abs(period_error) < 0.002
    assert abs(energy_error) < 0.01


def test_update_stress_last_loses_stability_below_courant_0_7_and_musl_does_not():
    """The spectral limits of uGIMP are 0.58 for USL and 1.72 for MUSL."""
    assert vibrate(25, 0.01, SCHEMES["usl"], courant=0.5)[2] == pytest.approx(0.0, abs=1e-2)
    assert vibrate(25, 0.01, SCHEMES["usl"], courant=0.7)[2] > 1.0
    assert vibrate(25, 0.01, SCHEMES["musl"], courant=1.3)[2] == pytest.approx(0.0, abs=1e-2)


def rows():
    table = []
    for amplitude, accepted in ((0.16, 0.01), (1.2, 0.035)):
        for name, scheme in SCHEMES.items():
            displacement_error, period_error, energy_error = vibrate(25, amplitude, scheme)
            table.append(
                Row(
                    f"Vibrating bar, amplitude {amplitude} cells, {name.upper()}",
                    f"period 4 L / c within 0.2 %, energy within 0.5 %, place within {accepted:.1%}",
                    f"period {period_error:+.2%}, energy {energy_error:+.2%}",
                    f"{displacement_error:.2%} of the amplitude",
                    abs(period_error) < 0.002 and abs(energy_error) < 0.005 and displacement_error < accepted,
                )
            )
    periods = [vibrate(cells, 1e-3)[1] for cells in (12, 25, 50)]
    return [*table, orders_row("Vibrating bar, period", 2, 1.8, periods, "50 cells")]
