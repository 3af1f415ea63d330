"""Where in the ground strength governs the run-out."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh

from campaign.report.figures.scene_section import outline
from campaign.report.figures.section import Section
from campaign.report.figures.style import BLACK, COLUMN, Illustration, NotDrawableError, letter, need, new_figure
from campaign.report.inputs import TENTH, names
from campaign.results.results import Results
from campaign.results.sensitivity import map_of
from campaign.simulation.solver_model import Array
from campaign.statistics.sensitivity_map import FEWEST, SensitivityMap
from campaign.statistics.wording import chance

COLOURS = "RdBu_r"
"""Red: the slide runs farther."""


def sensitivity(results: Results, section: Section) -> Illustration:
    """Draw the change of the run-out by more strength in each box, a panel for each random property."""
    found, slides = map_of(results.data), results.outcomes.unhindered
    if found is None:
        which = "that the wall ahead does not stop, and whose random soil is known"
        raise NotDrawableError(f"It needs {FEWEST} slides {which}; there are {slides}.")
    need(found.explained > 0, "The place of strong ground foretells nothing of the run-out.")
    named = names(results)
    rows = len(named)
    figure, panels = new_figure(rows * (0.86 * COLUMN * section.panel_height + 0.27) + 0.85, rows, COLUMN, sharex=True)
    limit = float(np.nanmax(np.abs(found.change)))
    boxes = results.data["box_x"].values, results.data["box_y"].values
    for number, axes in enumerate(panels):
        mesh = _panel(axes, section, boxes, found, number, limit)
    panels[-1].set_xlabel("distance (m)")
    letter(panels, named)
    label = f"change of the run-out by {TENTH} in a box (m)"
    figure.colorbar(mesh, ax=panels, label=label, location="bottom", shrink=0.6, aspect=40)
    caption = (
        f"What {TENTH} of a property in one box alone makes of the run-out of a slide: red lengthens, blue shortens "
        "it. Dots mark boxes whose effect can be told from none; what the others show may be chance. From "
        f"{found.everywhere[0].n} slides; {chance(found.explained)} of their scatter can be foretold from the place of "
        "strong ground. Soil is similar over the lengths of its correlation, so that a box speaks for its surroundings "
        "too. Dashed: the ground before the slide."
    )
    return Illustration(figure, caption, f"Maps of the slope: effect of {' and of '.join(named)} on the run-out.")


def _panel(
    axes: Axes, section: Section, boxes: tuple[Array, Array], found: SensitivityMap, number: int, limit: float
) -> QuadMesh:
    x, y = (_edges(middles) for middles in boxes)
    mesh = axes.pcolormesh(np.minimum(x, section.right), y, found.change[number], cmap=COLOURS, vmin=-limit, vmax=limit)
    mesh.set_clip_path(outline(axes, section.surface, facecolor="none", edgecolor="none"))
    row, column = np.nonzero(found.is_clear[number])
    axes.plot(boxes[0][column], boxes[1][row], "o", color=BLACK, markersize=2.5)
    section.frame(axes)
    return mesh


def _edges(middles: Array) -> Array:
    half = 0.5 * (middles[1] - middles[0])
    return np.append(middles - half, middles[-1] + half)
