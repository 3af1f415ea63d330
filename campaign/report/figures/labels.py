"""Names of places in a cross-section, written in the sky where they do not run into each other."""

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from campaign.report.figures.svg import on_hover
from campaign.simulation.solver_model import Array

Clear = Callable[[Array], Array]
"""Returns the elevation in m above which there is nothing but sky."""

LETTER: Final = 0.078
"""Width of a letter in inches."""

LINE: Final = 0.19
"""Height of a line in inches."""

UNDER_TEXT: Final = {"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.85}
"""What keeps a label readable where the line of another one crosses it."""


class Label(NamedTuple):
    """What is written about a place: `x`, `y` in m is where its line begins."""

    x: float
    y: float
    text: str
    colour: str
    hover: str


class Placed(NamedTuple):
    """A label with its room: `left`, `right`, and `bottom` in m."""

    label: Label
    left: float
    right: float
    bottom: float
    alignment: str


def place_labels(labels: Sequence[Label], clear: Clear, scale: float, right: float) -> list[Placed]:
    """Find room in the sky for each label, where `scale` inches are one metre and text may go on to `right` (m).

    Text goes to the right of its place, over the lines of those beyond. Where there is no room for it, it goes to the
    left, and so does that of places before, as far as it would lie in the way of such a line.
    """
    ends = {label: label.x + _width(label, scale) for label in labels}
    leftmost, to_the_left = right, []
    for label in sorted(labels, key=lambda each: -each.x):
        if ends[label] > leftmost:
            to_the_left.append(label)
            leftmost = label.x
    to_the_right = [label for label in labels if label not in to_the_left]
    ordered = [*sorted(to_the_right, key=lambda each: -each.x), *reversed(to_the_left)]
    placed: list[Placed] = []
    for label in ordered:
        placed.append(_find(label, clear, scale, right, placed, "right" if label in to_the_left else "left"))
    return placed


def highest(placed: Sequence[Placed], scale: float) -> float:
    """Return the elevation in m that labels take up."""
    return max((each.bottom + LINE / scale for each in placed), default=0.0)


def write_labels(axes: Axes, placed: Sequence[Placed], scale: float) -> None:
    """Write labels where there is room for them, and join them to their places."""
    for label, _, _, bottom, alignment in placed:
        line = axes.vlines(label.x, label.y, bottom, color=label.colour, linewidth=1.0)
        x = label.x + (0.04 / scale if alignment == "left" else -0.04 / scale)
        text = axes.text(x, bottom, label.text, color=label.colour, ha=alignment, va="bottom", fontsize=9, zorder=5)
        text.set_bbox(UNDER_TEXT)
        axes.plot(label.x, label.y, "o", color=label.colour, markersize=3.5)
        on_hover(line, label.hover)
        on_hover(text, label.hover)


def _find(label: Label, clear: Clear, scale: float, right: float, taken: Sequence[Placed], alignment: str) -> Placed:
    """Return the lowest line in the sky that is free, for text that is aligned at its left or right end."""
    width, line = _width(label, scale), LINE / scale
    left = label.x if alignment == "left" else label.x - width
    over = np.linspace(max(left, 0.0), min(left + width, right), 20)
    place = Placed(label, left, left + width, float(clear(over).max()) + 0.7 * line, alignment)
    while any(_overlap(place, other, line) for other in taken):
        place = place._replace(bottom=place.bottom + 0.25 * line)
    return place


def _width(label: Label, scale: float) -> float:
    """Return the width of a label's text in m."""
    return (LETTER * len(label.text) + 0.08) / scale


def _overlap(one: Placed, other: Placed, line: float) -> bool:
    """Whether the text of a label would run into another one, or into the line from there to its place."""
    beside = one.right < other.left or other.right < one.left
    is_crossed = one.left < other.label.x < one.right and one.bottom < other.bottom
    return is_crossed or (not beside and abs(one.bottom - other.bottom) < line)
