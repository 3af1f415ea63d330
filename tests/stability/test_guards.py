"""No unstable run ends as a normal record: what scene rules refuse is run, and the guards of the march stop it.

There are two of them. What a run does to its energy is judged on the way, without knowing why: the limit of the Courant
number is lifted for these tests. Shortly beyond the limit that is blind, and the limit itself stops the run.
"""

import pytest
from whole_runs import SHORTLY_BEYOND, STABLE, UNSTABLE, is_stopped, label, simulate, soft_ground

from campaign.record import Status
from campaign.simulation.flags import CREST_WALL


def test_there_are_more_than_thirty_unstable_runs():
    assert len({label(settings) for settings in UNSTABLE}) == len(UNSTABLE) > 30


@pytest.mark.parametrize("settings", UNSTABLE, ids=label)
def test_an_unstable_run_is_stopped_with_a_reason(settings):
    assert is_stopped(simulate(settings, without_limit=True))


@pytest.mark.parametrize("settings", SHORTLY_BEYOND, ids=label)
def test_shortly_beyond_the_limit_a_run_is_not_begun(settings):
    record = simulate(settings)
    assert record.status is Status.diverged
    assert record.values["steps"] == 0
    assert f"The Courant number {settings['courant']:g} is beyond" in record.reason


def test_shortly_beyond_the_limit_the_energy_does_not_tell():
    """A quarter farther, with an energy that is balanced to two thousandths: why the limit is part of the solver."""
    beyond, within = SHORTLY_BEYOND[0], SHORTLY_BEYOND[0] | {"courant": 0.9}
    wrong, right = simulate(beyond, without_limit=True), simulate(within)
    farther = wrong.values["max_displacement"][-1] / right.values["max_displacement"][-1]
    assert farther == pytest.approx(1.28, abs=0.1)
    assert abs(wrong.values["energy_error"]) < 2e-3


@pytest.mark.parametrize("settings", STABLE[:3], ids=label)
def test_a_stable_run_raises_no_alarm(settings):
    record = simulate(settings)
    assert record.status in (Status.slid, Status.not_settled, Status.reached_wall)
    assert abs(record.values["energy_error"]) < 2e-3
    assert record.values["detached_volume"] == 0.0
    assert record.reason in ("", CREST_WALL)  # the crest of these slopes is short, for speed


@pytest.mark.parametrize("settings", STABLE[3:], ids=label)
def test_no_stable_run_raises_an_alarm(settings):
    record = simulate(settings)
    assert record.status in (Status.slid, Status.not_settled, Status.reached_wall)
    assert abs(record.values["energy_error"]) < 0.015


def test_soft_ground_loses_energy_in_proportion_to_the_step():
    """A real loss, of MUSL's remap in ground that bounces by half its height, and the remedy in the reason works."""
    (_, least), (half, less), (whole, lost) = (soft_ground(courant) for courant in (0.1, 0.3, 0.6))
    assert less / least == pytest.approx(3.0, rel=0.15)
    assert lost / less == pytest.approx(2.0, rel=0.15)
    assert not is_stopped(half)
    assert "destroyed energy" in whole.reason
    assert "lower numerics.courant" in whole.reason


def test_an_explosion_that_leaves_the_grid_is_not_blamed_on_a_short_plain():
    """Its stresses have done a hundred times the work of gravity."""
    record = simulate({"stress_update": "usl", "courant": 1.5, "locking": "none"}, without_limit=True)
    assert record.status is Status.diverged
    assert "lower numerics.courant" in record.reason
