"""Why realizations failed or were cut short, in words."""

import numpy as np
import pytest
import xarray as xr
from scipy import stats
from small_campaign import conclude, made_up, small_scene

from campaign.record import SLID, Status
from campaign.report import headline
from campaign.report.answer import alike, answer, outcomes
from campaign.report.cut_short import causes
from campaign.report.error_budget import error_budget
from campaign.report.inputs import sentences
from campaign.report.movement import movement
from campaign.report.reservations import reasons_for_doubt
from campaign.report.summary import summary
from campaign.results.results import Results, read_results
from campaign.results.walls import AHEAD as AHEAD_OF
from campaign.results.walls import BEHIND, with_walls_told_apart
from campaign.seeds import BASELINE
from campaign.simulation.flags import AHEAD_WALL, CAME_APART, ON_THE_BASE
from campaign.simulation.ground import prepare

LEFT = "A particle left the grid at {time} s; widen the ground."


def test_reasons_that_differ_in_their_times_are_one():
    reasons = ["took too long", *(LEFT.format(time=time) for time in ("3.90", "4.10", "4.20")), ""]
    assert list(alike(reasons).items()) == [(LEFT.format(time="3.90"), 3), ("took too long", 1)]


AHEAD = AHEAD_WALL.format(width=75.0)

BASE = ON_THE_BASE.format(percent=12.0)

RUNOUTS = 10.0 + 0.02 * np.arange(20)


@pytest.fixture(scope="module")
def twenty(tmp_path_factory):
    """Twenty slides of 10.00 to 10.38 m, and a run with mean strengths of 9 m."""
    directory, scene = tmp_path_factory.mktemp("twenty"), small_scene("campaign.realizations=20", "campaign.minimum=21")
    ground = prepare(scene)
    slides = [made_up(ground, k, runout) for k, runout in enumerate(RUNOUTS)]
    conclude(directory, scene, ground, [made_up(ground, BASELINE, 9.0), *slides])
    return read_results(directory)


def ended(results, stopped=(), moving=(), reason=AHEAD, baseline=Status.slid, **others):
    """Return the results as if some slides had ended otherwise."""
    status, why = np.full(20, int(Status.slid)), np.full(20, "", dtype=object)
    status[list(stopped)], status[list(moving)] = Status.reached_wall, Status.not_settled
    why[list(stopped)] = reason
    told = {"status": ("realization", status), "reason": ("realization", why)}
    told |= {"deterministic_status": ((), int(baseline))} | others
    return Results(results.data.assign(told), results.scene)


def by_source(results, source):
    return [row for row in error_budget(results) if row.source == source]


def test_the_wall_ahead_stops_slides(twenty):
    def told(*stopped):
        return [(each.told, each.remedy) for each in causes(ended(twenty, stopped))]

    stopped = "the wall ahead of the slope stopped {} of 20 slides"
    assert told(0) == [(stopped.format(1), "Lengthen geometry.slope.plain.")]
    assert told(0, 1)[0][0] == stopped.format(2)
    assert told() == []


def test_the_wall_behind_the_crest_disturbs_and_bounds_no_run_out(twenty):
    """Which made one of 15.50 m run 15.90 m: every number in front is told as it was counted, with a caution."""
    reached = {"reached_wall_behind": ("realization", np.arange(20) < 5)}
    disturbed = ended(twenty, **reached)
    plain, cautioned = answer(twenty), answer(disturbed)
    caution = (
        " 5 of 20 slides reach the wall behind the crest, which disturbs run-outs: with more ground there they may be "
        "longer or shorter. Lengthen geometry.slope.crest, for instance by 15 m, which moves the toe from x = 35 m to "
        "50 m."
    )
    assert caution in cautioned
    assert cautioned.replace(caution, "") == plain
    assert headline.tiles(disturbed) == headline.tiles(twenty)
    assert set(reasons_for_doubt(disturbed)) - set(reasons_for_doubt(twenty)) == {
        "5 of 20 slides reach the wall behind the crest: there the volume of the slide and the length that moves "
        "behind the crest are lower bounds. Run-outs, and what reaches a place, count as they were measured, with more "
        "ground there they may be larger or smaller."
    }
    (row,) = by_source(disturbed, "Walls")
    assert (row.value, row.interval) == ("longer or shorter", "5 of 20 slides reach the wall behind the crest")
    volume, lost, *_ = movement(disturbed)
    assert volume.remark == lost.remark == "at least: in 5 slides as far back as the wall behind the crest"


