"""Campaigns beside each other: which pairs count, what is said of them, and what is written."""

import numpy as np
import pytest
import xarray as xr
from scenarios import keep

from campaign import cli
from campaign.comparison.doubts import doubts
from campaign.comparison.measures import measures
from campaign.comparison.scenarios import compare
from campaign.comparison.table import as_text
from campaign.errors import RefusalError
from campaign.record import Status
from campaign.report.figures.comparison import comparison as draw_comparison
from campaign.statistics.paired import mean_difference, proportion_difference

RUNOUTS = np.random.default_rng(1).normal(10.0, 1.0, 12)
STRONGER = "soil.cohesion.mean=22 kPa"


@pytest.fixture
def two(tmp_path):
    """Return two campaigns: of 12, the second one runs 2 m less far, 3 do not slide there and 1 fails in each."""
    statuses = [Status.crashed, *[Status.slid] * 11]
    weak = keep(tmp_path / "weak", RUNOUTS, statuses=statuses, reaches=[1] * 6 + [0] * 6)
    statuses = [*[Status.slid] * 8, *[Status.no_slide] * 3, Status.timeout]
    strong = keep(tmp_path / "strong", RUNOUTS - 2.0, STRONGER, statuses=statuses, reaches=[1] * 2 + [0] * 10)
    return weak, strong


def by_words(given, *distances):
    return {measure.words: measure.differences[0] for measure in measures(given, distances)}


def test_pairs_are_the_realizations_with_a_result_in_all(two):
    given = compare(two)
    assert given.names == ("weak", "strong")
    assert given.ids.tolist() == list(range(1, 11))


def test_run_out_is_zero_without_a_slide_and_given_sliding_it_is_not(two):
    found = by_words(compare(two), 9.0)
    without = np.concatenate([np.full(7, -2.0), -RUNOUTS[8:11]])
    assert found["mean run-out, 0 without a slide"].interval.estimate == pytest.approx(without.mean())
    assert found["mean run-out where all slide"].interval.estimate == pytest.approx(-2.0)
    assert found["mean run-out where all slide"].interval.n == 7
    assert "mean run-out where all slide, 7 pairs " in as_text(compare(two), measures(compare(two), []), [])
    assert found["mean sliding volume, 0 without a slide"].interval.estimate == pytest.approx(10 * without.mean())
    assert found["P(slide)"][:2] == (1.0, 0.7)
    shares = np.mean(RUNOUTS[1:11] > 9.0), np.mean(np.where(np.arange(1, 11) < 8, RUNOUTS[1:11] - 2.0, 0.0) > 9.0)
    assert found["P(run-out above 9 m)"][:2] == pytest.approx(shares)
    assert found["P(front reaches road)"][:2] == (0.5, 0.1)
    assert found["P(moved ground reaches Straße)"][:2] == (0.5, 0.1)


def test_the_scenes_differ_in_the_units_of_people(two):
    assert compare(two).changes(1) == [("soil.cohesion.mean", "20 kPa", "22 kPa")]


def test_failures_are_told_and_a_plain_comparison_needs_no_word(two, tmp_path):
    assert doubts(compare(two)) == [
        "Realizations that failed in any campaign are left out of all (1 in weak, 1 in strong)."
    ]
    again = keep(tmp_path / "again", RUNOUTS, "soil.cohesion.mean=23 kPa")
    assert doubts(compare([keep(tmp_path / "once", RUNOUTS), again])) == []


@pytest.mark.parametrize(
    ("override", "sentence"),
    [
        ("campaign.seed=7", "nothing in common"),
        ("field.vertical=3 m", "(field.vertical)"),
        ("geometry.slope.height=16 m", "another width or height"),
        ("slide.front=tip", "front of the tip"),
        ("numerics.cell=1 m", "what the mesh changes"),
        ("slide.failed=2 m", "slide.failed differ"),
    ],
)
def test_what_pairs_do_not_share_is_told(tmp_path, override, sentence):
    given = compare([keep(tmp_path / "one", RUNOUTS), keep(tmp_path / "other", RUNOUTS, override)])
    (told,) = doubts(given)
    assert sentence in told


def test_the_front_is_that_of_the_first(tmp_path):
    one, other = keep(tmp_path / "one", RUNOUTS, "slide.front=tip"), keep(tmp_path / "other", RUNOUTS)
    assert compare([one, other]).runouts(1) == pytest.approx(RUNOUTS + 1.0)
    assert compare([other, one]).runouts(1) == pytest.approx(RUNOUTS)


