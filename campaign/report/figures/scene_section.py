"""A scene before it is run: its section with toe, mesh and critical circle, and the field of a realization."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from campaign.fields.properties import BY_NAME, SoilProperty
from campaign.fields.strengths import Strengths
from campaign.report.figures.labels import Label, highest, place_labels, write_labels
from campaign.report.figures.section import SKY, Section, drawn_layers
from campaign.report.figures.style import BLACK, BLUE, GREY, ORANGE, WIDTH, Illustration, in_style, letter, new_figure
from campaign.scene import Scene
from campaign.scene.boring_data import measured_in
from campaign.scene.first_look import FirstLook, look_at
from campaign.scene.ground_surface import surface_of
from campaign.scene.ground_water import water_of
from campaign.scene.layers import interfaces_of
from campaign.scene.limit_equilibrium import SlipCircle
from campaign.simulation.ground import strengths_of
from solver.grid import whole_cells
from solver.surface import Surface

GROUND = "#f3ece0"

MOST_LINES = 200
"""Of a mesh across the figure; finer ones would be a grey area."""

SHARE = 0.85
"""Of the width of the figure that the section takes."""

TITLE = 80
"""Characters of a line above a panel."""

LEGEND = 0.8
"""Height in inches of the legend, for which there is room above all labels."""

OVERHEAD, TALLEST = 0.75, 14.0
"""Height in inches of a panel's title and axis, and of the largest figure."""


def save(scene: Scene, realization: int, path: Path) -> None:
    """Draw a scene and write the figure, in the format that the name of the file says."""
    with in_style():
        illustration = scene_section(scene, look_at(scene), strengths_of(scene, realization), realization)
        figure = illustration.figure
        beside = [each for axes in figure.axes for each in axes.artists if not each.get_in_layout()]
        seen = [*figure.get_default_bbox_extra_artists(), *beside]
        figure.savefig(path, bbox_inches="tight", bbox_extra_artists=seen)


def scene_section(scene: Scene, look: FirstLook, strengths: Strengths, realization: int) -> Illustration:
    """Draw the section of a scene, and below it the strengths of a realization."""
    section = Section(
        look.surface,
        scene.numerics.cell,
        look.surface.width,
        SKY * look.surface.top,
        scene.receptor,
        drawn_layers(scene),
        interfaces_of(scene),
        water_of(scene),
    )
    scale = SHARE * WIDTH / section.right
    # Text may go on beside the section, where the panels below have the bars of their colours.
    placed = place_labels(_places(section, scene), section.surface.height_at, scale, section.right / SHARE)
    sky = highest(placed, scale) + LEGEND / scale
    section = replace(section, top=max(section.top, sky))
    fields = [BY_NAME[name] for name in strengths.names]
    height = (1 + len(fields)) * (SHARE * WIDTH * section.panel_height + OVERHEAD)
    figure, panels = new_figure(min(height, TALLEST), 1 + len(fields), sharex=True)
    _ground(panels[0], section, scene.numerics.cell)
    _borings(panels[0], scene, tuple(BY_NAME))
    _circles(panels[0], look)
    write_labels(panels[0], placed, scale)
    for axes, row in zip(panels[1:], fields, strict=True):
        _field(axes, section, strengths, row)
        _borings(axes, scene, (row.name,))
    panels[-1].set_xlabel("x (m)")
    letter(panels, [fill(scene.title, TITLE), *(f"{row.long_name} of realization {realization}" for row in fields)])
    caption = f"{scene.title}: the ground with its toe, and the strength of realization {realization}."
    return Illustration(figure, caption, caption)


