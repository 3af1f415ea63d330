"""A bar that is fixed at one end and vibrates along its axis in its first mode (``vibrating_bar`` has the solution)."""

import pytest
from driver import SCHEMES, Row, observed_orders, orders_row
from vibrating_bar import vibrate


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
