"""The answer as a picture: the slope, how far slides come, what they leave, and the places asked about."""

from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from campaign.report import estimates
from campaign.report.distances import exceedance_curve
from campaign.report.figures.deposit import deposit_of, draw_deposit
from campaign.report.figures.exceedance import draw_curve
from campaign.report.figures.labels import Label, highest, place_labels, write_labels
from campaign.report.figures.section import Section
from campaign.report.figures.style import BLACK, BLUE, ORANGE, Illustration
from campaign.report.places import reach_estimates
from campaign.report.wording import bounds
from campaign.results.results import Results
from campaign.statistics.receptors import ReceptorEstimate
from campaign.statistics.total import has_mesh_error
from campaign.statistics.wording import chance, chances

LEFT, RIGHT, BELOW, ABOVE, GAP, STRIP = 0.62, 0.12, 0.45, 0.3, 0.12, 0.85
"""Margins, the gap between the panels, and the height of the upper one, in inches."""

WIDE: Final = 10.0
"""Width in inches on a desk; on a telephone it is that of a column."""


STOPS: Final = {0.5: "half", estimates.FAR: f"{100 * estimates.FAR:g} %"}
"""Shares of the slides whose reach is marked."""


class Panels(NamedTuple):
    """The figure with the probability of being reached, if anything slides, above the section."""

    figure: Figure
    section: Axes
    strip: Axes | None


def overview(results: Results, section: Section, width: float) -> Illustration:
    """Draw the section with all that the first screen says of it, `width` inches wide."""
    scale = (width - LEFT - RIGHT) / section.right
    deposit, marks = deposit_of(results, section.surface.width), _marks(results, section, width >= WIDE)
    placed = place_labels(marks, deposit.clear, scale, section.right)
    section = replace(section, top=max(section.top, highest(placed, scale)))
    panels = _panels(section, width, results.outcomes.slides > 0)
    draw_deposit(panels.section, deposit, results.outcomes.slides > 0)
    section.frame(panels.section)
    panels.section.set_xlabel("distance (m)")
    _total_intervals(panels.section, results, section)
    write_labels(panels.section, placed, scale)
    if panels.strip is not None:
        _reach(panels.strip, results, section)
    handles, labels = panels.section.get_legend_handles_labels()
    columns = len(labels) if width >= WIDE else 2
    panels.figure.legend(handles, labels, loc="upper right", ncols=columns, borderaxespad=0.1, columnspacing=1.0)
    return Illustration(panels.figure, _caption(results), _alt(results, section))


def _panels(section: Section, width: float, has_slides: bool) -> Panels:
    inner, above = width - LEFT - RIGHT, ABOVE if width >= WIDE else 2.3 * ABOVE
    drawing, strip = inner * section.panel_height, STRIP + GAP if has_slides else 0.0
    height = BELOW + drawing + strip + above
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((LEFT / width, BELOW / height, inner / width, drawing / height))
    if not has_slides:
        return Panels(figure, axes, None)
    box = (LEFT / width, (BELOW + drawing + GAP) / height, inner / width, STRIP / height)
    return Panels(figure, axes, figure.add_axes(box))


def _reach(axes: Axes, results: Results, section: Section) -> None:
    """Draw how probable it is that a slide gets as far, and where each of them stopped."""
    toe = section.surface.toe[0]
    draw_curve(axes, exceedance_curve(results), "", toe)
    axes.vlines(toe + results.slide_runouts, 0.0, 0.09, color=BLACK, linewidth=0.6, alpha=0.6)
    axes.set(xlim=(0, section.right), ylim=(0, 1.05), yticks=[0, 0.5, 1], xticklabels=[])
    axes.set_ylabel("reached (%)")
    section.mark_receptors(axes, 1.05)
    axes.text(0.01 * section.right, 0.5, "how probable it is that\na slide gets as far", color=BLUE, va="center")


def _marks(results: Results, section: Section, has_room: bool) -> list[Label]:
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
        told = f"{name} stop before {reach.estimate:.2f} m from the toe, {bounds(reach, 'm', '.2f')}"
        marks.append(Label(toe_x + reach.estimate, toe_y, name + words, BLUE, told))
    return marks if results.outcomes.slides > 1 else []


def _total_intervals(axes: Axes, results: Results, section: Section) -> None:
    """Draw the total intervals of where half and 95 % of the slides stop, as far as they are known, in the ground."""
    if results.outcomes.slides < 2:
        return
    toe_x, toe_y = section.surface.toe
    for share, depth in zip(STOPS, (0.04, 0.075), strict=True):
        reach = estimates.total_quantile(results, share)
        low, high = (reach.estimate if np.isnan(bound) else bound for bound in (reach.lower, reach.upper))
        y = toe_y - depth * section.top
        axes.plot([toe_x + low, toe_x + high], [y, y], color=BLUE, linewidth=2.5, solid_capstyle="butt")
        axes.plot([toe_x + reach.estimate] * 2, [toe_y, y], color=BLUE, linewidth=1.0)


def _receptors(results: Results, section: Section) -> list[Label]:
    near = {receptor.name: receptor.x[0] for receptor in results.scene.receptor}
    return [_receptor(each, near[each.receptor], section) for each in reach_estimates(results)]


def _receptor(each: ReceptorEstimate, near: float, section: Section) -> Label:
    ground = float(section.surface.height_at(np.array([near]))[0])
    share = chance(each.interval.estimate)
    told = f"probability that a slide reaches {each.receptor}: {share} ({chances(each.interval)})"
    return Label(near, ground, f"{each.receptor}: {share}", ORANGE, told)


def _caption(results: Results) -> str:
    slides = results.outcomes.slides
    if not slides:
        return "The slope, which did not slide in any realization, with its toe and the places asked about."
    return (
        f"Upper part: the probability, with its {100 * results.confidence:g} % interval by sampling, that a slide gets "
        f"as far from the toe; every tick is where one of the {slides} slides stopped. Lower part: the ground before "
        f"(dashed) and after the slides. Bars in the ground: the intervals of where half and 95 % stop{_mesh(results)}."
    )


def _mesh(results: Results) -> str:
    """Say by how much the marks differ from what was counted."""
    found = results.discretisation
    if found is None or not has_mesh_error(found):
        return ""
    return f", moved by the {found.interval.estimate:+.2f} m that half the cell changes"


def _alt(results: Results, section: Section) -> str:
    if not results.outcomes.slides:
        return "Cross-section of the slope, which has not slid."
    median = estimates.quantile_runout(results, 0.5).estimate
    return f"Cross-section of the slope; half of the slides stop within {median:.1f} m of the toe, at x = " + (
        f"{section.surface.toe[0] + median:.1f} m."
    )
