"""What is marked in the overview: toe and crest, how far half and 95 % of the slides come, and the receptors."""

from typing import Final

import numpy as np
from matplotlib.axes import Axes

from campaign.report import estimates
from campaign.report.figures.labels import Label
from campaign.report.figures.section import Section
from campaign.report.figures.style import BLACK, BLUE, ORANGE
from campaign.report.places import Reach, reach_estimates
from campaign.report.wording import bounds
from campaign.results.results import Results
from campaign.statistics.wording import chances, estimated_chance, least

STOPS: Final = {0.5: "half", estimates.FAR: f"{100 * estimates.FAR:g} %"}
"""Shares of the slides whose reach is marked."""


def marks(results: Results, section: Section, has_room: bool) -> list[Label]:
    """Return labels of toe and crest, of where slides stop, and of the receptors; short ones without room."""
    stops = _stops(results, section, " stop before" if has_room else " stop")
    return [*_ends(section), *stops, *_receptors(results, section)]


def _ends(section: Section) -> list[Label]:
    surface = section.surface
    crest_y = float(surface.height_at(np.array([surface.crest_x]))[0])
    ends = {"toe": surface.toe} | ({"crest": (surface.crest_x, crest_y)} if surface.crest_x < surface.toe[0] else {})
    return [Label(x, y, name, BLACK, f"{name} at {x:.4g} m") for name, (x, y) in ends.items()]


def _stops(results: Results, section: Section, words: str) -> list[Label]:
    """Return labels where half and 95 % of the slides have stopped, with short or long words."""
    toe_x, toe_y = section.surface.toe
    if not results.outcomes.slides:
        return []
    marks = []
    for share, name in STOPS.items():
        reach = estimates.total_quantile(results, share)
        told = f"{name} stop within {least(reach)}{reach.estimate:.2f} m from the toe, {bounds(reach, 'm', '.2f')}"
        label = name + words.replace(" before", ": at least here" if reach.is_least else " before")
        marks.append(Label(toe_x + reach.estimate, toe_y, label, BLUE, told))
    return marks if results.outcomes.slides > 1 else []


def draw_total_intervals(axes: Axes, results: Results, section: Section) -> None:
    """Draw the total intervals of where half and 95 % of the slides stop, as far as they are known, in the ground."""
    if results.outcomes.slides < 2:
        return
    toe_x, toe_y = section.surface.toe
    for share, depth in zip(STOPS, (0.04, 0.075), strict=True):
        reach = estimates.total_quantile(results, share)
        low, high = (bound if np.isfinite(bound) else reach.estimate for bound in (reach.lower, reach.upper))
        y = toe_y - depth * section.top
        axes.plot([toe_x + low, toe_x + high], [y, y], color=BLUE, linewidth=2.5, solid_capstyle="butt")
        axes.plot([toe_x + reach.estimate] * 2, [toe_y, y], color=BLUE, linewidth=1.0)


def _receptors(results: Results, section: Section) -> list[Label]:
    near = {receptor.name: receptor.x[0] for receptor in results.scene.receptor}
    return [_receptor(each, near[each.front.receptor], section) for each in reach_estimates(results)]


def _receptor(each: Reach, near: float, section: Section) -> Label:
    ground, front = float(section.surface.height_at(np.array([near]))[0]), each.front
    share, name = estimated_chance(front.interval), front.receptor
    told = f"probability that the slide's front reaches {name}: {share} ({chances(front.interval)})"
    words = f"{name}: {share}"
    if each.is_pushed_farther:
        moved = estimated_chance(each.moved.interval)
        told, words = f"{told}; that any moved ground does: {moved}", f"{words}, moved ground {moved}"
    return Label(near, ground, words, ORANGE, told)