@pytest.mark.parametrize(("settle_time", "status"), [(5.0, Status.slid), (np.nan, Status.not_settled)])
def test_results_of_earlier_versions_have_the_walls_told_apart(twenty, settle_time, status):
    """They had one status for both walls, and a reason that names them."""
    behind, ahead = (f"The slide has reached {wall}, which hinders it." for wall in (BEHIND, f"{AHEAD_OF} of it"))
    old = ended(twenty, stopped=range(3)).data.drop_vars("reached_wall_behind").copy(deep=True)
    old["reason"].values[:3] = behind, ahead, f"{behind} {ahead}"
    old["settle_time"].values[:] = settle_time
    found = with_walls_told_apart(old)
    assert found["status"].values[:4].tolist() == [status, Status.reached_wall, Status.reached_wall, Status.slid]
    assert found["reached_wall_behind"].values[:4].tolist() == [1, 0, 1, 0]
    assert old["status"].values[0] == Status.reached_wall


def test_each_of_several_remarks_on_a_slide_is_counted_by_itself(twenty):
    """Three slides met the wall, of which two slipped along the base besides, and a fourth slide did so alone."""
    reasons = np.array([f"{AHEAD} {BASE}", AHEAD, "", f"{AHEAD} {BASE.replace('12', '31')}", BASE, *[""] * 15], object)
    (outcome,) = outcomes(Results(twenty.data.assign(reason=("realization", reasons)), twenty.scene))
    assert [reason.partition(":")[0] for reason in outcome.reasons] == ["In 3 of them", "In 3 of them"]
    assert outcome.reasons[0].endswith(f"{AHEAD} Lengthen geometry.slope.plain.")


def test_many_slides_cut_short_leave_no_upper_bound(twenty):
    """Mean 10.19 m, lower bound by Student's t: however far the two would have come, the true mean is not below it."""
    lower = stats.t.interval(0.95, 19, RUNOUTS.mean(), RUNOUTS.std(ddof=1) / np.sqrt(20))[0]
    told = answer(ended(twenty, stopped=[0], moving=[19]))
    assert f"The slide runs at least 10.19 m on average, at least {lower:.2f} m with 95 % confidence" in told
    assert (
        "This is a lower bound, and nothing bounds the mean from above: the wall ahead of the slope stopped 1 of 20 "
        "slides and the front of 1 of 20 slides may have come farther after the end of the run. Lengthen "
        "geometry.slope.plain. Raise numerics.end_time."
    ) in told
    assert "Single slides, as far as they came, scatter by a standard deviation of 0.12 m; the shortest" in told
    assert "the longest at least 10.38 m" in told
    (total,) = by_source(ended(twenty, stopped=[0], moving=[19]), "Total")
    assert total.value == "at least 10.19 m"
    assert total.interval == f"at least {lower:.2f} m"


def test_the_effect_of_a_single_slide_cut_short_is_told_beside_the_interval(twenty):
    """Had the slide of 10 m come twice as far, the mean of twenty would be 0.5 m larger."""
    told = answer(ended(twenty, stopped=[0]))
    lower, upper = stats.t.interval(0.95, 19, RUNOUTS.mean(), RUNOUTS.std(ddof=1) / np.sqrt(20))
    assert f"The slide runs 10.19 m on average, {lower:.2f} to {upper:.2f} m with 95 % confidence" in told
    assert (
        "The wall ahead of the slope stopped 1 of 20 slides: had it come twice as far, the mean would be 0.50 m larger."
    ) in told


