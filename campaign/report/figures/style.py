"""One look for all figures: legible at the width of a page, in colours that everyone can tell apart."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

WIDTH = 7.0
"""Of a figure that stands alone, in inches: the text width of a page."""

COLUMN = 5.0
"""Of a figure in a column of the report, in inches; at this width its text is legible on a telephone as well."""

# The palette of Okabe and Ito (2008).
BLUE, ORANGE, GREEN, GREY, BLACK = "#0072B2", "#D55E00", "#009E73", "#8c8c8c", "#000000"

WATER = "#3a8fb7"
"""A water table."""

STILL = "#d3d3d3"
"""Ground that has not moved."""

STYLE: dict[Any, Any] = {
    "font.size": 10,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "legend.frameon": False,
    "legend.fontsize": 9,
    "lines.linewidth": 1.6,
    "figure.dpi": 150,
    "savefig.facecolor": "white",
    "axes.grid": False,
}


class NotDrawableError(Exception):
    """A figure cannot be drawn from these results; the message is a sentence for the page."""


class Illustration(NamedTuple):
    """A figure with its words.

    Attributes
    ----------
    figure : Figure
    caption : str
        What one sees, and how many realizations it rests on.
    alt : str
        The same for whoever cannot see it, in a sentence.
    """

    figure: Figure
    caption: str
    alt: str


@contextmanager
def in_style() -> Iterator[None]:
    """Draw and save figures inside this."""
    with mpl.rc_context(STYLE):
        yield


def new_figure(height: float, rows: int = 1, width: float = WIDTH, **keywords: Any) -> tuple[Figure, list[Axes]]:
    """Return an empty figure, `height` and `width` in inches, and its panels from top to bottom."""
    figure = Figure(figsize=(width, height), layout="compressed")
    panels = figure.subplots(rows, squeeze=False, **keywords)
    return figure, list(panels[:, 0])


def letter(panels: list[Axes], titles: list[str]) -> None:
    """Give panels their letters and titles."""
    for panel, sign, title in zip(panels, "abcdefgh", titles, strict=False):
        panel.set_title(f"({sign}) {title}".strip())


def need(condition: Any, sentence: str) -> None:
    """Give up a figure, with a sentence for the page, unless the condition holds."""
    if not condition:
        raise NotDrawableError(sentence)


def need_slides(n: int, fewest: int) -> None:
    """Give up a figure of `n` slides if it takes more."""
    need(n >= fewest, f"It needs {fewest} or more slides, and there {'is' if n == 1 else 'are'} {n or 'none'}.")
