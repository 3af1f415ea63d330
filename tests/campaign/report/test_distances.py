"""Probabilities of a longer run-out, for any distance, and numbers as the page writes them."""

import numpy as np
import pytest
import xarray as xr
from small_campaign import small_scene

from campaign.record import Status
from campaign.report import distances, headline
from campaign.report.movement import REST, movement
from campaign.report.wording import bounds, number, unbroken
from campaign.results.results import Results
from campaign.statistics.intervals import Interval
from campaign.statistics.proportions import exact_interval

SCENE = small_scene()


def results(runouts, statuses, raised=None, rest=None, influence=None):
    """Return results of slides that raise ground by 1 m up to `raised` m from the toe, or as far as their fronts."""
    n, x = len(runouts), np.arange(0.0, 120.0, 0.5)
    reach = np.nan_to_num(np.array(runouts if raised is None else raised, dtype=float))
    data = {
        "x": ("x", x),
        "initial_surface": ("x", np.zeros(x.size)),
        "deposit_surface": (("realization", "x"), (x <= reach[:, None]).astype(float)),
        "reached_wall_behind": ("realization", np.zeros(n)),
        "settle_time": ("realization", np.full(n, 5.0) if rest is None else np.array(rest)),
        "sliding_volume": ("realization", np.ones(n), {"units": "m3/m"}),
        "retrogression": ("realization", np.ones(n), {"units": "m"}),
        "influence_distance": (
            "realization",
            np.broadcast_to(6.0 if influence is None else influence, n),
            {"units": "m"},
        ),
        "final_runout": ("realization", np.array(runouts, dtype=float)),
        "final_runout_mass": ("realization", np.array(runouts, dtype=float)),
        "status": ("realization", np.array([int(each) for each in statuses])),
        "reason": ("realization", np.full(n, "", dtype=object)),
    }
    return Results(xr.Dataset(data, {"realization": np.arange(n)}, {"toe_x": 0.0}), SCENE)


def table(given):
    return distances.table(distances.curves_of(given))


SOMETIMES = results([2.0, 0.3, 1.0, 0.3], [Status.slid, Status.no_slide] * 2)
"""Two of four slide, 1 and 2 m far."""


@pytest.mark.parametrize(("distance", "beyond"), [(0.0, 2), (0.99, 2), (1.0, 1), (1.9, 1), (2.0, 0), (99.0, 0)])
def test_the_curve_counts_who_runs_farther(distance, beyond):
    curve = distances.exceedance_curve(SOMETIMES)
    assert curve.at(distance) == pytest.approx(exact_interval(beyond, 4, 0.95))
    given = distances.exceedance_curve(SOMETIMES, given_sliding=True)
    assert given.at(distance) == pytest.approx(exact_interval(beyond, 2, 0.95))


def test_the_script_gets_the_words_of_the_table():
    curves = distances.curves_of(SOMETIMES)
    data = distances.data(curves)
    assert data["distance"] == [0.0, 1.0, 2.0]
    assert data["all"] == [curves.all.words(distance) for distance in (0.0, 1.0, 2.0)]
    assert data["sliding"][1] == curves.given_sliding.words(1.5) == "50 % (1.3 to 98.7 %)"


def test_where_walls_leave_a_probability_open_table_and_script_say_at_least():
    """One of three ran beyond 2 m, and the walls may have kept both others from it: 1/3 or more (exact: 0.84 %)."""
    given = results([1.0, 2.0, 3.0], [Status.reached_wall, Status.reached_wall, Status.slid])
    assert distances.data(distances.curves_of(given))["all"][2] == "at least 33 % (at least 0.84 %)"
    assert "at least 33 % (at least 0.84 %)" in [row.beyond for row in table(given)]


def test_the_table_has_round_distances_from_all_slides_to_none():
    rng = np.random.default_rng(3)
    rows = table(results(rng.normal(10.0, 1.0, 40), [Status.slid] * 40))
    assert 4 <= len(rows) <= 10
    assert rows[0].beyond.startswith("100 %")
    assert rows[-1].beyond.startswith("0 %")
    assert all(len(row.distance) <= len("10.5 m") for row in rows)


@pytest.mark.parametrize("runouts", [[5.0], [5.0, 5.0], [0.0, 0.0]])
def test_few_or_equal_slides_give_a_table(runouts):
    assert table(results(runouts, [Status.slid] * len(runouts)))


def test_nothing_slid_means_no_table():
    assert table(results([0.0], [Status.no_slide])) == []


def test_the_first_numbers_are_of_the_slides():
    """Of 1 to 100 m the median is 50.5 m; 72 slides or more bound the 95 % quantile from above."""
    probability, median, far = headline.tiles(results(np.arange(1.0, 101.0), [Status.slid] * 100))
    assert (probability.value, probability.remark) == ("at least 96.4 %", "100 of 100 simulated slopes slid")
    assert (median.value, median.interval, median.remark) == ("50.5 m", "40.0 to 61.0 m", "")
    assert far.value in ("95.0 m", "95.1 m")
    assert "to" in far.interval


def test_few_slides_say_how_many_it_takes():
    _, median, far = headline.tiles(results(np.arange(1.0, 11.0), [Status.slid] * 10))
    assert "to" in median.interval
    assert far.interval.startswith("at least")
    assert far.remark == "both bounds need 72 slides"


