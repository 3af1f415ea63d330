"""Why realizations failed or were cut short, in words."""

import numpy as np
import xarray as xr
from small_campaign import small_scene

from campaign.record import Status
from campaign.report.answer import alike, walls_in_words
from campaign.results.results import Results
from campaign.simulation.flags import AHEAD_WALL, CREST_WALL

LEFT = "A particle left the grid at {time} s; widen the ground."


def test_reasons_that_differ_in_their_times_are_one():
    reasons = ["took too long", *(LEFT.format(time=time) for time in ("3.90", "4.10", "4.20")), ""]
    assert alike(reasons) == [LEFT.format(time="3.90"), "took too long"]


def test_the_wall_in_the_way_is_named():
    reasons = np.array([CREST_WALL, f"{CREST_WALL} {AHEAD_WALL.format(width=50.0)}", ""], dtype=object)

    def told(*chosen):
        status = [int(Status.reached_wall) if k in chosen else int(Status.slid) for k in range(3)]
        data = {"reason": ("realization", reasons), "status": ("realization", status)}
        return walls_in_words(Results(xr.Dataset(data), small_scene()))

    assert told(0) == "the wall behind the crest (geometry.slope.crest)"
    assert told(0, 1).endswith("or that ahead of the slope (geometry.slope.plain)")
    assert told(2) == "a wall of the model"
