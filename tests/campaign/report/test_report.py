"""The page says what the dataset says, needs nothing but itself, and is made of whatever results there are."""

import json
import re
import shutil
from html.parser import HTMLParser

import numpy as np
import pytest
import xarray as xr
from scipy import stats
from small_campaign import conclude, made_up, run, small_scene

from campaign.errors import RefusalError
from campaign.record import LOWER_BOUND, Status
from campaign.report import page as page_module
from campaign.report import replays
from campaign.report.answer import answer
from campaign.report.error_budget import error_budget
from campaign.report.figures.extremes import extremes
from campaign.report.figures.section import section_of
from campaign.report.figures.style import in_style
from campaign.report.page import write_report
from campaign.report.provenance import doubts_about
from campaign.report.snapshots import FRAMES, replay
from campaign.report.summary import summary
from campaign.report.wording import number
from campaign.results.results import Results, read_results
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from campaign.statistics.intervals import mean_interval

FIGURES = 10
"""Of a campaign that slides, without receptors: the overview twice, and both films counted apart."""

FILMS = 2


class Page(HTMLParser):
    """Text, figures, references and data of a page."""

    def __init__(self, path):
        super().__init__()
        self.text, self.figures, self.references, self.tags, self.data = "", [], [], [], []
        self.source = path.read_text("utf-8")
        self._is_script = False
        self.feed(self.source)
        self.text = re.sub(r"\s+", " ", self.text.replace("\u00a0", " "))

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        given = dict(attributes)
        if tag == "svg":
            self.figures.append(given["aria-label"])
        self._is_script = tag in ("script", "style")
        if given.get("type") == "application/json":
            self.data.append("")
        self.references += [
            value
            for name, value in attributes
            if name in ("src", "href", "xlink:href", "srcset", "data", "action") and not value.startswith("#")
        ]

    def handle_data(self, data):
        if not self._is_script:
            self.text += data
        elif self.data and not self.data[-1]:
            self.data[-1] = data


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    directory = tmp_path_factory.mktemp("campaign")
    run(directory, small_scene("campaign.realizations=12"))
    return directory


@pytest.fixture(scope="module")
def ground():
    return prepare(small_scene())


@pytest.fixture
def without_replays(monkeypatch):
    """For pages whose words alone are of interest."""
    monkeypatch.setattr(page_module, "replays", lambda *_arguments: (None, []))


@pytest.fixture(scope="module")
def page(campaign):
    return Page(write_report(campaign))


def made_up_page(directory, ground, runouts, statuses=None, baseline=Status.slid, overrides=()):
    statuses = statuses or [Status.slid] * len(runouts)
    scene = small_scene(f"campaign.realizations={len(runouts)}", *overrides)
    records = [made_up(ground, BASELINE, 9.0, baseline)]
    for k, (runout, status) in enumerate(zip(runouts, statuses, strict=True)):
        records.append(made_up(ground, k, runout, status, "a reason <b>&" if status is Status.crashed else ""))
    conclude(directory, scene, ground, records)
    return Page(write_report(directory))


def test_the_numbers_are_the_datasets(page, campaign):
    with xr.open_dataset(campaign / "results.nc") as data:
        mean, (lower, upper) = float(data.runout_mean[-1]), data.runout_mean_ci[-1].values
        std = np.sqrt(float(data.runout_variance[-1]))
        deterministic = float(data.deterministic_final_runout_mass)
        slides = data.final_runout_mass[data.slid]
        shortest, longest = float(slides.min()), float(slides.max())
        exceeding = float((data.final_runout_mass[data.usable] > deterministic).mean())
        cut_short = bool(np.isin(data.status.values, list(LOWER_BOUND)).any())
        at_rest = int(data.deterministic_status) == Status.slid
    least, bounds = ("at least ", f"at least {lower:.2f} m") if cut_short else ("", f"{lower:.2f} to {upper:.2f} m")
    words = f"{mean:.2f} m on average, {bounds} with 95 % confidence"
    assert f"The slide runs {least}{words}" in page.text
    assert f"sampling ±{(upper - lower) / 2:.2f} m; what the mesh adds is not estimated" in page.text
    assert f"a standard deviation of {std:.2f} m" in page.text
    assert f"the shortest ran {shortest:.2f} m, the longest {least}{longest:.2f} m" in page.text
    assert at_rest
    assert f"would run {deterministic:.2f} m; {100 * exceeding:.0f} % of all realizations run farther" in page.text


