"""Figures show what the numbers say, and refuse what there are too few numbers for."""

import re
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
import xarray as xr
from scipy import special
from small_campaign import small_scene

import campaign
from campaign.record import Status
from campaign.report.distances import exceedance_curve
from campaign.report.figures import exceedance as of_exceedance
from campaign.report.figures.convergence import convergence
from campaign.report.figures.curves import curves
from campaign.report.figures.histogram import histogram
from campaign.report.figures.marks import marks
from campaign.report.figures.section import section_of
from campaign.report.figures.stack import upper_limit
from campaign.report.figures.style import NotDrawableError, in_style, new_figure
from campaign.results.results import Results

SCENE = small_scene()


def results(runouts, statuses=None):
    """Return results with what the figures of run-outs need."""
    n, time = len(runouts), np.linspace(0, 10, 21)
    counted = np.arange(1, n + 1)
    per_look = np.ones(n)
    status = np.zeros(n, dtype=int) if statuses is None else np.array([int(each) for each in statuses])
    data = xr.Dataset(
        {
            "final_runout": ("realization", np.array(runouts, dtype=float)),
            "final_runout_mass": ("realization", np.array(runouts, dtype=float)),
            "runout_mass": (("realization", "time"), np.outer(runouts, np.minimum(time / 5, 1))),
            "settle_time": ("realization", np.full(n, 6.0)),
            "status": ("realization", status),
            "deterministic_runout": ("time", 9.0 * np.minimum(time / 5, 1)),
            "deterministic_final_runout": 9.0,
            "deterministic_status": 0,
            "deterministic_final_runout_mass": 9.0,
            "runout_mean": ("checkpoint", per_look),
            "runout_variance": ("checkpoint", per_look),
        },
        {"realization": np.arange(n), "time": time, "checkpoint": counted},
        {"verdict": f"not converged after {n} realizations"},
    )
    return Results(data, SCENE)


def exceedance(given):
    return of_exceedance.exceedance(given, exceedance_curve(given))


NORMAL = np.random.default_rng(5).normal(9.0, 0.5, 40)
DRAWINGS = [curves, histogram, exceedance, convergence]


@pytest.mark.parametrize("draw", DRAWINGS)
def test_a_figure_is_a_png_with_something_on_it(draw, tmp_path):
    with in_style():
        illustration = draw(results(NORMAL))
        illustration.figure.savefig(tmp_path / "figure.png", dpi=30)
    picture = matplotlib.image.imread(tmp_path / "figure.png")
    assert np.ptp(picture[..., :3]) > 0.5
    assert "40 slides" in illustration.caption


@pytest.mark.parametrize("draw", DRAWINGS)
def test_without_slides_a_sentence_says_so(draw):
    with pytest.raises(NotDrawableError, match="there are none"):
        draw(results([0.0, 0.0], [Status.no_slide] * 2))


@pytest.mark.parametrize("draw", [histogram, convergence])
def test_equal_runouts_have_no_distribution(draw):
    with pytest.raises(NotDrawableError, match="All final run-outs are equal"):
        draw(results([9.5] * 12))


def test_axes_of_every_panel_have_units():
    for draw in DRAWINGS:
        for axes in draw(results(NORMAL)).figure.axes:
            assert re.search(r"\((m|-|%)\)", axes.get_ylabel()), draw.__name__


def test_exceedance_is_counted():
    """Of the run-outs 1, 2, 3, 4 m all are longer than zero, half than 2 m, none than 4 m."""
    (axes,) = exceedance(results([3.0, 1.0, 4.0, 2.0])).figure.axes
    distance, share = axes.lines[0].get_data()
    np.testing.assert_allclose(distance[:5], [0, 1, 2, 3, 4])
    np.testing.assert_allclose(share[:5], [1.0, 0.75, 0.5, 0.25, 0.0])


def test_exceedance_counts_slopes_that_stay():
    """Two of four slide, 1 and 2 m far: half run farther than zero, a quarter than 1 m."""
    given = results([1.0, 0.5, 2.0, 0.2], [Status.slid, Status.no_slide] * 2)
    (axes,) = exceedance(given).figure.axes
    _, share = axes.lines[0].get_data()
    np.testing.assert_allclose(share[:2], [0.5, 0.25])


def test_failed_realizations_are_in_no_curve():
    statuses = [Status.slid] * 30 + [Status.crashed] * 10
    illustration = curves(results(np.r_[NORMAL[:30], np.full(10, np.nan)], statuses))
    assert len(illustration.figure.axes[0].collections[0].get_segments()) == 30


def test_no_quantiles_of_few():
    labels = {n: curves(results(NORMAL[:n])).figure.axes[0].get_legend_handles_labels()[1] for n in (19, 20)}
    assert ["5 to 95 %" in labels[n] for n in (19, 20)] == [False, True]


def test_the_last_point_of_the_convergence_is_the_estimate():
    mean, std = convergence(results(NORMAL)).figure.axes
    assert mean.lines[0].get_ydata()[-1] == pytest.approx(NORMAL.mean())
    assert std.lines[0].get_ydata()[-1] == pytest.approx(NORMAL.std(ddof=1))


def test_runout_is_marked_from_the_toe():
    """The toe of the paper's slope is at 35 m, elevation 4 m."""
    section = section_of(SCENE, [9.0])
    _, (axes,) = new_figure(3.0)
    section.mark_runout(axes, 9.0)
    (line,) = axes.collections
    assert [segment[0, 0] for segment in line.get_segments()] == [35.0, 44.0]
    assert axes.texts[-1].get_text() == "9.00 m"
    assert 44.0 < section.right < 75.0


def test_a_colour_range_ignores_a_few_extremes():
    assert upper_limit(np.r_[np.ones(1000), 100.0]) == 1.0
    assert upper_limit(np.zeros(3)) == 1.0


def test_ranks_are_by_runout_among_the_usable():
    given = results([3.0, 9.0, 1.0, 2.0], [Status.slid, Status.diverged, Status.slid, Status.not_settled])
    assert [given.ranked(share) for share in (0.0, 0.5, 1.0)] == [2, 3, 0]
    with pytest.raises(ValueError, match="Nothing slid"):
        results([0.0], [Status.no_slide]).ranked(0.5)


def test_no_figure_opens_a_window():
    package = Path(campaign.__file__).parent
    assert not any("pyplot" in path.read_text() for path in package.rglob("*.py"))


def test_what_is_left_open_beyond_the_longest_slide_is_told_with_those_cut_short():
    """Of 40 slides 39 stay short of the longest; 10 of them were cut short. Exact: up to 8.8 % and 43 %."""
    assert "m; that alone leaves a probability of up to 8.8 %." in exceedance(results(NORMAL)).caption
    statuses = [Status.not_settled] * 10 + [Status.slid] * 30
    told = exceedance(results(NORMAL, statuses)).caption
    assert f"with 10 slides cut short before that leaves a probability of up to {upper(10, 40)}." in told


def test_marks_where_slides_stop_say_at_least_where_walls_leave_them_open():
    walled = results(np.sort(NORMAL), [Status.slid] * 30 + [Status.reached_wall] * 10)
    half, far = marks(walled, section_of(SCENE, NORMAL), has_room=True)[2:4]
    assert (half.text, far.text) == ("half stop before", "95 % stop: at least here")
    free = marks(results(NORMAL), section_of(SCENE, NORMAL), has_room=True)
    assert [label.text for label in free[2:4]] == ["half stop before", "95 % stop before"]


def upper(count, n):
    """Return the exact upper bound of a proportion in words."""
    return f"{100 * special.betaincinv(count + 1, n - count, 0.975):.0f} %"
