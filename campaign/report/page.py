"""`campaign report`: figures, and one page that needs nothing but itself."""

from functools import partial
from pathlib import Path
from typing import Any

import jinja2
import numpy as np

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.report import distances, headline, inputs, movement, places
from campaign.report.answer import answer, outcomes
from campaign.report.chapters import appendix, chapters
from campaign.report.choices import modelling_choices
from campaign.report.distances import Curve, Curves
from campaign.report.drawing import Plan, draw_all
from campaign.report.error_budget import error_budget
from campaign.report.figures.domains import GAP
from campaign.report.figures.overview import WIDE, overview
from campaign.report.figures.section import Section, section_of
from campaign.report.figures.style import COLUMN, in_style
from campaign.report.film import SHAPE, Film, films, screen_of
from campaign.report.moving import LEVELS
from campaign.report.provenance import doubts_about, provenance
from campaign.report.replays import Replays, replays
from campaign.report.reservations import reasons_for_doubt
from campaign.report.wording import unbroken
from campaign.results.results import Results, read_results
from campaign.scene.first_look import look_at
from campaign.statistics.total import has_mesh_error
from campaign.storage.layout import FIGURES, REPORT
from campaign.terminal import counted, say


def write_report(directory: Path, simulate: bool = True) -> Path:
    """Draw the figures of a finished campaign and write its page.

    Parameters
    ----------
    directory : Path
        Of the campaign. Its `figures/` receive one SVG each.
    simulate : bool
        Whether to simulate again the slides to draw that are not kept there.

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
    remarks = doubts_about(directory, results)
    for remark in remarks:
        say(remark)
    replayed, differences = replays(results, directory, simulate)
    page = directory / REPORT
    try:
        with in_style():
            text = render(results, replayed, [*remarks, *differences], directory / FIGURES)
        write_atomically(page, text.encode())
    except OSError as error:
        raise RefusalError(f"The report cannot be written ({error}); make room in {directory}, or copy it.") from error
    return page


def render(results: Results, replayed: Replays | None, remarks: list[str], figures: Path) -> str:
    """Return the page as HTML; its figures are kept in a directory, too."""
    curves = distances.curves_of(results)
    section = section_of(results.scene, np.append(results.runouts, results.deterministic))
    ordered = [
        (chapter, draw_all(chapter.plans, figures)) for chapter in chapters(results, curves.all, section, replayed)
    ]
    return _template().render(
        _first_screen(results, curves.all, section, figures) | _tables(results, curves),
        doubts=[*reasons_for_doubt(results), *remarks],
        chapters=ordered,
        films=_films(replayed, section),
        film_shape=SHAPE,
        film_levels=LEVELS,
        film_gap=GAP,
        screen=screen_of(section),
        appendix=draw_all(appendix(results), figures),
    )


def _first_screen(results: Results, curve: Curve, section: Section, figures: Path) -> dict[str, Any]:
    plans = [
        Plan(name, "", partial(overview, results, curve, section, width))
        for name, width in (("overview", WIDE), ("overview-narrow", COLUMN))
    ]
    return {
        "title": results.scene.title,
        "tiles": headline.tiles(results),
        "reaches": headline.reaches(results),
        "what_intervals_hold": headline.what_intervals_hold(results),
        "overview": draw_all(plans, figures) if results.outcomes.usable else [],
        "answer": answer(results),
        "verdict": results.data.attrs["verdict"],
        "realizations": results.realizations,
        "confidence": f"{100 * results.confidence:g} %",
        "slides": results.outcomes.slides,
    }


def _tables(results: Results, curves: Curves) -> dict[str, Any]:
    slides, peak = results.outcomes.slides, look_at(results.scene).peak
    return {
        "factor": None if peak is None else f"{peak.factor:.2f}",
        "movement": movement.movement(results) if slides else movement.stillness(results),
        "distances": distances.table(curves),
        "distance_data": distances.data(curves) if slides else {},
        "toe": f"{results.data.attrs['toe_x']:g}",
        "sometimes": 0 < slides < results.outcomes.usable,
        "places": places.places(results) if slides else [],
        "ended_or_was_there": places.ended_or_was_there(results) if slides and results.scene.receptor else "",
        "budget": error_budget(results),
        "has_mesh_error": results.outcomes.slides > 0 and has_mesh_error(results.discretisation),
        "input_sentences": inputs.sentences(results),
        "effects": inputs.effect_rows(results),
        "properties": inputs.property_tables(results),
        "choices": modelling_choices(results.scene),
        "outcomes": outcomes(results),
        "scene": results.data.attrs["scene"],
        "overrides": results.data.attrs["scene_overrides"],
        "provenance": provenance(results),
    }


def _films(replayed: Replays | None, section: Section) -> list[Film]:
    return films(replayed, section) if replayed is not None else []


def _template() -> jinja2.Template:
    loader = jinja2.PackageLoader("campaign.report")
    environment = jinja2.Environment(
        loader=loader, autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"unbroken": unbroken, "counted": counted}
    return environment.get_template("report.html.jinja")