def _ground(axes: Axes, section: Section, cell: float) -> None:
    surface = section.surface
    ground = outline(axes, surface, facecolor=GROUND, edgecolor="none")
    if section.layers:
        section.tint_layers(axes, ground)
        names = axes.legend(loc="lower left", bbox_to_anchor=(1.0, 0.0), title="layers", alignment="left")
        axes.add_artist(names).set_in_layout(False)  # or long ones would narrow the panels
    x, y = (cell * np.arange(1 + whole_cells(length, cell)) for length in (surface.width, surface.top))
    if max(x.size, y.size) <= MOST_LINES:
        lines = [[(at, 0.0), (at, surface.top)] for at in x] + [[(0.0, at), (surface.width, at)] for at in y]
        mesh = LineCollection(lines, colors=GREY, linewidths=0.25, alpha=0.6)
        axes.add_collection(mesh)
        mesh.set_clip_path(ground)
    section.frame(axes)
    axes.plot(surface.x, surface.y, color=BLACK, linewidth=1.4)
    for wall, top in ((0.0, surface.y[0]), (surface.width, surface.y[-1])):
        axes.plot([wall, wall], [0.0, top], color=BLACK, linewidth=2.5, clip_on=False)
    axes.plot([0.0, surface.width], [0.0, 0.0], color=BLACK, linewidth=2.5, clip_on=False)


def _borings(axes: Axes, scene: Scene, names: Sequence[str]) -> None:
    """Draw the borings that have data of some properties, from the surface to the deepest of these, and the data."""
    ground = surface_of(scene.geometry)
    for number, boring in enumerate(scene.boring):
        own = [each.y for each in measured_in(scene) if each.key.startswith(f"boring.{number}.") and each.name in names]
        if own:
            top = float(ground.height_at(np.array([boring.x]))[0])
            axes.plot([boring.x, boring.x], [min(own), top], color=BLACK, linewidth=1.2)
            axes.plot([boring.x] * len(own), own, "o", color=BLACK, markerfacecolor="white", markersize=4)


def _circles(axes: Axes, look: FirstLook) -> None:
    """Draw both circles; where they are the same, the dashes of one lie in the gaps of the other."""
    drawn = [
        *_circle(axes, look.peak, BLUE, 0.0, "mean peak strength"),
        *_circle(axes, look.residual, ORANGE, 5.0, "residual strength"),
    ]
    if drawn:
        heading = "critical circle and its factor of safety (Bishop)"
        axes.legend(handles=drawn, loc="upper right", title=heading, title_fontsize=9, alignment="left")


def _circle(axes: Axes, circle: SlipCircle | None, colour: str, begin: float, strength: str) -> list[Line2D]:
    if circle is None:
        return []
    x = np.linspace(circle.entry, circle.exit, 200)
    label = f"{circle.factor:.3g} with {strength}"
    return axes.plot(x, circle.elevation(x), color=colour, linestyle=(begin, (5, 5)), label=label)


def _places(section: Section, scene: Scene) -> list[Label]:
    """Return labels of the toe, of the places asked about, and of borings."""
    toe = section.surface.toe[0]
    near = [("toe", f"x = {toe:.4g} m", toe, BLACK)]
    near += [(each.name, each.where, each.x[0], ORANGE) for each in section.receptors]
    near += [(each.name, f"x = {each.x:g} m", each.x, GREY) for each in scene.boring]
    ground = section.surface.height_at(np.array([x for _, _, x, _ in near]))
    return [
        Label(x, float(y), f"{name}, {where}", colour, f"{name} at {x:.4g} m")
        for (name, where, x, colour), y in zip(near, ground, strict=True)
    ]


def _field(axes: Axes, section: Section, strengths: Strengths, row: SoilProperty) -> None:
    grid = strengths.grid
    rows, columns = grid.shape
    values = row.unit.shown_per_si * strengths[row.name]
    is_ground = grid.y[:, None] < section.surface.height_at(grid.x)
    box = (0.0, columns * grid.resolution, 0.0, rows * grid.resolution)
    outline(axes, section.surface, facecolor=GROUND, edgecolor="none").set_zorder(-1)  # where it is not random
    image = axes.imshow(values, origin="lower", extent=box, interpolation="nearest", cmap="viridis")
    image.set_clim(np.nanmin(values[is_ground]), np.nanmax(values[is_ground]))
    image.set_clip_path(outline(axes, section.surface, facecolor="none", edgecolor="none"))
    section.frame(axes)
    axes.figure.colorbar(image, ax=axes, label=row.unit.shown, aspect=12, pad=0.02)


def outline(axes: Axes, surface: Surface, **look: str) -> Polygon:
    """Add the ground as a polygon."""
    corners = [(0.0, 0.0), *zip(surface.x, surface.y, strict=True), (surface.width, 0.0)]
    ground = Polygon(corners, closed=True, **look)
    axes.add_patch(ground)
    return ground