def test_the_probability_of_a_slide_comes_first(page, campaign):
    """12 of 12 at 95 % confidence: at least 0.025^(1/12)."""
    least = f"{100 * 0.025 ** (1 / 12):.0f} %"
    assert answer(read_results(campaign)).startswith(
        f"12 of 12 realizations slid: the probability of a slide is at least {least} (95 % confidence). The slide runs"
    )
    first = error_budget(read_results(campaign))[0]
    assert (first.quantity, first.value, first.n) == ("probability of a slide", "100 %", "12")


def test_the_last_words_on_the_terminal_are_those_of_the_page(page, campaign):
    results = read_results(campaign)
    words = re.sub(r"\s+", " ", summary(results))
    assert answer(results) in words
    assert answer(results) in page.text
    for row in error_budget(results):
        assert f"{row.source} {row.quantity}: {row.value} ({row.interval})" in words
        assert f"{row.source}{row.quantity}{row.value}{row.interval}{row.n}" in page.text


def test_every_figure_is_there_with_words(page, campaign):
    assert len(page.figures) == FIGURES + FILMS
    assert "Left out" not in page.text
    kept = [path.read_text("utf-8") for path in (campaign / "figures").glob("*.svg")]
    assert len(kept) == FIGURES
    assert all(svg in page.source for svg in kept)
    assert all(len(alt) > 20 for alt in page.figures)


def test_the_chapters_stand_in_their_order(page):
    """What matters of the inputs has its place between the error budget and the single slides, once it is known."""
    titles = [
        "Where the ground moves and stops",
        "How far, and what arrives",
        "How sure the answer is",
        "Single slides",
    ]
    places = [page.text.index(f"{number}. {title}") for number, title in enumerate(titles, start=1)]
    assert places == sorted(places)
    assert "Which inputs matter" not in page.text
    assert places[-1] < page.text.index("Appendix")


def test_the_first_screen_has_the_answer_before_the_words(page):
    first = page.text[: page.text.index("1. Where")]
    assert re.search(r"Probability of a slide ?at least 74 %", first)
    assert re.search(r"Half of the fronts stop within ?(at least )?\d+\.\d m", first)
    assert re.search(r"95 % stop within ?(at least )?\d+\.\d m ?at least", first)


def test_the_films_hold_each_frame_of_each_area(page):
    """Places are two numbers of two bytes, shapes four bytes, a colour one; base64 makes four letters of three."""
    films = json.loads(page.data[1])
    assert len(films) == FILMS
    for film in films:
        areas = len(film["levels"]) // 4 * 3 // FRAMES
        assert areas > 100
        assert len(film["captions"]) == FRAMES
        assert len(film["places"]) == pytest.approx(4 * len(film["levels"]), abs=8)
        assert len(film["shapes"]) == pytest.approx(4 * len(film["levels"]), abs=8)
    assert len(page.source) < 3e6


def test_the_drawn_slides_are_the_recorded_ones(page):
    assert "exactly as recorded" not in page.text


def test_the_runout_in_a_drawing_is_the_recorded_one_whatever_counts_as_a_slide():
    """No particle moves 8 m in 3 s, so nothing is a slide here; with the paper's 0.1 m the run-out would be 3.2 m."""
    ground = prepare(small_scene("slide.displaced=8 m", "slide.failed=9 m", "numerics.end_time=3 s"))
    seen = replay(ground, BASELINE)
    assert seen.end.runout == seen.record.values["final_runout"] == 0.0


def test_the_runout_below_a_drawing_of_a_slide_cut_short_is_at_least_so_much():
    """At 4 s the front is on its way."""
    scene = small_scene("numerics.end_time=4 s")
    ground = prepare(scene)
    seen = replay(ground, BASELINE)
    assert seen.record.status is Status.not_settled
    with in_style():
        drawn = extremes(section_of(scene, [seen.end.runout]), ground, {"only": seen})
    assert f"the only (at least {seen.end.runout:.2f} m) run-out" in drawn.caption


