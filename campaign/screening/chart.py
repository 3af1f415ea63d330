"""What each choice changes, with its interval, beside what does not matter; the largest effect on top."""

from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from campaign.report.figures.style import BLACK, GREEN, ORANGE, Illustration, in_style
from campaign.screening.screening import Screened, Screening
from campaign.screening.verdict import Effect, Verdict
from campaign.terminal import counted

COLOURS = {Verdict.KEEP: ORANGE, Verdict.DROP: GREEN, Verdict.OPEN: "#5f5f5f"}
MARKERS = "osD^v<>pP*"

WIDE, ROW, OVERHEAD = 8.2, 0.42, 1.3
"""Inches that the chart is wide, and that a choice and the rest of it take from top to bottom."""

LEFT, RIGHT = 0.31, 0.71
"""Shares of the width between which the panels are, with names and verdicts beside them."""

NAME = 32
"""Characters of a line of a name."""

SPREAD = 0.56
"""Of a row, over which the numbers of a choice are drawn below each other."""

VIEW = 3.0
"""Tolerances to either side that are drawn; beyond, an arrow says how far an estimate is."""

UNITS = {"m": (1.0, "change of run-out (m)", "+.1f"), "1": (100.0, "change (points)", "+.0f")}
"""By the unit of an effect: its factor, the label of its axis, and its format."""


def draw(found: Screening, path: Path) -> None:
    """Write the chart as a PNG."""
    with in_style():
        chart(found).figure.savefig(path)


def chart(found: Screening) -> Illustration:
    """Draw the changes of mean and standard deviation, and beside them those of probabilities."""
    alone = [each for each in found.ranked if each.effects]
    rows = [each for each in found.rows if each.effects]
    height = OVERHEAD + ROW * len(rows)
    figure = Figure(figsize=(WIDE, height))
    panels = figure.subplots(1, 2, sharey=True, width_ratios=(1.5, 1.0))
    top, bottom = 1 - 0.65 / height, 0.5 / height
    figure.subplots_adjust(left=LEFT, right=RIGHT, top=top, bottom=bottom, wspace=0.08)
    for axes, unit in zip(panels, UNITS, strict=True):
        _draw_panel(axes, rows, unit)
        axes.axhline(len(alone) - 0.5, color=BLACK, linewidth=0.5)
    _name(panels, rows, found)
    n = counted(len(found.own.runouts), "realization")
    confidence = 100 * found.scene.campaign.confidence
    caption = (
        f"What changes when a choice of the scene is replaced, from {n} of each. Lines: {confidence:g} % intervals; "
        f"band: what does not matter, {found.tolerances}. {found.advice}"
    )
    verdicts = ", ".join(f"{each.choice.name} {each.verdict}" for each in rows)
    return Illustration(figure, caption, f"Changes with intervals and verdicts: {verdicts}.")


def _draw_panel(axes: Axes, rows: Sequence[Screened], unit: str) -> None:
    """Draw the effects of one unit."""
    factor, label, _ = UNITS[unit]
    effects = [[effect for effect in each.effects if effect.unit == unit] for each in rows]
    first = effects[0] if effects else []
    tolerance = factor * max((effect.tolerance for effect in first), default=1.0)
    axes.axvspan(-tolerance, tolerance, color=GREEN, alpha=0.12, linewidth=0)
    axes.axvline(0.0, color=BLACK, linewidth=0.8)
    axes.set(xlim=(-VIEW * (tolerance or 1.0), VIEW * (tolerance or 1.0)), xlabel=label)
    shifts = SPREAD * (np.arange(len(first)) + 0.5) / max(len(first), 1) - SPREAD / 2
    for place, (each, numbers) in enumerate(zip(rows, effects, strict=True)):
        for effect, shift, marker in zip(numbers, shifts, cycle(MARKERS), strict=False):
            _draw_effect(axes, effect, place + shift, marker, COLOURS[each.verdict])
    for effect, marker in zip(first, cycle(MARKERS), strict=False):
        axes.plot([], [], marker, color=BLACK, markersize=4, label=effect.words.partition(",")[0])
    axes.legend(loc="lower left", bbox_to_anchor=(-0.04, 1.0), fontsize=8, handletextpad=0.2, borderaxespad=0.2)


def _draw_effect(axes: Axes, effect: Effect, place: float, marker: str, colour: str) -> None:
    factor, _, digits = UNITS[effect.unit]
    estimate, lower, upper = (factor * value for value in effect.difference.interval[:3])
    left, right = axes.get_xlim()
    axes.plot(np.clip([lower, upper], left, right), [place, place], color=colour, linewidth=1.4)
    if left <= estimate <= right:
        axes.plot([estimate], [place], marker, color=colour, markersize=4)
        return
    edge, side = (right, "right") if estimate > right else (left, "left")
    inside = edge - 0.06 * (right - left) * np.sign(edge)
    axes.annotate("", (edge, place), (inside, place), arrowprops={"arrowstyle": "->", "color": colour})
    axes.text(inside, place, f" {estimate:{digits}} ", ha=side, va="center", fontsize=8, color=BLACK)


def _name(panels: Sequence[Axes], rows: Sequence[Screened], found: Screening) -> None:
    """Write the choices to the left, and to the right the verdicts, with what remains of the cost."""
    first, last = panels
    names = [fill(each.name.replace("->", "→"), NAME) for each in rows]
    first.set_yticks(range(len(rows)), names, fontsize=8)
    first.set_ylim(len(rows) - 0.4, -0.6)
    for axes in panels:
        axes.tick_params(axis="y", length=0)
    for place, each in enumerate(rows):
        told = ", ".join(filter(None, [f"cost × {found.cost(each):.2g}", each.reason]))
        _write(last, place, 4.0, str(each.verdict), COLOURS[each.verdict], fontsize=8, weight="bold")
        _write(last, place, -5.0, told, BLACK, fontsize=6.5)


def _write(axes: Axes, place: int, above: float, words: str, colour: str, **font: Any) -> None:
    """Write words to the right of a row, so many points above its middle."""
    at = (1.03, place), (0, above), axes.get_yaxis_transform(), "offset points"
    axes.annotate(words, *at, va="center", color=colour, **font)
