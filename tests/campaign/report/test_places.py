"""What comes to a place, with the front and ahead of it."""

import numpy as np
import pytest
import xarray as xr
from scipy import special
from small_campaign import small_scene

from campaign.record import Status
from campaign.report import headline
from campaign.report.places import ended_or_was_there, places, reach_estimates
from campaign.results.results import Results
from campaign.statistics.receptors import AHEAD, EFFECTS

HOUSE = small_scene('receptor=[{name="house", x="42 m"}]')


def results(front, moved):
    """Return slides of which some reach a house with their front and some with any ground, 1, 2, 3, ... m deep."""
    n = len(front)
    numbers = np.arange(1.0, n + 1.0)[:, None]
    by, no_front = ("realization", "receptor"), 1.0 - np.array(front, dtype=float)[:, None]
    data = {
        "status": ("realization", np.full(n, int(Status.slid))),
        "front_reaches": (by, np.array(front, dtype=float)[:, None]),
        "moved_ground_reaches": (by, np.array(moved, dtype=float)[:, None]),
        "front_position": (("realization", "time"), np.zeros((n, 2))),
        "farther_advance": ("realization", np.zeros(n)),
        "settle_time": ("realization", np.full(n, 5.0)),
        "front_arrival": (by, numbers, {"units": "s"}),
        "moved_ground_arrival": (by, numbers - 1.0, {"units": "s"}),
        **{name: (by, numbers, {"units": "m"}) for name in EFFECTS},
        **{name: (by, numbers * no_front, {"units": "m"}) for name in AHEAD},
    }
    places = {"receptor": ["house"], "receptor_x_bounds": (("receptor", "bounds"), [[42.0, 42.0]])}
    return Results(xr.Dataset(data, places), HOUSE)


@pytest.mark.parametrize(("front", "told"), [([1, 0, 0, 0], "any moved ground: 100 %, at least 40 %"), ([1] * 4, "")])
def test_moved_ground_is_told_beside_the_front_where_it_gets_there_more_often(front, told):
    (tile,) = headline.reaches(results(front, [1] * 4))
    assert tile.remark == told
    (reach,) = reach_estimates(results(front, [1] * 4))
    assert reach.is_pushed_farther == bool(told)


def test_where_walls_stopped_all_others_nothing_bounds_a_probability_from_above():
    """Three of four get there; a wall stopped the fourth. The lower bound is that of Clopper and Pearson."""
    given = results([1, 1, 1, 0], [1] * 4)
    stopped = ("realization", np.array([int(Status.slid)] * 3 + [int(Status.reached_wall)]))
    walled = Results(given.data.assign(status=stopped), given.scene)
    least = f"at least {100 * special.betaincinv(3, 2, 0.025):.0f} %"
    (tile,) = headline.reaches(walled)
    assert (tile.value, tile.interval) == ("at least 75 %", least)
    (place,) = places(walled)
    assert place.chances[0][1:] == ("at least 75 %", least)
    (free,) = headline.reaches(given)
    assert free.value == "75 %"


def test_moved_ground_is_seen_first_where_no_front_comes():
    assert headline.reaches(results([0] * 4, [1, 1, 0, 0]))[0].value == "front 0 %, moved ground 50 %"
    assert headline.reaches(results([0] * 4, [0] * 4))[0].value == "0 %"


def test_what_comes_ahead_of_the_front_is_told_apart():
    """2, 3 and 4 m deep where the front does not get there; where it does, only what comes with it."""
    (place,) = places(results([1, 0, 0, 0], [1] * 4))
    assert place.slides == 1
    assert place.pushed == (
        "In 3 slides with ground here that is pushed or thrown ahead of the front, which does not come"
    )
    assert (place.ahead[0].name, place.ahead[0].median) == ("largest depth", "3.00 m")
    assert place.ahead[-1].name == "final rise of the ground where the front does not come"
    (place,) = places(results([1] * 4, [1] * 4))
    assert (place.pushed, place.ahead) == ("", [])


def test_the_first_ground_is_told_beside_the_front():
    (place,) = places(results([1] * 4, [1] * 4))
    rows = {row.name: row.median for row in place.effects}
    assert rows["arrival of any moved ground after the release"] == "1.50 s"
    assert rows["arrival of the front"] == "2.50 s"


