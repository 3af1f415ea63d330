"""Cross-sections: the particles as the squares they stand for, the ground before the slide, and the run-out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from campaign.report.figures.style import BLACK, ORANGE
from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.simulation.solver_model import Array
from solver.grid import particle_spacing
from solver.surface import Surface

MARGIN = 0.08
"""Of the width shown, beyond the longest run-out."""

ABOVE_DEPOSIT = 0.65
"""Of the height of the slope: where run-outs are written."""

SEAM = 1.06
"""Squares are drawn so much larger that no seams show between them."""

MOVED = 1.5
"""And so much larger again after a slide, which stretches the ground."""


@dataclass(frozen=True)
class Section:
    """What the cross-sections of a campaign have in common.

    Parameters
    ----------
    surface : Surface
        The ground before the slide.
    side : float
        Of the square that a particle stands for, in m.
    right : float
        Where the drawings end, in m.
    """

    surface: Surface
    side: float
    right: float

    @property
    def panel_height(self) -> float:
        """Height over width of what is shown."""
        return 1.12 * self.surface.top / self.right

    def draw(
        self,
        axes: Axes,
        x: Array,
        y: Array,
        values: Array,
        colours: str,
        limits: tuple[float, float],
        size: float = 1.0,
    ) -> PolyCollection:
        """Draw particles at `x`, `y` (m), coloured by their values, `size` times as large as they were at first."""
        half = 0.5 * size * SEAM * self.side
        corners = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
        squares = np.column_stack([x, y])[:, None, :] + corners
        particles = PolyCollection(
            list(squares), array=values, cmap=colours, norm=Normalize(*limits), edgecolors="none", antialiased=False
        )
        axes.add_collection(particles)
        self.frame(axes)
        return particles

    def frame(self, axes: Axes) -> None:
        """Set equal scales and draw the ground before the slide."""
        axes.plot(self.surface.x, self.surface.y, color=BLACK, linestyle=(0, (4, 2)), linewidth=0.9)
        axes.set(xlim=(0, self.right), ylim=(0, 1.12 * self.surface.top), aspect="equal", ylabel="elevation (m)")
        axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))

    def mark_runout(self, axes: Axes, runout: float) -> None:
        """Mark how far the front came beyond the toe, in m."""
        if runout <= 0:
            return
        toe_x, toe_y = self.surface.toe
        height = toe_y + ABOVE_DEPOSIT * (self.surface.top - toe_y)
        arrow = {"arrowstyle": "<->", "color": ORANGE, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (toe_x + runout, height), (toe_x, height), arrowprops=arrow)
        axes.vlines([toe_x, toe_x + runout], toe_y, 1.04 * height, color=ORANGE, linewidth=0.8)
        axes.text(toe_x + 0.5 * runout, 1.02 * height, f"{runout:.2f} m", color=ORANGE, ha="center", va="bottom")


def section_of(scene: Scene, runouts: Sequence[float] | Array) -> Section:
    """Return the section of a scene, wide enough for these run-outs (m)."""
    surface = surface_of(scene.geometry)
    known = np.asarray(runouts)[np.isfinite(runouts)]
    reach = surface.toe[0] + float(np.max(known, initial=0.0))
    side = particle_spacing(scene.numerics.cell, scene.numerics.particles_per_cell)
    return Section(surface, float(side), min(surface.width, (1 + MARGIN) * reach + 2 * side))
