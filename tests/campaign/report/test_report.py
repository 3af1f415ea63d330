"""The page says what the dataset says, needs nothing but itself, and is made of whatever results there are."""

import base64
import re
from html.parser import HTMLParser

import numpy as np
import pytest
import xarray as xr
from small_campaign import conclude, made_up, run, small_scene

from campaign.errors import RefusalError
from campaign.record import Status
from campaign.report import page as report
from campaign.report.answer import answer
from campaign.report.error_budget import error_budget
from campaign.report.figures import style
from campaign.report.page import write_report
from campaign.report.snapshots import replay
from campaign.report.summary import summary
from campaign.results.results import Results, read_results
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare

PNG = b"\x89PNG\r\n\x1a\n"
FIGURES = 8


class Page(HTMLParser):
    """Text, images and references of a page."""

    def __init__(self, path):
        super().__init__()
        self.text, self.images, self.references, self.tags = "", [], [], []
        self.feed(path.read_text("utf-8"))
        self.text = re.sub(r"\s+", " ", self.text.replace("\u00a0", " "))

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        given = dict(attributes)
        if tag == "img":
            self.images.append(given)
        self.references += [value for name, value in attributes if name in ("src", "href", "srcset", "data", "action")]

    def handle_data(self, data):
        self.text += data


@pytest.fixture(autouse=True, scope="module")
def coarse():
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(style.STYLE, "figure.dpi", 30)
        yield


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    directory = tmp_path_factory.mktemp("campaign")
    run(directory, small_scene("campaign.realizations=12"))
    return directory


@pytest.fixture(scope="module")
def ground():
    return prepare(small_scene())


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
        mean, (lower, upper) = float(data["mean"][-1]), data["mean_ci"][-1].values
        std = np.sqrt(float(data["variance"][-1]))
        deterministic = float(data["deterministic_final_runout"])
        shortest, longest = float(data["final_runout"].min()), float(data["final_runout"].max())
        exceeding = float((data["final_runout"] > data["deterministic_final_runout"]).mean())
    assert f"The slide runs {mean:.2f} ± {(upper - lower) / 2:.2f} m on average" in page.text
    assert f"{lower:.2f} to {upper:.2f} m" in page.text
    assert f"a standard deviation of {std:.2f} m" in page.text
    assert f"the shortest ran {shortest:.2f} m, the longest {longest:.2f} m" in page.text
    assert f"it would run {deterministic:.2f} m, which {100 * exceeding:.0f} % of the slides exceed" in page.text


def test_the_last_words_on_the_terminal_are_those_of_the_page(page, campaign):
    results = read_results(campaign)
    words = re.sub(r"\s+", " ", summary(results))
    assert answer(results) in words
    assert answer(results) in page.text
    for row in error_budget(results):
        assert f"{row.source} {row.quantity}: {row.value} ({row.interval})" in words
        assert f"{row.source}{row.quantity}{row.value}{row.interval}{row.n}" in page.text


def test_every_figure_is_there_with_words(page, campaign):
    assert len(page.images) == FIGURES
    assert "left out" not in page.text
    kept = {path.read_bytes() for path in (campaign / "figures").glob("*.png")}
    for image in page.images:
        picture = base64.b64decode(image["src"].removeprefix("data:image/png;base64,"))
        assert picture.startswith(PNG)
        assert picture in kept
        assert len(image["alt"]) > 20


def test_the_drawn_slides_are_the_recorded_ones(page):
    assert "exactly as recorded" not in page.text


def test_the_runout_in_a_drawing_is_the_recorded_one_whatever_counts_as_a_slide():
    """No particle moves 8 m in 3 s, so nothing is a slide here; with the paper's 0.1 m the run-out would be 3.2 m."""
    ground = prepare(small_scene("slide.displaced=8 m", "slide.failed=9 m", "numerics.end_time=3 s"))
    seen = replay(ground, BASELINE)
    assert seen.end.runout == seen.record.values["final_runout"] == 0.0


def test_the_page_needs_nothing_from_outside(page):
    assert all(reference.startswith("data:") for reference in page.references)
    assert not {"script", "link", "iframe"} & set(page.tags)


def test_scene_and_provenance_are_on_the_page(page):
    assert "[soil.softening]" in page.text
    assert "numerics.cell=2 m" in page.text
    assert "realization sha256" in page.text
    assert "numpy version" in page.text


@pytest.mark.parametrize("n", [1, 4])
def test_few_realizations_give_a_page(tmp_path, ground, n):
    page = made_up_page(tmp_path, ground, list(9.0 + 0.1 * np.arange(n)))
    assert ("It takes more of them" in page.text) == (n == 1)
    assert len(page.images) == FIGURES - (2 if n == 1 else 0) - 1


def test_no_slide_at_all(tmp_path, ground):
    page = made_up_page(tmp_path, ground, [0.0] * 12, [Status.no_slide] * 12)
    assert "No answer: none of the 12 realizations" in page.text
    assert len(page.images) == 2  # where the ground moves, the deterministic slide


def test_nothing_but_failures(tmp_path, ground):
    page = made_up_page(tmp_path, ground, [np.nan] * 12, [Status.crashed] * 12, baseline=Status.diverged)
    assert "failed: crashed" in page.text
    assert "a reason <b>&" in page.text
    assert "All realizations failed" in page.text


def test_some_failures_are_bounded(tmp_path, ground):
    """Of 12 one failed and 10 of the other 11 exceed 9.0 m: 10/12 to 11/12."""
    statuses = [Status.crashed, *[Status.not_settled] * 2, *[Status.slid] * 9]
    page = made_up_page(tmp_path, ground, [np.nan, 8.0, *(9.1 + 0.1 * np.arange(10))], statuses)
    assert "1 failed" in page.text
    assert "83 to 92 %" in page.text
    assert "2 of the 11 run-outs are lower bounds" in page.text


def test_convergence_is_told(tmp_path, ground):
    runouts = list(np.random.default_rng(1).normal(9.0, 0.5, 24))
    loose = ["campaign.mean_tolerance=0.5", "campaign.variance_tolerance=0.9"]
    page = made_up_page(tmp_path, ground, runouts, overrides=loose)
    assert "The campaign converged at" in page.text
    assert "did not come out exactly as recorded" in page.text


def test_a_discretisation_error_is_used_where_it_is_known(campaign):
    """Student's t of 95 % and 2 degrees of freedom is 4.303: 1 +- 4.303 0.5 / sqrt(3)."""
    results = read_results(campaign)
    assert "errors of the mesh and of the model are not among them" in answer(results)
    pairs = {
        "paired_difference": ("pair", [0.5, 1.0, np.nan, 1.5]),
        "deterministic_paired_difference": ((), 0.7),
    }
    known = Results(results.data.assign(pairs), results.scene)
    assert "the mesh adds about 1.00 m to that of the mean (half the cell changes it by +1.00 ± 1.24 m)" in (
        answer(known)
    )
    assert error_budget(known)[-2][2:] == ("1.00 m (+1.00 m)", "-0.24 to +2.24 m", "3")


def test_without_a_simulation_the_other_figures_are_drawn(campaign, monkeypatch):
    def fail(_scene, _directory):
        raise RuntimeError("out of order")

    monkeypatch.setattr(report, "prepare", fail)
    page = Page(write_report(campaign))
    assert len(page.images) == FIGURES - 3
    assert page.text.count("could not be simulated again") == 4
    assert "out of order" in page.text


def test_without_results_there_is_no_page(tmp_path):
    with pytest.raises(RefusalError, match=r"holds no results\.nc"):
        write_report(tmp_path)