def test_bounds_counts_and_other_receptors_are_told(tmp_path):
    one = keep(tmp_path / "one", RUNOUTS, statuses=[Status.reached_wall, *[Status.slid] * 11])
    other = keep(tmp_path / "other", RUNOUTS[:10], 'receptor=[{name="road", x="42 m"}, {name="house", x="46 m"}]')
    data = xr.load_dataset(other / "results.nc", decode_timedelta=False)
    data["receptor"] = ("receptor", np.array(["road", "house"], dtype=object))
    data.attrs["realization_sha256"] = "0" * 64
    data.to_netcdf(other / "results.nc")
    given = compare([one, other])
    told = " ".join(doubts(given))
    assert given.receptors == ("road",)
    for words in ("12 in one, 10 in other", "another version", "1 of the 10", "Straße, house"):
        assert words in told


def test_a_difference_from_slides_cut_short_has_one_bound(tmp_path):
    """The wall stopped 4 of 12 in the other campaign: what they would change of it is at least so large."""
    free = keep(tmp_path / "free", RUNOUTS, reaches=[1] * 4 + [0] * 8)
    statuses = [*[Status.reached_wall] * 4, *[Status.slid] * 8]
    walled = keep(tmp_path / "walled", RUNOUTS - 2.0, STRONGER, statuses=statuses, reaches=[1] * 12)
    given = compare([free, walled])
    found = by_words(given, 9.0)
    plain = mean_difference(RUNOUTS, RUNOUTS - 2.0, 0.95)
    closed = {words for words, difference in found.items() if np.isfinite(difference.interval.upper)}
    assert closed == {words for words in found if words.startswith("P(")}  # which 4 of 12 leave a bound
    beyond, cut = RUNOUTS - 2.0 > 9.0, np.arange(12) < 4
    share, all_of_them = (proportion_difference(RUNOUTS > 9.0, which, 0.95) for which in (beyond, beyond | cut))
    exceeded = found["P(run-out above 9 m)"]
    assert exceeded[:2] == share[:2]
    assert exceeded.interval[:3] == (share.interval.estimate, share.interval.lower, all_of_them.interval.upper)
    assert (exceeded.first_is_least, exceeded.other_is_least) == (False, True)
    assert not any(each.other_is_least for words, each in found.items() if "reaches" in words)  # all are there
    mean = found["mean run-out, 0 without a slide"]
    assert mean.interval.lower == pytest.approx(plain.interval.lower)
    told = " ".join(as_text(given, measures(given, [9.0]), doubts(given)).split())
    # N
    assert f"at least {RUNOUTS.mean() - 2.0:.2f} m at least -2.00 m at least {mean.interval.lower:+.2f}" in told
    back = " ".join(as_text(compare([walled, free]), measures(compare([walled, free]), []), []).split())
    assert f"at least {RUNOUTS.mean() - 2.0:.2f} m {RUNOUTS.mean():.2f} m at most +2.00 m at most +2.00" in back
    assert doubts(given) == [
        "In walled the wall ahead stopped 4 of the 12 realizations: there the run-out is a lower bound, and so are the "
        "numbers of walled that are told as at least so much."
    ]


def test_a_median_without_a_slide_is_no_lower_bound_whatever_stopped_the_slides(tmp_path):
    """8 of 12 do not slide, and the wall stopped the others: the median is 0 m, not at least 0 m."""
    statuses = [*[Status.no_slide] * 8, *[Status.reached_wall] * 4]
    stands = keep(tmp_path / "stands", RUNOUTS, statuses=statuses)
    found = by_words(compare([stands, keep(tmp_path / "free", RUNOUTS, STRONGER)]))
    median = found["median of run-out, 0 without a slide"]
    assert (median.first, median.first_is_least) == (0.0, False)
    assert found["95 % quantile of run-out, 0 without a slide"].first_is_least


def test_the_wall_behind_the_crest_bounds_the_volume_alone(tmp_path):
    one, other = keep(tmp_path / "one", RUNOUTS), keep(tmp_path / "other", RUNOUTS, STRONGER)
    data = xr.load_dataset(other / "results.nc", decode_timedelta=False)
    data["reached_wall_behind"].values[:5] = 1
    data.to_netcdf(other / "results.nc")
    given = compare([one, other])
    least = {words for words, each in by_words(given, 9.0).items() if each.other_is_least}
    assert least == {"mean sliding volume, 0 without a slide"}
    behind, volume = doubts(given)
    assert behind.startswith("In other 5 of the 12 realizations reach the wall behind the crest, which disturbs their")
    assert volume.startswith("The sliding volume of other is a lower bound")


