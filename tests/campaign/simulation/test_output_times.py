"""Output times are the decimals that they read as, so that one is found by its name."""

from decimal import Decimal

import numpy as np
import pytest

from campaign.simulation.solver_model import output_times


@pytest.mark.parametrize(("end", "interval"), [("10", "0.1"), ("2", "0.02"), ("8", "0.3"), ("1", "0.7"), ("6", "0.05")])
def test_every_output_time_is_the_float_of_its_decimal(end, interval):
    times = output_times(float(end), float(interval))
    k = 0
    while k * Decimal(interval) < Decimal(end):
        assert times[k] == float(k * Decimal(interval))
        k += 1
    assert times[k:].tolist() == [float(end)]


def test_an_output_time_is_found_by_its_decimal():
    times = output_times(10.0, 0.1).tolist()
    assert {0.3, 0.6, 0.7, 1.2, 9.9} <= set(times)
    assert len(times) == 101
    assert np.all(np.diff(times) > 0.09)
