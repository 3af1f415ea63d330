"""The answer as a picture: the slope, how far slides come, what they leave, and the places asked about."""

from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from campaign.report import estimates
from campaign.report.distances import Curve
from campaign.report.figures.deposit import deposit_of, draw_deposit
from campaign.report.figures.exceedance import draw_curve
from campaign.report.figures.labels import highest, place_labels, write_labels
from campaign.report.figures.marks import draw_total_intervals, marks
from campaign.report.figures.section import Section
from campaign.report.figures.style import BLACK, BLUE, Illustration
from campaign.results.results import Results
from campaign.scene.first_look import look_at
from campaign.statistics.intervals import Sample
from campaign.statistics.total import has_mesh_error
from campaign.statistics.wording import least
from campaign.terminal import counted

LEFT, RIGHT, BELOW, ABOVE, GAP, STRIP = 0.62, 0.12, 0.45, 0.3, 0.12, 0.85
"""Margins, the gap between the panels, and the height of the upper one, in inches."""

WIDE: Final = 10.0
"""Width in inches on a desk; on a telephone it is that of a column."""


class Panels(NamedTuple):
    """The figure with the probability of being reached, if anything slides, above the section."""

    figure: Figure
    section: Axes
    strip: Axes | None


def overview(results: Results, curve: Curve, section: Section, width: float) -> Illustration:
    """Draw the section with all that the first screen says of it, `width` inches wide."""
    scale = (width - LEFT - RIGHT) / section.right
    deposit, labels = deposit_of(results, section.surface), marks(results, section, width >= WIDE)
    placed = place_labels(labels, deposit.clear, scale, section.right)
    section = replace(section, top=max(section.top, highest(placed, scale)))
    panels = _panels(section, width, results.outcomes.slides > 0)
    draw_deposit(panels.section, deposit, section, results.outcomes.slides > 0)
    section.frame(panels.section)
    panels.section.set_xlabel("distance (m)")
    draw_total_intervals(panels.section, results, section)
    if not results.outcomes.slides:
        _circle(panels.section, results)
    write_labels(panels.section, placed, scale)
    if panels.strip is not None:
        _reach(panels.strip, results, curve, section)
    handles, names = panels.section.get_legend_handles_labels()
    columns = len(names) if width >= WIDE else 2
    panels.figure.legend(handles, names, loc="upper right", ncols=columns, borderaxespad=0.1, columnspacing=1.0)
    return Illustration(panels.figure, _caption(results), _alt(results, section))


def _circle(axes: Axes, results: Results) -> None:
    """Draw where a slope that has not slid comes nearest to it."""
    circle = look_at(results.scene).peak
    if circle is not None:
        x = np.linspace(circle.entry, circle.exit, 200)
        label = f"critical circle with the mean strength, factor of safety {circle.factor:.2f} (Bishop)"
        axes.plot(x, circle.elevation(x), color=BLUE, linestyle=(0, (5, 3)), linewidth=1.2, label=label)


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


def _reach(axes: Axes, results: Results, curve: Curve, section: Section) -> None:
    """Draw how probable it is that a slide gets as far, and where each of them stopped."""
    toe = section.surface.toe[0]
    draw_curve(axes, curve, "", toe)
    _ticks(axes, toe + results.slide_runouts)
    axes.set(xlim=(0, section.right), ylim=(0, 1.05), yticks=[0, 0.5, 1], xticklabels=[])
    axes.set_ylabel("reached (%)")
    section.mark_receptors(axes, 1.05)
    axes.text(0.01 * section.right, 0.5, "how probable it is that\na slide gets as far", color=BLUE, va="center")


def _ticks(axes: Axes, places: Sample) -> None:
    """Mark places (m) on the axis, by one line with gaps: a line for each would be half of a large figure."""
    x = np.repeat(places, 3)
    y = np.tile([0.0, 0.09, np.nan], places.size)
    axes.plot(x, y, color=BLACK, linewidth=0.6, alpha=0.6)


def _caption(results: Results) -> str:
    slides = results.outcomes.slides
    if not slides:
        text = "The slope, which did not slide in any realization, with its critical circle and the places asked about."
        return f"{text}{_layers(results)}"
    cut_short = results.outcomes.cut_short
    ended = f", {cut_short:,} of them cut short before they did" if cut_short else ""
    return (
        f"Upper part: the probability, with its {100 * results.confidence:g} % interval by sampling, that a slide gets "
        f"as far from the toe; every tick is where one of {counted(slides, 'slide')} stopped{ended}. Lower part: "
        f"the ground before (dashed) and after the slides. Bars in the ground: the intervals of where half and 95 % "
        f"stop{_mesh(results)}.{_layers(results)}"
    )


def _layers(results: Results) -> str:
    """Say what dotted lines are."""
    return " Dotted, here and in what follows: tops of layers." if results.scene.layer else ""


def _mesh(results: Results) -> str:
    """Say what the bars hold."""
    mesh = "sampling and mesh" if has_mesh_error(results.discretisation) else "sampling"
    return f", for {mesh}"


def _alt(results: Results, section: Section) -> str:
    if not results.outcomes.slides:
        return "Cross-section of the slope, which has not slid."
    reach = estimates.quantile_runout(results, 0.5)
    x = section.surface.toe[0] + reach.estimate
    return (
        f"Cross-section of the slope; half of the slides stop within {least(reach)}{reach.estimate:.1f} m of the toe, "
        f"at x = {x:.1f} m."
    )
