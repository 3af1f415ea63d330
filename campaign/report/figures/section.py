"""What cross-sections of a campaign have in common: the ground before the slide, toe, receptors and run-out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from campaign.report.figures.style import BLACK, GREY, ORANGE
from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.sections import Receptor
from campaign.simulation.solver_model import Array
from solver.grid import particle_spacing
from solver.surface import Surface

MARGIN = 0.08
"""Of the width shown, beyond the longest run-out."""

SKY = 1.12
"""Of the highest ground: the height shown."""

ABOVE_DEPOSIT = 0.65
"""Of the height of the slope: where run-outs are written."""


@dataclass(frozen=True)
class Section:
    """What the cross-sections of a campaign have in common.

    Parameters
    ----------
    surface : Surface
        The ground before the slide.
    side : float
        Of the square that a particle stands for, in m.
    right, top : float
        Where the drawings end, in m.
    receptors : sequence of Receptor
        The places asked about.
    """

    surface: Surface
    side: float
    right: float
    top: float
    receptors: Sequence[Receptor] = ()

    @property
    def corners(self) -> list[tuple[float, float]]:
        """Corners of the ground before the slide in m."""
        return list(zip(self.surface.x.tolist(), self.surface.y.tolist(), strict=True))

    @property
    def panel_height(self) -> float:
        """Height over width of what is shown."""
        return self.top / self.right

    def frame(self, axes: Axes) -> None:
        """Set equal scales, draw the ground before the slide, and mark the receptors."""
        axes.plot(self.surface.x, self.surface.y, color=BLACK, linestyle=(0, (4, 2)), linewidth=0.9)
        axes.set(xlim=(0, self.right), ylim=(0, self.top), aspect="equal", ylabel="elevation (m)")
        axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
        self.mark_receptors(axes, 0.5 * self.top)

    def mark_receptors(self, axes: Axes, height: float) -> None:
        """Mark the places asked about, from zero to a height in the unit of the panel."""
        for receptor in self.receptors:
            near, far = receptor.x
            axes.fill_between([near, far], 0.0, height, color=GREY, alpha=0.3, linewidth=0)
            axes.vlines([near, far], 0.0, height, color=GREY, linewidth=0.7, linestyle=":")

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
    """Return the section of a scene, wide enough for these run-outs (m) and for the places asked about.

    Without a slide the whole ground is shown.
    """
    surface = surface_of(scene.geometry)
    known = np.asarray(runouts)[np.isfinite(runouts)]
    runout = float(np.max(known, initial=0.0))
    reach = surface.toe[0] + runout
    farthest = max([reach, *(receptor.x[1] for receptor in scene.receptor)])
    side = particle_spacing(scene.numerics.cell, scene.numerics.particles_per_cell)
    right = min(surface.width, (1 + MARGIN) * farthest + 2 * side) if runout > 0.0 else surface.width
    return Section(surface, float(side), right, SKY * surface.top, scene.receptor)