def test_the_page_needs_nothing_from_outside(page):
    assert all(reference.startswith("data:") for reference in page.references)
    assert not {"link", "iframe", "img"} & set(page.tags)
    assert not re.search(r"\b(?:fetch|import|XMLHttpRequest|eval)\b\(", page.source)


def test_scene_and_provenance_are_on_the_page(page):
    assert "[soil.softening]" in page.text
    assert "numerics.cell=2 m" in page.text
    assert "realization sha256" in page.text
    assert "numpy version" in page.text


@pytest.mark.usefixtures("without_replays")
@pytest.mark.parametrize(("n", "lacking"), [(1, 3), (4, 1)])
def test_few_realizations_give_a_page(tmp_path, ground, n, lacking):
    """One slide has neither curve nor distribution nor convergence, and few have no convergence."""
    page = made_up_page(tmp_path, ground, list(9.0 + 0.1 * np.arange(n)))
    assert ("It takes two slides or more to say how sure" in page.text) == (n == 1)
    assert page.text.count("Left out") == lacking
    assert len(list((tmp_path / "figures").glob("*.svg"))) == FIGURES - lacking - 4  # no map, as no ground moved


@pytest.mark.usefixtures("without_replays")
def test_one_has_no_plural_anywhere(tmp_path, ground):
    page = made_up_page(tmp_path, ground, [9.0], [Status.not_settled])
    terminal = summary(read_results(tmp_path))
    for text in (page.text, *page.figures, terminal):
        assert re.findall(r"\b1 (slides|realizations|results|run-outs|simulated slopes|times|pairs)\b", text) == []
    assert "How 1 realization ended" in terminal


def test_no_slide_in_few_realizations_is_not_yet_an_answer(tmp_path, ground):
    page = made_up_page(tmp_path, ground, [0.0] * 12, [Status.no_slide] * 12)
    assert "0 of 12 realizations slid, so the probability of a slide is at most 26 % (95 % confidence)." in page.text
    assert "It takes 36 without a slide to bound it by 10 %" in page.text  # 0.025^(1/36) = 0.903
    assert "none slid, so the probability of a slide is at most 26 %; 36 without a slide bound it by 10 %" in page.text


def test_a_slope_that_does_not_slide_is_an_answer(tmp_path, ground):
    """0 of 40 is at most 8.8 %; a single row of the budget needs a slide, and none is empty."""
    page = made_up_page(tmp_path, ground, [0.0] * 60, [Status.no_slide] * 60, Status.no_slide, ["campaign.block=20"])
    assert "It does not slide: 0 of 40 realizations slid, so the probability of a slide is at most 8.8 %" in page.text
    assert "With mean strengths everywhere it does not slide either." in page.text
    assert "About 368 realizations without a slide bound it by 1 %" in page.text
    assert "critical circle with the mean strength, factor of safety 0.73" in page.text
    budget = error_budget(read_results(tmp_path))
    assert [row.quantity for row in budget if row.source == "Discretisation"] == ["probability of a slide, by the mesh"]
    assert "sampling converged at 40 realizations: none slid" in page.text
    assert not re.search(r"\bnan\b", page.text + summary(read_results(tmp_path)))
    assert "No answer" not in page.text
    budget = {row.quantity: row.value for row in error_budget(read_results(tmp_path))}
    assert budget["probability of a slide"] == "0 %"
    assert budget["created or lost, of the energy released"] == "no slide"
    assert "mean run-out of a slide, sampling alone" not in budget
    assert "Left out" not in page.text
    assert len(page.figures) == 2  # the slope, for wide and for narrow screens
    assert "largest movement of any ground" in page.text
    assert "How far" not in page.text


