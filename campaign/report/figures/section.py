"""What cross-sections of a campaign have in common: the ground before the slide, toe, receptors and run-out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from campaign.report.figures.style import BLACK, GREY, ORANGE, WATER
from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.ground_water import water_of
from campaign.scene.layers import interfaces_of, layer_names
from campaign.scene.sections import Receptor
from campaign.simulation.solver_model import Array
from solver.grid import particle_spacing
from solver.surface import Surface
from solver.water import NO_WATER, Water

MARGIN = 0.08
"""Of the width shown, beyond the longest run-out."""

SKY = 1.12
"""Of the highest ground: the height shown."""

PLACES = 400
"""Along a water table that is drawn."""

SIGN = 0.12
"""Share of the width at which a water table has its sign."""

ABOVE_DEPOSIT = 0.65
"""Of the height of the slope: where run-outs are written."""


TINTS = ("#ece2cf", "#cfc6d3", "#d9c3ad", "#d3d8bd", "#dcd0d0", "#c4b8a6")
"""Of layers, from the surface down."""


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
    layers : sequence of str
        Names of the layers from the surface down, if there are several.
    interfaces : sequence of Surface
        The tops of all but the first.
    water : Water
        Its table and standing water are drawn.
    """

    surface: Surface
    side: float
    right: float
    top: float
    receptors: Sequence[Receptor] = ()
    layers: Sequence[str] = ()
    interfaces: Sequence[Surface] = ()
    water: Water = NO_WATER

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
        draw_water(axes, self.surface, self.water)
        axes.plot(self.surface.x, self.surface.y, color=BLACK, linestyle=(0, (4, 2)), linewidth=0.9)
        for top in self.interfaces:
            axes.plot(top.x, self._in_ground(top), color=BLACK, linestyle=(0, (1, 2)), linewidth=0.8)
        axes.set(xlim=(0, self.right), ylim=(0, self.top), aspect="equal", ylabel="elevation (m)")
        axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
        self.mark_receptors(axes, 0.5 * self.top)

    def tint_layers(self, axes: Axes, ground: Patch) -> None:
        """Fill the ground with a tint for each layer, which legends name; nothing for one soil."""
        for number, (name, top) in enumerate(zip(self.layers, (self.surface, *self.interfaces), strict=True)):
            tint = TINTS[number % len(TINTS)]
            filled = axes.fill_between(top.x, 0.0, top.y, color=tint, linewidth=0, label=name)
            filled.set_clip_path(ground)

    def _in_ground(self, top: Surface) -> Array:
        """Return the elevations of an interface, NaN where it runs along the surface."""
        is_at_surface = np.isclose(top.y, self.surface.height_at(top.x))
        beside = np.pad(is_at_surface, 1, constant_values=True)
        return np.where(is_at_surface & beside[:-2] & beside[2:], np.nan, top.y)

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


def drawn_layers(scene: Scene) -> Sequence[str]:
    """Return the names of the layers of a scene, none where the ground is one soil."""
    return layer_names(scene) if scene.layer else ()


def draw_water(axes: Axes, ground: Surface, water: Water) -> None:
    """Draw the water table with its sign, a triangle, and water that stands over the ground."""
    if water.table is None:
        return
    x = np.union1d(np.linspace(0.0, ground.width, PLACES), np.concatenate([ground.x, water.table.x]))
    table, top = water.height_at(x), ground.height_at(x)
    axes.fill_between(x, top, table, where=(table > top).tolist(), color=WATER, alpha=0.35, linewidth=0)
    axes.plot(x, table, color=WATER, linewidth=1.1)
    sign = np.array([SIGN * ground.width])
    axes.plot(sign, water.height_at(sign), marker=7, markersize=7, color=WATER)


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
    return Section(
        surface,
        float(side),
        right,
        SKY * surface.top,
        scene.receptor,
        drawn_layers(scene),
        interfaces_of(scene),
        water_of(scene),
    )
