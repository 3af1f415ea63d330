"""The run-out study (``runout.md``) belongs to this code, and the built-in scene has converged as it says."""

import json

import pytest
import runout
from runout_ladders import BY_CELL, key_of
from runout_report import extrapolate, runouts

STUDY = json.loads(runout.STORE.read_text())
OURS = BY_CELL[0]


@pytest.mark.parametrize("ladder", BY_CELL, ids=lambda ladder: ladder.title)
def test_the_study_was_made_by_this_code(ladder):
    """Its coarsest run, once more; rounding may differ between processors."""
    coarsest = ladder.runs[0]
    again = runout.compute(coarsest.scene, coarsest.overrides)
    assert abs(again["final_runout_mass"] - STUDY[key_of(coarsest)]["final_runout_mass"]) < 0.05


@pytest.mark.slow
@pytest.mark.parametrize("run", OURS.runs[1:3], ids=lambda run: run.label)
def test_the_runout_has_converged(run):
    """Within 5 % of the limit, with cells of 1 m and of 0.5 m."""
    _, limit = extrapolate(runouts(OURS, STUDY)[1][-3:])
    assert abs(runout.compute(run.scene, run.overrides)["final_runout_mass"] / limit - 1.0) < 0.05


def test_extrapolation_of_a_power():
    """``q = 3 + h^2`` and ``3 + sqrt(h)`` on halved cells; the second is held to order 1; no order if it alternates."""
    assert extrapolate([7.0, 4.0, 3.25]) == pytest.approx((2.0, 3.0))
    order, limit = extrapolate([5.0, 3.0 + 2.0**0.5, 4.0])
    assert order == pytest.approx(0.5)
    assert limit == pytest.approx(4.0 - (2.0**0.5 - 1.0))
    assert extrapolate([1.0, 3.0, 2.0])[1] == 2.5