@pytest.mark.usefixtures("without_replays")
def test_a_slope_that_slides_sometimes_gives_both_exceedances(tmp_path, ground):
    """Of 40 realizations 18 slide and 14 run farther than the deterministic 9 m: 35 %, 78 % of the slides."""
    runouts = [*np.linspace(8.0, 8.9, 4), *np.linspace(9.1, 12.0, 14), *[0.4] * 22]
    page = made_up_page(tmp_path, ground, runouts, [Status.slid] * 18 + [Status.no_slide] * 22)
    assert "18 of 40 realizations slid: the probability of a slide is 45 %, 29 to 62 % (95 % confidence)" in page.text
    assert "m on average where it slides" in page.text
    assert "it would run 9.00 m; 35 % of all realizations run farther (21 to 52 %), 78 % of those that sli" in page.text
    words = summary(read_results(tmp_path))
    assert words.startswith("18 of 40 realizations slid")


@pytest.mark.usefixtures("without_replays")
def test_a_wall_makes_lower_bounds_and_is_told(tmp_path, ground):
    """8 of 20 slides go beyond 9 m, and 3 that a wall has stopped may have: exact bounds of 8/20 and 11/20."""
    runouts = [*[8.0] * 9, *[10.0] * 8, *[7.5] * 3]
    page = made_up_page(tmp_path, ground, runouts, [Status.slid] * 17 + [Status.reached_wall] * 3)
    assert "nothing bounds the mean from above: the wall ahead of the slope stopped 3 of 20 slides." in page.text
    assert re.search(
        r"Read with care\s+The wall ahead of the slope stopped 3 of 20 slides, which would have come", page.text
    )
    assert "40 % of all realizations run farther (19 to 77 %)" in page.text


@pytest.mark.usefixtures("without_replays")
def test_nothing_but_failures(tmp_path, ground):
    page = made_up_page(tmp_path, ground, [np.nan] * 12, [Status.crashed] * 12, baseline=Status.diverged)
    assert "failed: crashed" in page.text
    assert "No answer: 10 realizations, and none with a result. a reason" in page.text
    assert error_budget(read_results(tmp_path))[0].value == "no realization with a result"
    assert "a reason <b>&" in page.text
    assert page.figures == []


@pytest.mark.usefixtures("without_replays")
def test_some_failures_are_bounded(tmp_path, ground):
    """Of 12 one failed, one still moved at 8 m, and 10 exceed 9.0 m: 10/12 to 1. All 11 slid: 11/12 to 1."""
    statuses = [Status.crashed, *[Status.not_settled] * 2, *[Status.slid] * 9]
    page = made_up_page(tmp_path, ground, [np.nan, 8.0, *(9.1 + 0.1 * np.arange(10))], statuses)
    assert "1 failed" in page.text
    rows = [row for row in error_budget(read_results(tmp_path)) if row.source == "Failures"]
    assert [row[2:] for row in rows] == [
        ("1 failed", "at least 91.7 %", "12"),
        ("1 failed, 1 cut short", "at least 83 %", "12"),
    ]
    assert (
        "The fronts of 2 of 11 slides may have come farther after the end of the run (numerics.end_time)" in page.text
    )


def test_convergence_is_told(tmp_path, ground):
    runouts = list(np.random.default_rng(1).normal(9.0, 0.5, 24))
    loose = ["campaign.mean_tolerance=0.5", "campaign.variance_tolerance=0.9"]
    page = made_up_page(tmp_path, ground, runouts, overrides=loose)
    assert "Verdict: sampling converged at" in page.text
    assert "did not come out exactly as recorded" in page.text


def test_a_discretisation_error_is_used_where_it_is_known(campaign):
    """Student's t of 95 % and 2 degrees of freedom is 4.303: 1 +- 4.303 0.5 / sqrt(3)."""
    results = read_results(campaign)
    pairs = {
        "paired_difference": ("pair", [0.5, 1.0, np.nan, 1.5]),
        "deterministic_paired_difference": ((), 0.7),
        "status": ("realization", np.full(12, int(Status.slid))),  # with one cut short there is no upper bound
    }
    known = Results(results.data.assign(pairs), results.scene)
    mean, change = mean_interval(results.slide_runouts, 0.95), stats.t.ppf(0.975, 2) * 0.5 / np.sqrt(3)
    upper = mean.estimate + 2.0 + np.hypot(mean.half_width, 2 * change)
    assert f"{mean.estimate:.2f} m on average, {mean.lower:.2f} to {upper:.2f} m with 95 %" in answer(known)
    assert "half the cell changes it by +1.00 ± 1.24 m, and the interval holds up to twice that" in answer(known)
    rows = {row.source: row for row in error_budget(known)}
    assert rows["Discretisation"][2:] == ("+1.00 m", "-0.24 to +2.24 m", "3")
    assert rows["Total"].quantity == "mean run-out of a slide, sampling and mesh"


