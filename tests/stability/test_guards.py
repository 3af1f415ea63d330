"""No unstable run ends as a normal record: what scene rules refuse is run, and the guards of the march stop it."""

import pytest
from whole_runs import STABLE, UNSTABLE, is_stopped, label, simulate

from campaign.record import Status

QUICK = UNSTABLE[::6]
SLOW = [run for run in UNSTABLE if run not in QUICK]


def test_there_are_more_than_thirty_unstable_runs():
    assert len(UNSTABLE) > 30


@pytest.mark.parametrize("settings", QUICK, ids=label)
def test_an_unstable_run_is_stopped_with_a_reason(settings):
    assert is_stopped(simulate(settings))


@pytest.mark.slow
@pytest.mark.parametrize("settings", SLOW, ids=label)
def test_every_unstable_run_is_stopped_with_a_reason(settings):
    assert is_stopped(simulate(settings))


@pytest.mark.parametrize("settings", STABLE[:3], ids=label)
def test_a_stable_run_raises_no_alarm(settings):
    record = simulate(settings)
    assert record.status in (Status.slid, Status.not_settled)
    assert abs(record.values["energy_error"]) < 2e-3


@pytest.mark.slow
@pytest.mark.parametrize("settings", STABLE[3:], ids=label)
def test_no_stable_run_raises_an_alarm(settings):
    record = simulate(settings)
    assert record.status in (Status.slid, Status.not_settled)
    assert abs(record.values["energy_error"]) < 0.015


def test_an_explosion_that_leaves_the_grid_is_not_blamed_on_a_short_plain():
    """Its stresses have done a hundred times the work of gravity."""
    record = simulate({"stress_update": "usl", "courant": 1.5, "locking": "none"})
    assert record.status is Status.diverged
    assert "lower numerics.courant" in record.reason