def test_between_two_campaigns_cut_short_a_difference_is_open(tmp_path):
    statuses = [*[Status.not_settled] * 6, *[Status.slid] * 6]
    both = [keep(tmp_path / name, RUNOUTS, *over, statuses=statuses) for name, over in (("a", []), ("b", [STRONGER]))]
    given = compare(both)
    (mean,) = [
        each for each in as_text(given, measures(given, []), []).split("\n") if each.startswith("mean run-out, 0")
    ]
    assert "open" in mean
    assert mean.count("at least") == 2
    assert "slides of a and b that were cut short are drawn as far as they came." in draw_comparison(given).caption


def test_receptors_of_one_name_at_two_places_are_told_apart(tmp_path):
    """As far from the toe is the same place, as where the crest is longer; another distance and another x is not."""
    one, other = keep(tmp_path / "one", RUNOUTS), keep(tmp_path / "other", RUNOUTS)
    data = xr.load_dataset(other / "results.nc", decode_timedelta=False)
    data["receptor_x_bounds"] = data["receptor_x_bounds"] + 10.0
    data.attrs["toe_x"] += 10.0
    data.to_netcdf(other / "results.nc")
    assert compare([one, other]).receptors == ("road", "Straße")
    data.attrs["toe_x"] -= 5.0
    data.to_netcdf(other / "results.nc")
    given = compare([one, other])
    assert given.receptors == ()
    assert doubts(given) == [
        "Left out is road, which is another place in each campaign: x = 42 m in one, x = 52 m in other.",
        "Left out is Straße, which is another place in each campaign: x = 45 to 47 m in one, x = 55 to 57 m in other.",
    ]


def test_what_cannot_be_compared_is_refused(two, tmp_path):
    failed = keep(tmp_path / "failed", RUNOUTS, statuses=[Status.crashed] * 12)
    for directories, words in (
        (two[:1], "two or more"),
        ((*two, two[0]), "more than once"),
        ((two[0], failed), "failed has 0 realizations with a result"),
        ((two[0], tmp_path), "holds no results.nc"),
    ):
        with pytest.raises(RefusalError, match=words):
            compare(directories)


@pytest.fixture
def command(two, tmp_path, monkeypatch):
    """Return what runs the command on two campaigns, in an empty directory."""
    monkeypatch.setattr(cli, "_pin_threads", lambda: None)
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    return lambda *options: cli.main(["compare", *map(str, two), *options])


def test_the_command_prints_writes_and_draws(command, capsys, tmp_path):
    assert command("--distance", "9 m", "--distance", "1100 cm") == 0
    told = capsys.readouterr().out
    for words in (
        "strong against weak, 10 realizations",
        "22 kPa instead of 20 kPa",
        "P(run-out above 11 m)",
        "Note: ",
    ):
        assert words in told
    assert "<svg" in (tmp_path / "here" / "comparison" / "comparison.svg").read_text("utf-8")
    data = xr.load_dataset(tmp_path / "here" / "comparison" / "comparison.nc")
    assert dict(data.sizes) == {
        "scenario": 2,
        "realization": 10,
        "receptor": 2,
        "quantile": 2,
        "distance": 2,
        "bound": 2,
    }
    assert data.runout_mean_given_all_slide_difference.sel(scenario="strong") == pytest.approx(-2.0)
    assert data.exceedance.sel(distance=9.0, scenario="weak") == np.mean(RUNOUTS[1:11] > 9.0)
    assert np.isnan(data.runout_mean_difference.sel(scenario="weak"))
    for name, stored in data.data_vars.items():
        assert stored.attrs["long_name"], name
        assert stored.attrs["units"], name


def test_a_comparison_is_written_again_and_never_over_a_campaign(command, two, capsys):
    assert command() == command() == 0
    before = (two[0] / "results.nc").read_bytes()
    assert command("--out", str(two[0])) == 2
    assert "holds a campaign" in capsys.readouterr().err
    assert (two[0] / "results.nc").read_bytes() == before
    assert not (two[0] / "comparison.nc").exists()


def test_another_comparison_is_not_written_over(command, two, capsys, tmp_path):
    assert command() == 0
    file = tmp_path / "here" / "comparison" / "comparison.nc"
    before = file.read_bytes()
    assert cli.main(["compare", str(two[1]), str(two[0])]) == 2
    assert "compares weak with strong and is left as it is; give another --out." in capsys.readouterr().err
    assert file.read_bytes() == before
    assert cli.main(["compare", str(two[1]), str(two[0]), "--out", "turned"]) == 0


def test_a_distance_without_unit_is_refused(command, capsys):
    assert command("--distance", "12") == 2
    assert '--distance is "12", but a length needs its unit' in capsys.readouterr().err
