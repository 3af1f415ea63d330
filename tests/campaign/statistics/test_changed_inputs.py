"""What more of an input changes, in pairs of the same slide."""

import numpy as np
import pytest
from tallies import summary_of

from campaign.record import Status
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.statistics.changed_inputs import InputEffects, differences, first_slides
from campaign.statistics.repetition import without_rule
from campaign.statistics.tally import tally_of


def account(runouts, **statuses):
    tally = tally_of(without_rule(load_scene("ma2023"), len(runouts) - 1))
    for k, runout in enumerate(runouts, start=BASELINE):
        tally.add(summary_of(k, runout, statuses.get(f"_{k}", Status.slid)))
    return tally


def test_the_first_slides_without_a_wall_are_repeated():
    tally = account([9.0] * 8, _0=Status.no_slide, _2=Status.crashed, _3=Status.reached_wall)
    assert first_slides(tally, 3) == (1, 4, 5)
    assert first_slides(tally, 9) == (1, 4, 5, 6)
    assert first_slides(tally, 0) == ()


def test_a_slope_that_then_stands_has_lost_all_of_its_runout():
    before = account([9.0, 10.0, 11.0, 12.0, 13.0])
    after = account([9.0, 10.5, 0.0, 20.0, 13.0], _1=Status.no_slide, _2=Status.reached_wall, _3=Status.diverged)
    np.testing.assert_array_equal(differences((0, 1, 2, 3), before, after), [0.5, -11.0, np.nan, np.nan])


def test_the_largest_effect_comes_first_and_an_unknown_one_last():
    """Student's t of 95 % and 1 degree of freedom is 12.706: -2 +- 12.706 * 1 m for -1 and -3 m."""
    rows = np.array([[0.4, 0.6], [np.nan, np.nan], [-1.0, -3.0]])
    found = InputEffects(("rate", "length", "cohesion"), (0, 1), rows, 0.95)
    assert list(found.ranked()) == ["cohesion", "rate", "length"]
    assert list(found.known()) == ["cohesion", "rate"]
    assert found.effects["cohesion"] == pytest.approx((-2.0, -14.706, 10.706, 2, False), abs=1e-3)