def beside_a_wall(away, statuses):
    """Return slides whose front reaches a house so far (m) from the wall ahead, and how they ended."""
    house = f'receptor=[{{name="house", x="{75.0 - away:g} m"}}]'
    given = results([1] * len(statuses), [1] * len(statuses))
    status = ("realization", np.array([int(each) for each in statuses]))
    return Results(given.data.assign(status=status), small_scene(house))


def test_flow_close_to_a_wall_that_stopped_it_is_told_with_caution():
    """Five cells of 2 m: what a wall 8 m away throws back is seen, what one 12 m away does is not."""
    (place,) = places(beside_a_wall(8.0, [Status.reached_wall] * 3 + [Status.slid]))
    assert place.thrown_back == (
        "The wall ahead, 8 m from here, stopped 3 of the 4 slides that come here. Ground piles up at it and is "
        "thrown back, so that depths, velocities and pressures are not those of the slope alone."
    )
    for away, ending in ((12.0, Status.reached_wall), (8.0, Status.slid)):
        (place,) = places(beside_a_wall(away, [ending] * 4))
        assert place.thrown_back == ""


def test_what_ground_that_still_moves_does_at_a_place_is_so_far():
    """In two of four slides ground still moved at the end, one of them the least deep: 1, 2, 3 and 4 m."""
    given = results([1] * 4, [1] * 4)
    moving = given.data.assign(settle_time=("realization", np.array([np.nan, 5.0, 5.0, np.nan])))
    (place,) = places(Results(moving, given.scene))
    told = {row.name: row.median for row in place.effects}
    assert told["largest flow depth"] == "at least 2.50 m"
    assert told["arrival of the front"] == "2.50 s"
    assert told["final rise of the ground"] == "2.50 m"
    assert place.so_far.startswith(
        "In 2 of the 4 slides that come here, ground somewhere still moved when the run ended"
    )
    (still,) = places(given)
    assert (still.so_far, still.effects[2].median) == ("", "2.50 m")


def test_a_probability_that_few_leave_open_is_at_least_what_was_counted():
    """Two of four get there, one may have come there after the end, and the fourth has not slid."""
    given = results([1, 1, 0, 0], [1, 1, 0, 0])
    ends = [Status.slid, Status.slid, Status.not_settled, Status.no_slide]
    data = given.data.assign(
        status=("realization", np.array([int(each) for each in ends])),
        farther_advance=("realization", np.full(4, np.nan)),
    )
    most = f"{100 * special.betaincinv(4, 1, 0.975):.3g} %"
    (tile,) = headline.reaches(Results(data, given.scene))
    (place,) = places(Results(data, given.scene))
    assert place.so_far == (
        "In 1 more the front may come that was cut short; what arrives then, and when, is in no table."
    )
    assert (tile.value, tile.interval) == ("at least 50 %", f"{100 * special.betaincinv(2, 3, 0.025):.2g} to {most}")


def test_fronts_that_came_back_are_why_a_place_counts_more_than_the_table():
    """The toe is at 35 m and the house 7 m beyond: of four fronts that were there one ended 6 m from the toe."""
    given = results([1] * 4, [1] * 4)
    data = given.data.assign(final_runout_mass=("realization", np.array([6.0, 7.0, 8.0, 9.0]))).assign_attrs(toe_x=35.0)
    assert ended_or_was_there(Results(data, HOUSE)) == (
        "The table counts fronts that ended beyond a distance, a place those that were ever there: 1 came back from "
        "house."
    )
    stayed = data.assign(final_runout_mass=("realization", np.full(4, 7.0)))
    assert ended_or_was_there(Results(stayed, HOUSE)) == ""
    tip = small_scene('receptor=[{name="house", x="42 m"}]', "slide.front=tip")
    assert "front-most particle" in ended_or_was_there(Results(data, tip))


def test_a_place_that_walls_keep_every_front_from_has_no_interval_that_says_nothing():
    given = results([0] * 4, [1] * 4)
    status = ("realization", np.full(4, int(Status.reached_wall)))
    (tile,) = headline.reaches(Results(given.data.assign(status=status), given.scene))
    assert (tile.value, tile.interval) == ("front not known, moved ground 100 %", "0 to 100 %")
