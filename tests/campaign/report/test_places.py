"""What comes to a place, with the front and ahead of it."""

import numpy as np
import pytest
import xarray as xr
from small_campaign import small_scene

from campaign.record import Status
from campaign.report import headline
from campaign.report.places import EFFECTS, places, reach_estimates
from campaign.results.results import Results

HOUSE = small_scene('receptor=[{name="house", x="42 m"}]')


def results(front, moved):
    """Return slides of which some reach a house with their front and some with any ground, 1, 2, 3, ... m deep."""
    n = len(front)
    numbers = np.arange(1.0, n + 1.0)[:, None]
    by = ("realization", "receptor")
    data = {
        "status": ("realization", np.full(n, int(Status.slid))),
        "front_reaches": (by, np.array(front, dtype=float)[:, None]),
        "moved_ground_reaches": (by, np.array(moved, dtype=float)[:, None]),
        "front_arrival": (by, numbers, {"units": "s"}),
        **{name: (by, numbers, {"units": "m"}) for name in EFFECTS},
    }
    return Results(xr.Dataset(data, {"receptor": ["house"]}), HOUSE)


@pytest.mark.parametrize(("front", "told"), [([1, 0, 0, 0], "any moved ground: 100 %, at least 40 %"), ([1] * 4, "")])
def test_moved_ground_is_told_beside_the_front_where_it_gets_there_more_often(front, told):
    (tile,) = headline.reaches(results(front, [1] * 4))
    assert tile.remark == told
    (reach,) = reach_estimates(results(front, [1] * 4))
    assert reach.is_pushed_farther == bool(told)


def test_what_pushed_ground_does_is_told():
    """2, 3 and 4 m deep where the front does not get there."""
    (place,) = places(results([1, 0, 0, 0], [1] * 4))
    assert place.slides == 1
    assert place.pushed.startswith("In 3 slides ground gets here that is pushed or thrown ahead of the front")
    assert "3.00 m deep or more" in place.pushed
    assert places(results([1] * 4, [1] * 4))[0].pushed == ""
