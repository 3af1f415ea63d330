"""`campaign report`: figures, and one page that needs nothing but itself."""

import base64
import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import jinja2
import numpy as np

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.report.answer import answer, outcomes, reasons_for_doubt
from campaign.report.error_budget import error_budget, modelling_choices
from campaign.report.figures import distribution, ground, precision, slides
from campaign.report.figures.section import Section, section_of
from campaign.report.figures.style import Illustration, NotDrawableError, in_style
from campaign.report.snapshots import ReplayedSlide, replay
from campaign.results.results import Results, read_results
from campaign.seeds import BASELINE
from campaign.simulation.ground import Ground, prepare
from campaign.storage.access import check_digest
from campaign.storage.layout import FIGURES, REPORT

TIMES = (0.0, 3.0, 5.0)
"""Seconds after release at which the paper shows the deterministic slide, besides its end."""

NUMBER_AND_UNIT = re.compile(r"(?<=\d) (?=%|(?:m|s)\b)")

RANKS = {"shortest": 0.0, "median": 0.5, "longest": 1.0}
"""The slides to look at, and the share of run-outs below theirs."""


class Drawn(NamedTuple):
    """A figure on the page, or the sentence that says why it is not there."""

    title: str
    caption: str
    alt: str = ""
    image: str = ""


class Plan(NamedTuple):
    """A figure to come: the name of its file, its title on the page, and what draws it."""

    name: str
    title: str
    draw: Callable[[], Illustration]


class Replays(NamedTuple):
    """The slides simulated again for the figures."""

    ground: Ground
    deterministic: ReplayedSlide
    ranked: dict[str, ReplayedSlide]


def write_report(directory: Path) -> Path:
    """Draw the figures of a finished campaign and write its page.

    Parameters
    ----------
    directory : Path
        Of the campaign. Its `figures/` receive one PNG each.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    RefusalError
        When there are no results, or the report cannot be written.
    """
    results = read_results(directory)
    replayed, remarks = _replayed(results, directory)
    page = directory / REPORT
    try:
        with in_style():
            drawn = [_draw(plan, directory / FIGURES) for plan in _plans(results, replayed)]
        write_atomically(page, render(results, drawn, remarks).encode())
    except OSError as error:
        raise RefusalError(f"The report cannot be written ({error}); make room in {directory}, or copy it.") from error
    return page


def render(results: Results, drawn: list[Drawn], remarks: list[str]) -> str:
    """Return the page as HTML."""
    return _template().render(
        title=results.scene.title,
        answer=answer(results),
        verdict=results.data.attrs["verdict"],
        doubts=[*reasons_for_doubt(results), *remarks],
        budget=error_budget(results),
        choices=modelling_choices(results.scene),
        confidence=f"{100 * results.confidence:g} %",
        outcomes=outcomes(results),
        realizations=results.realizations,
        figures=drawn,
        scene=results.data.attrs["scene"],
        overrides=results.data.attrs["scene_overrides"],
        provenance=provenance(results),
    )


def unbroken(text: str) -> str:
    """Keep numbers and their units on one line."""
    return NUMBER_AND_UNIT.sub("\u00a0", text)


def provenance(results: Results) -> dict[str, str]:
    """Return the dataset's attributes about its making, by what a reader would call them."""
    told_elsewhere = {"title", "verdict", "scene", "scene_overrides", "Conventions"}
    attributes = {name: value for name, value in results.data.attrs.items() if name not in told_elsewhere}
    return {str(name).replace("_", " "): str(value) for name, value in attributes.items() if str(value)}


def _template() -> jinja2.Template:
    loader = jinja2.PackageLoader("campaign.report")
    environment = jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    environment.filters["unbroken"] = unbroken
    return environment.get_template("report.html.jinja")


def _replayed(results: Results, directory: Path) -> tuple[Replays | None, list[str]]:
    """Simulate the slides to draw again; without them the page has fewer figures and a sentence."""
    try:
        replayed = _replays(results, directory)
    except RefusalError as refusal:
        return None, [str(refusal)]
    except Exception as error:
        return None, [f"The slides could not be simulated again for the figures ({error!r})."]
    return replayed, _differences(results, replayed)


def _replays(results: Results, directory: Path) -> Replays:
    check_digest(results.scene, results.data.attrs["scene_sha256"])
    ground = prepare(results.scene, directory)
    seen: dict[int, ReplayedSlide] = {}
    for rank in RANKS.values() if results.outcomes.slides else ():
        realization = results.ranked(rank)
        if realization not in seen:
            seen[realization] = replay(ground, realization)
    ranked = {called: seen[results.ranked(rank)] for called, rank in RANKS.items()} if seen else {}
    return Replays(ground, replay(ground, BASELINE, TIMES), ranked)


def _differences(results: Results, replayed: Replays) -> list[str]:
    drawn = {slide.realization: slide for slide in (replayed.deterministic, *replayed.ranked.values())}
    different = [
        "the deterministic run" if realization == BASELINE else f"realization {realization}"
        for realization, slide in drawn.items()
        if not np.array_equal(slide.record.values["final_runout"], results.final_runout(realization), equal_nan=True)
    ]
    if not different:
        return []
    return [
        f"Replayed, {', '.join(different)} did not come out exactly as recorded: the solver, a library or the "
        "kind of processor has changed since the campaign ran."
    ]


def _plans(results: Results, replayed: Replays | None) -> list[Plan]:
    section = section_of(results.scene, np.append(results.runouts, results.deterministic))
    return [
        Plan("curves", "Run-out over time", lambda: distribution.curves(results)),
        Plan("histogram", "Distribution of the run-out", lambda: distribution.histogram(results)),
        Plan("exceedance", "Probability of exceedance", lambda: distribution.exceedance(results)),
        Plan("convergence", "Convergence", lambda: precision.convergence(results)),
        Plan("influence", "Where the ground moves", lambda: ground.influence(results, section)),
        Plan("configurations", "The deterministic slide", lambda: _configurations(section, _needed(replayed))),
        Plan("strengths", "A typical field of strength", lambda: _strengths(section, _needed(replayed))),
        Plan("outcomes", "Shortest, median and longest slide", lambda: _outcomes(section, _needed(replayed))),
    ]


def _needed(replayed: Replays | None) -> Replays:
    if replayed is None:
        raise NotDrawableError("The slides could not be simulated again; the reason is among the doubts.")
    return replayed


def _ranked(replayed: Replays) -> dict[str, ReplayedSlide]:
    if not replayed.ranked:
        raise NotDrawableError("No realization slid, so there is none to show.")
    return replayed.ranked


def _configurations(section: Section, replayed: Replays) -> Illustration:
    return slides.configurations(section, replayed.deterministic)


def _strengths(section: Section, replayed: Replays) -> Illustration:
    return slides.strengths(section, replayed.ground, _ranked(replayed)["median"])


def _outcomes(section: Section, replayed: Replays) -> Illustration:
    called = {slide.realization: rank for rank, slide in _ranked(replayed).items()}
    return slides.outcomes(section, {rank: replayed.ranked[rank] for rank in RANKS if rank in called.values()})


def _draw(plan: Plan, directory: Path) -> Drawn:
    path = directory / f"{plan.name}.png"
    try:
        illustration = plan.draw()
    except NotDrawableError as reason:
        path.unlink(missing_ok=True)
        return Drawn(plan.title, str(reason))
    directory.mkdir(exist_ok=True)
    illustration.figure.savefig(path)
    image = base64.b64encode(path.read_bytes()).decode()
    return Drawn(plan.title, illustration.caption, illustration.alt, image)
