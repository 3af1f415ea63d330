"""The order of the page: its chapters and the figures of each."""

from functools import partial
from typing import NamedTuple

from campaign.report.distances import Curve
from campaign.report.drawing import Plan
from campaign.report.figures.configurations import configurations
from campaign.report.figures.convergence import convergence
from campaign.report.figures.curves import curves
from campaign.report.figures.exceedance import exceedance
from campaign.report.figures.extremes import extremes
from campaign.report.figures.ground import influence
from campaign.report.figures.histogram import histogram
from campaign.report.figures.inputs import ranking
from campaign.report.figures.receptor_histories import histories
from campaign.report.figures.section import Section
from campaign.report.figures.sensitivity import sensitivity
from campaign.report.figures.strengths import strengths
from campaign.report.inputs import effect_rows, property_tables
from campaign.report.replays import RANKS, Replays
from campaign.results.results import Results

MEAN = "The slide with mean strengths"


class Chapter(NamedTuple):
    """A chapter: the name of its template (`NAME.html.jinja`), its title and its figures."""

    name: str
    title: str
    plans: list[Plan]


def chapters(results: Results, curve: Curve, section: Section, replayed: Replays | None) -> list[Chapter]:
    """Return the chapters of the page; one with neither text nor figures is left out."""
    slides = results.outcomes.slides > 0
    distances = [_distances(results, curve)] if slides else []
    inputs = _inputs(results, section)
    single = _single(section, replayed)
    return [
        Chapter(
            "movement", "Where the ground moves and stops" if slides else "The ground", _movement(results, section)
        ),
        *distances,
        Chapter("budget", "How sure the answer is", []),
        *([Chapter("inputs", "Which inputs matter", inputs)] if inputs else []),
        *([Chapter("single", "Single slides", single)] if single else []),
    ]


def appendix(results: Results) -> list[Plan]:
    """Return the figures of the appendix."""
    return [Plan("convergence", "Convergence", lambda: convergence(results))] if results.outcomes.slides else []


def _movement(results: Results, section: Section) -> list[Plan]:
    has_moved = bool(results.data["influence_probability"].values.max() > 0)
    influenced = Plan("influence", "How probable it is that the ground moves", lambda: influence(results, section))
    over_time = Plan("curves", "Run-out over time", lambda: curves(results))
    return [influenced] * has_moved + [over_time] * (results.outcomes.slides > 0)


def _distances(results: Results, curve: Curve) -> Chapter:
    at_places = [
        Plan(f"receptor-{number}", f"Over time: {receptor.name}", partial(histories, results, receptor.name))
        for number, receptor in enumerate(results.scene.receptor, start=1)
    ]
    plans = [
        Plan("exceedance", "Probability of a longer run-out", lambda: exceedance(results, curve)),
        Plan("histogram", "Distribution of the run-out", lambda: histogram(results)),
        *at_places,
    ]
    return Chapter("distances", "How far, and what arrives", plans)


def _inputs(results: Results, section: Section) -> list[Plan]:
    """Return the figures on which inputs matter; without anything to say of them the chapter is left out."""
    if not effect_rows(results) and not property_tables(results):
        return []
    return [
        Plan("ranking", "Which inputs matter", lambda: ranking(results)),
        Plan("sensitivity", "Where strong ground matters", lambda: sensitivity(results, section)),
    ]


def _single(section: Section, replayed: Replays | None) -> list[Plan]:
    if replayed is None:
        return []
    ground, ranked = replayed.ground, replayed.ranked
    plans = [
        Plan(
            "configurations",
            MEAN,
            lambda: configurations(section, ground, replayed.deterministic),
        )
    ]
    if not ranked:
        return plans
    called = {slide.realization: rank for rank, slide in ranked.items()}
    different = {rank: ranked[rank] for rank in RANKS if rank in called.values()}
    return [
        *plans,
        Plan("extremes", "Shortest, median and longest slide", lambda: extremes(section, ground, different)),
        Plan("strengths", "A typical field of strength", lambda: strengths(section, ground, ranked["median"])),
    ]