def test_a_median_holds_whatever_the_longest_slides_would_have_done(twenty):
    """The interval of the median of twenty lies between the 6th and the 15th of them; only the 20th is cut short."""
    median, far = headline.tiles(ended(twenty, stopped=[19]))[1:]
    assert (median.value, median.remark) == ("10.2 m", "")
    assert far.value == "at least 10.4 m"
    assert far.remark == "lower bound: the wall ahead of the slope stopped 1 of 20 slides"
    lowest = headline.tiles(ended(twenty, stopped=range(10)))[1]
    assert (lowest.value, lowest.interval) == ("at least 10.2 m", "at least 10.1 m")
    few = headline.tiles(ended(twenty, stopped=[3]))[1]
    assert (few.value, few.interval, few.remark) == (
        "at least 10.2 m",
        "10.1 to 10.3 m",
        "the interval allows for 1 slide cut short",
    )


def test_walls_that_stop_all_slides_are_the_reason_that_is_given(twenty):
    pairs = {
        "paired_difference": ("pair", np.full(4, np.nan)),
        "deterministic_paired_difference": ((), np.nan),
        "other_release_final_runout": ((), 9.5),
        "other_release_final_runout_mass": ((), 9.5),
        "other_release_status": ((), int(Status.slid)),
    }
    stopped = ended(twenty, range(20), baseline=Status.reached_wall, **pairs)
    (change,) = by_source(stopped, "Discretisation")
    assert change.interval == "the wall ahead stopped all 20 slides"
    (release,) = by_source(stopped, "Release")
    assert (release.value, release.interval) == ("not estimated", 'this run reached the wall ahead with "release"')
    (moving,) = by_source(ended(twenty, moving=range(20), baseline=Status.not_settled, **pairs), "Release")
    assert moving.interval == 'this run may have come farther after the end time with "release"'
    assert sentences(stopped) == [
        "It takes 30 slides that the wall ahead does not stop to say which property of the soil matters, and there are "
        "0; what the inputs do is told by slides that the wall ahead does not stop, and it stopped all of them."
    ]
    assert "With mean strengths everywhere it would run at least 9.00 m; 100 % of all" in answer(stopped)
    assert by_source(stopped, "Sampling")[-1].quantity.endswith(
        "of more than 9.00 m, as far as it came with mean strengths"
    )


def test_slides_that_stand_with_half_the_cell_are_told(twenty):
    """Two of four: what that makes of the probability of a slide is open, as half the cell may add other slides."""
    repeated = xr.Variable("pair", [np.nan, -2.9, np.nan, -0.6], {"repeated": 4, "standing": 2})
    pairs = {"paired_difference": repeated, "deterministic_paired_difference": ((), np.nan)}
    probability, change = by_source(ended(twenty, **pairs), "Discretisation")
    assert (probability.value, probability.n) == ("2 of 4 slides stand with half the cell", "4")
    assert probability.interval.startswith("slides that it adds are not known: repeat the campaign")
    assert change.n == "2"


@pytest.mark.parametrize(("baseline", "other"), [(Status.slid, Status.no_slide), (Status.no_slide, Status.slid)])
def test_a_way_to_begin_that_decides_whether_the_slope_slides_is_told(twenty, baseline, other):
    runs = {
        "other_release_final_runout": ((), 5.0),
        "other_release_final_runout_mass": ((), 5.0),
        "other_release_status": ((), int(other)),
    }
    slides, stands = ("release", "ramp") if baseline in SLID else ("ramp", "release")
    assert [each for each in reasons_for_doubt(ended(twenty, baseline=baseline, **runs)) if "How failure" in each] == [
        f'How failure begins decides whether the slope slides: with mean strengths it slides with gravity = "{slides}" '
        f'and stands with "{stands}". The probability of a slide holds for "release" alone; repeat the campaign with '
        "the other, and compare."
    ]
    agreed = ended(twenty, **(runs | {"other_release_status": ((), int(Status.slid))}))
    assert not any("How failure" in each for each in reasons_for_doubt(agreed))