def test_the_release_protocol_is_a_line_of_the_budget(campaign):
    results = read_results(campaign)
    other = {
        "other_release_final_runout": ((), 20.0),
        "other_release_final_runout_mass": ((), results.deterministic * 1.06),
        "other_release_status": ((), int(Status.slid)),
    }
    known = Results(results.data.assign(other), results.scene)
    row = next(row for row in error_budget(known) if row.source == "Release")
    assert row.value == f"{0.06 * results.deterministic:+.2f} m (+6.0 %)"
    assert (
        row.interval
        == f'{results.deterministic:.2f} m with "release", {1.06 * results.deterministic:.2f} m with "ramp"'
    )


def test_results_of_an_older_format_are_refused_with_the_way_to_new_ones(campaign, tmp_path):
    with xr.open_dataset(campaign / "results.nc") as data:
        data.assign_attrs(format=1).to_netcdf(tmp_path / "results.nc")
    with pytest.raises(RefusalError, match=r"is of format 1, .* campaign run .* --allow-drift makes it again"):
        read_results(tmp_path)


def test_without_a_simulation_the_other_figures_are_drawn(campaign, monkeypatch):
    def fail(_scene, _directory):
        raise RuntimeError("out of order")

    monkeypatch.setattr(replays, "prepare", fail)
    page = Page(write_report(campaign))
    assert len(page.figures) == FIGURES - 3
    assert page.text.count("could not be simulated again") == 1
    assert "out of order" in page.text
    assert "4. Single slides" not in page.text


@pytest.mark.usefixtures("without_replays")
def test_a_damaged_manifest_is_told(campaign, tmp_path, capsys):
    shutil.copy(campaign / "results.nc", tmp_path)
    (tmp_path / "manifest.json").write_text("{")
    page = Page(write_report(tmp_path))
    for told in (page.text, capsys.readouterr().out):
        assert "manifest.json is damaged" in told
        assert "made of results.nc alone" in told


def test_a_manifest_of_another_scene_is_told(campaign):
    results = read_results(campaign)
    other = Results(results.data.assign_attrs(scene_sha256="0"), results.scene)
    assert doubts_about(campaign, results) == []
    assert "of another scene" in doubts_about(campaign, other)[0]


def test_without_results_there_is_no_page(tmp_path):
    with pytest.raises(RefusalError, match=r"holds no results\.nc"):
        write_report(tmp_path)


@pytest.fixture(scope="module")
def with_road(tmp_path_factory):
    directory = tmp_path_factory.mktemp("road")
    road = 'receptor=[{name="road <b>",x="42 m"},{name="far",x=["60 m","62 m"]}]'
    run(directory, small_scene(road, "campaign.realizations=3", "numerics.end_time=7 s"))
    return directory


def test_the_terminal_tells_the_probability_that_a_slide_reaches_a_place(with_road):
    results = read_results(with_road)
    reached = int(results.data.front_reaches.sel(receptor="road <b>").sum())
    assert f"probability that the slide's front reaches it: {100 * reached / 3:.0f} % (" in summary(results)


@pytest.mark.usefixtures("without_replays")
def test_the_page_tells_what_comes_to_a_place(with_road):
    results, page = read_results(with_road), Page(write_report(with_road))
    road = results.data.sel(receptor="road <b>")
    depth = float(road.receptor_max_depth.where(road.front_reaches == 1).median())
    assert re.search(rf"largest flow depth ?(at least )?{number(depth, 'm')}", page.text)
    assert "road <b> (x = 42 m)" in page.text
    assert "far (x = 60 to 62 m)" in page.text
    assert "No slide has reached it" in page.text
    assert "Over time: road <b>" in page.text
    first = page.text[: page.text.index("1. Where")]
    assert re.search(r"far ?0 % ?at most 71 %", first)
