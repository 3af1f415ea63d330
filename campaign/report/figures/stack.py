"""Cross-sections below each other, with a bar for their colours."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from campaign.report.figures.domains import covering, deformation_gradients
from campaign.report.figures.particles import Scale, draw_areas, draw_still
from campaign.report.figures.section import Section
from campaign.report.figures.style import COLUMN, new_figure
from campaign.report.snapshots import Snapshot
from campaign.simulation.ground import Ground
from campaign.simulation.solver_model import Array

OUTLINE = "Grey: ground that has not moved. Dashed: the ground before; orange: run-out from the toe."


def stack(section: Section, rows: int, colour_bars: int = 1) -> tuple[Figure, list[Axes]]:
    """Return a figure with so many panels, one below the other, and room for colour bars."""
    height = rows * (0.86 * COLUMN * section.panel_height + 0.27) + 0.75 * colour_bars
    figure, panels = new_figure(height, rows, width=COLUMN, sharex=True)
    panels[-1].set_xlabel("distance (m)")
    return figure, panels


def draw_slide(axes: Axes, section: Section, ground: Ground, shot: Snapshot, values: Array, scale: Scale) -> None:
    """Draw a snapshot: still ground in grey, moving ground as its deformed domains in the colours of values (n,)."""
    lattice, side = ground.lattice, section.side
    moves, shown = shot.displacement > ground.scene.slide.displaced, shot.x < section.right + side
    still = ~moves & shown
    draw_still(axes, (lattice.x, lattice.y), still, section)
    moving = moves & shown
    deformation = deformation_gradients((lattice.x, lattice.y), (shot.x, shot.y), shot.volume / side**2, side)
    areas = covering(shot.x[moving], shot.y[moving], deformation[moving], side)
    draw_areas(axes, areas, np.tile(values[moving], 2), scale)
    section.frame(axes)
    section.mark_runout(axes, shot.runout)


def colour_bar(figure: Figure, panels: Sequence[Axes], scale: Scale, label: str, extend: str = "max") -> None:
    """Add a colour bar below panels."""
    bar: dict[str, Any] = {"location": "bottom", "shrink": 0.7, "aspect": 40, "extend": extend}
    figure.colorbar(scale.mappable, ax=list(panels), label=label, pad=0.08 / len(panels), **bar)


def upper_limit(values: np.ndarray) -> float:
    """Return the end of a colour range that 0.5 % of extreme values do not stretch."""
    return float(np.percentile(values, 99.5)) or 1.0
