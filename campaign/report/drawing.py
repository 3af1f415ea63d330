"""Figures to come, and figures as they stand on the page."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

from campaign.report.figures.style import Illustration, NotDrawableError
from campaign.report.figures.svg import svg_of


class Plan(NamedTuple):
    """A figure to come: the name of its file, its title on the page, and what draws it."""

    name: str
    title: str
    draw: Callable[[], Illustration]


class Drawn(NamedTuple):
    """A figure on the page, or the sentence that says why it is not there."""

    title: str
    caption: str
    svg: str = ""


def draw_all(plans: Iterable[Plan], directory: Path) -> list[Drawn]:
    """Draw figures and keep each as a file in `directory`."""
    return [_draw(plan, directory) for plan in plans]


def _draw(plan: Plan, directory: Path) -> Drawn:
    path = directory / f"{plan.name}.svg"
    try:
        illustration = plan.draw()
    except NotDrawableError as reason:
        path.unlink(missing_ok=True)
        return Drawn(plan.title, str(reason))
    svg = svg_of(illustration, plan.name)
    directory.mkdir(exist_ok=True)
    path.write_text(svg, encoding="utf-8")
    return Drawn(plan.title, illustration.caption, svg)