def test_slides_that_still_move_are_counted_not_shared_out(twenty):
    """The made-up histories advance by a tenth of the run-out in the last second."""

    def moving(*which):
        return next(each for each in reasons_for_doubt(ended(twenty, moving=which)) if "end_time" in each)

    assert moving(0).startswith(
        "The front of 1 of 20 slides may have come farther after the end of the run (numerics.end_time): its run-out is"
    )
    assert moving(0).endswith("In the last 1 s its front advanced by 0.00 m.")
    assert "The fronts of 2 of 20 slides may have come farther after the end of the run" in moving(0, 1)
    assert "(numerics.end_time): their run-outs are lower bounds." in moving(0, 1)
    assert "of these 2 advanced by more than 1 cm" in moving(0, 1)


def test_the_shortest_slide_is_bounded_below_where_it_was_cut_short(twenty):
    assert "the shortest ran at least 10.00 m" in answer(ended(twenty, stopped=[0]))
    assert "the shortest ran 10.00 m" in answer(ended(twenty, stopped=[5]))


def test_whatever_failed_and_whatever_a_wall_stopped_bound_a_share_together(twenty):
    """Mean strengths run 9 m, and all 20 farther; had the first 4 been stopped at 8 m and 2 crashed, 14 to 20 of 20."""
    runouts = np.concatenate([np.full(4, 8.0), RUNOUTS[4:18], np.full(2, np.nan)])
    status = np.array([int(Status.reached_wall)] * 4 + [int(Status.slid)] * 14 + [int(Status.crashed)] * 2)
    data = twenty.data.assign(status=("realization", status), final_runout_mass=("realization", runouts))
    slides, farther = by_source(Results(data, twenty.scene), "Failures")
    assert (slides.quantity, slides.value) == (
        "probability of a slide, whatever the failed would have done",
        "2 failed",
    )
    assert farther.quantity == "probability of more than 9.00 m, whatever the failed or cut short would have done"
    assert (farther.value, farther.interval, farther.n) == ("2 failed, 4 cut short", "at least 70 %", "20")


def test_what_is_said_of_some_realizations_is_not_said_of_all(twenty):
    apart = ended(twenty)
    apart.data["reason"].values[:3] = CAME_APART
    (outcome,) = outcomes(apart)
    assert outcome.meaning == "slid and came to rest"
    assert outcome.reasons == [f"In 3 of them: {CAME_APART}"]
    assert f"slid and came to rest. In 3 of them: {CAME_APART[:40]}" in " ".join(summary(apart).split())


def test_a_front_at_rest_with_other_ground_still_moving_is_told_as_that(twenty):
    moving = ended(twenty, settle_time=("realization", np.where(np.arange(20) < 15, np.nan, 5.0)))
    assert [(each.realizations, each.meaning) for each in outcomes(moving)] == [
        (5, "slid and came to rest"),
        (15, "slid; the front comes no farther, but ground behind it still moved at the end time"),
    ]
    assert [each.realizations for each in outcomes(twenty)] == [20]


def test_who_is_told_to_ask_for_a_rarer_slide_is_told_to_raise_the_realizations_too(twenty):
    """368 without a slide bound it by 1 %, and are looked at where blocks of 25 end."""

    def told(maximum, block=1):
        stands = {"status": ("realization", np.full(60, int(Status.no_slide)))}
        given = twenty.data.isel(realization=np.arange(60) % 20).assign_coords(realization=np.arange(60)).assign(stands)
        return answer(Results(given, small_scene(f"campaign.realizations={maximum}", f"campaign.block={block}")))

    advice = "ask for campaign.slide_probability_tolerance = 0.005, which is half of that"
    assert f"{advice}, and raise campaign.realizations to 368 or more." in told(60)
    assert f"{advice}, and raise campaign.realizations to 375 or more." in told(368, block=25)
    assert f"{advice}. " in told(368)
    assert "campaign.realizations" not in told(368)


def test_a_slope_that_stands_however_it_begins_has_no_change_of_its_run_out(twenty):
    stands = {
        "other_release_final_runout": ((), 0.0),
        "other_release_final_runout_mass": ((), 0.0),
        "other_release_status": ((), int(Status.no_slide)),
    }
    (row,) = by_source(ended(twenty, baseline=Status.no_slide, **stands), "Release")
    assert (row.value, row.interval) == ("no slide", 'the slope stands with "release" and with "ramp"')
