"""Which slides have settled when the run ends: those whose front comes no farther, whatever moves behind it."""

from types import SimpleNamespace

import numpy as np
import pytest

from campaign.record import Status
from campaign.simulation.realization import status_of
from solver.history import MarchEnd
from solver.slide import PAPER
from solver.walls import Walls

NO_WALLS = Walls()


def ending(runout, farther, end=MarchEnd.END_TIME, walls=NO_WALLS):
    history = SimpleNamespace(
        end=end, max_displacement=np.array([0.0, 40.0]), runout_mass=np.array([0.0, runout]), walls=walls
    )
    return SimpleNamespace(history=history, model=SimpleNamespace(criteria=PAPER), farther_advance=farther)


@pytest.mark.parametrize(
    ("runout", "farther", "status"),
    [
        (5.0, 0.0, Status.slid),
        (5.0, 0.09, Status.slid),  # less than counts as displaced
        (5.0, 0.11, Status.not_settled),
        (54.0, 1.0, Status.slid),  # less than 2 % of the run-out
        (54.0, 1.1, Status.not_settled),
        (54.0, np.nan, Status.not_settled),  # nothing bounds it
    ],
)
def test_a_slide_has_settled_once_its_front_comes_no_farther(runout, farther, status):
    assert status_of(ending(runout, farther)) is status


def test_what_a_wall_stopped_has_not():
    assert status_of(ending(5.0, 0.0, walls=Walls(right=True))) is Status.reached_wall


def test_the_wall_behind_the_crest_decides_nothing():
    behind = Walls(left=True)
    assert status_of(ending(5.0, 0.0, walls=behind)) is Status.slid
    assert status_of(ending(5.0, np.nan, walls=behind)) is Status.not_settled