def test_a_single_slide_is_told_without_an_interval():
    _, only = headline.tiles(results([3.0, 0.0], [Status.slid, Status.no_slide]))
    assert (only.name, only.value, only.interval) == ("Run-out of the only slide", "3.00 m", "")


def test_walls_and_failures_are_told_first():
    statuses = [Status.slid] * 8 + [Status.reached_wall, Status.not_settled, Status.crashed]
    probability, median, far = headline.tiles(results([*np.arange(1.0, 11.0), np.nan], statuses))
    assert probability.remark == "10 of 10 simulated slopes slid; 1 failed"
    assert (median.value, median.interval) == ("5.5 m", "at least 2.0 m")
    stopped = "the wall ahead of the slope stopped 1 of 10 slides"
    stopped += " and the front of 1 of 10 slides may have come farther after the end of the run"
    assert (far.value, far.remark) == ("at least 9.5 m", f"lower bound: {stopped}")


def test_ground_raised_ahead_of_the_fronts_is_told_beside_them():
    """Fronts stop after 1 to 100 m, and the ground they push is raised 12 m farther."""
    runouts = np.arange(1.0, 101.0)
    _, median, far = headline.tiles(results(runouts, [Status.slid] * 100, runouts + 12.0))
    assert median.remark == "ground is raised as far as 62.5 m"
    assert far.remark == "ground is raised as far as 107.0 m"


def test_ground_raised_by_slides_cut_short_is_raised_at_least_so_far():
    """The wall stopped the longest twenty of a hundred: the median is known, the 95 % quantile is a lower bound."""
    runouts = np.arange(1.0, 101.0)
    _, median, far = headline.tiles(results(runouts, [Status.slid] * 80 + [Status.reached_wall] * 20, runouts + 12.0))
    assert median.remark == "ground is raised as far as 62.5 m"
    assert far.remark.endswith("; ground is raised at least as far as 107.0 m")


def test_a_rest_after_the_end_is_later_than_the_others():
    """Of 20 slides 8 rest after 1 to 8 s: half of them do so after the end of the run; of 12, half within 10.5 s."""

    def told(settled):
        rest = [*np.arange(1.0, settled + 1.0), *[np.nan] * (20 - settled)]
        return movement(results(np.arange(1.0, 21.0), [Status.slid] * 20, rest=rest))[-1]

    assert told(8).median == "later than the end"
    assert (told(12).median, told(12).median_interval) == ("10.5 s", "at least 6.00 s")
    assert told(20).far_interval.startswith("at least")


def test_units_are_those_of_a_reader():
    assert number(4330.0, "Pa") == "4.33 kPa"
    assert number(421.2, "m3/m") == "421 m³/m"
    assert number(20.0, "m") == "20.0 m"
    assert number(np.nan, "m") == "–"
    assert bounds(Interval(1.0, 0.5, np.nan, 9), "m") == "at least 0.500 m"
    assert bounds(Interval(1.0, np.nan, np.nan, 1), "m") == "too few slides for an interval"
    assert unbroken("5 m, 2 mm and 3 men") == "5\u00a0m, 2\u00a0mm and 3 men"


def test_where_there_would_be_more_behind_the_crest_it_is_a_lower_bound():
    """The crest is 20 m long; in three slides ground moves up to its wall, in two others it still moves at the end."""
    given = results(
        np.arange(1.0, 21.0), [Status.slid] * 20, rest=[np.nan] * 2 + [5.0] * 18, influence=[6.0] * 17 + [20.0] * 3
    )
    volume, lost, moved, rest = movement(given)
    told = "at least: in 2 slides still moving at the end"
    assert (volume.name, volume.remark) == ("ground that moves by more than 0.1 m, per metre of width", told)
    assert (lost.name, lost.remark) == ("length lost behind the crest, moved by more than 1 m", told)
    assert moved.name == "length behind the crest that moves by more than 0.1 m"
    at_wall = "in 3 slides as far back as the wall behind the crest"
    assert moved.remark == f"at least: {at_wall} and in 2 slides still moving at the end"
    assert (rest.name, rest.remark) == (REST, "")


def test_what_moves_in_slides_that_a_wall_stopped_is_at_least_so_much():
    """A wall ahead holds back all of a slide; 10 of 20 leave the upper half of the values open."""
    given = results(
        np.arange(1.0, 21.0), [Status.reached_wall] * 10 + [Status.slid] * 10, influence=[*np.arange(1.0, 11.0)] * 2
    )
    volume, lost, moved, rest = movement(given)
    assert volume.remark == lost.remark == moved.remark == "at least: in 10 slides that the wall ahead stopped"
    assert (volume.median, lost.median) == ("at least 1.00 m³/m", "at least 1.00 m")
    assert (moved.median, moved.median_interval) == ("at least 5.50 m", "at least 3.00 m")
    assert rest.remark == "in 10 slides with the wall ahead in the way"
    free = movement(results(np.arange(1.0, 21.0), [Status.slid] * 20, influence=[*np.arange(1.0, 11.0)] * 2))
    assert (free[2].median, free[2].median_interval) == ("5.50 m", "3.00 to 8.00 m")
