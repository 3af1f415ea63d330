"""Slides as films for the page's script: moving ground by frames, in few bytes, and the last frame as it is drawn."""

import base64
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.record import SLID
from campaign.report.distances import round_step
from campaign.report.figures.domains import covering
from campaign.report.figures.particles import still_areas
from campaign.report.figures.section import Section
from campaign.report.moving import LEVELS, Frame, colour_limits, frame_of, moving_areas
from campaign.report.replays import Replays
from campaign.report.snapshots import ReplayedSlide, Snapshot
from campaign.simulation.ground import Ground
from campaign.simulation.solver_model import Array, column_edges
from campaign.statistics.wording import at_least
from solver.observables import deposit_surface

UNITS: Final = 4000
"""Of the drawing across its width; places are whole numbers of it."""

SHAPE: Final = 36.0
"""Of the deformation gradient, so that it fits a byte: its elements are below 3.5."""


class Screen(NamedTuple):
    """What films have in common: a drawing `right` units wide and `top` high, with the ground and its scale.

    Attributes
    ----------
    unit : float
        In m.
    right, top : int
    before : str
        Corners of the ground before the slide, for an SVG polyline.
    ticks : list of (int, str)
        Places and what is written at them.
    colours : list of str
        What the colours of moving ground stand for.
    """

    unit: float
    right: int
    top: int
    before: str
    ticks: list[tuple[int, str]]
    colours: list[str]


class Film(NamedTuple):
    """One film.

    Attributes
    ----------
    title : str
    still : str
        Drawing of the ground that never moves, for the attribute `d` of an SVG path.
    last : list of str
        The same of the moving ground at the end, for each colour.
    last_surface : str
        And of its surface.
    caption : str
        Of the last frame.
    data : dict
        What the script needs for the other frames.
    """

    title: str
    still: str
    last: list[str]
    last_surface: str
    caption: str
    data: dict[str, Any]


def screen_of(section: Section) -> Screen:
    """Return the screen on which a section is shown."""
    unit = section.right / UNITS
    step = round_step(section.right / 7)
    ticks = np.arange(0.0, section.right, step)
    labels = [f"{x:g}" for x in np.round(ticks, 9)]
    before = " ".join(f"{x / unit:.0f},{y / unit:.0f}" for x, y in section.corners)
    limits = [f"{limit:.2g} m" for limit in colour_limits(section)[1:]]
    colours = [f"up to {limits[0]}", *limits[1:], "farther"]
    places = [round(x / unit) for x in ticks]
    return Screen(unit, UNITS, round(section.top / unit), before, list(zip(places, labels, strict=True)), colours)


def films(replayed: Replays, section: Section) -> list[Film]:
    """Return the films of the deterministic and of the median slide."""
    shown = {"With mean strengths everywhere": replayed.deterministic}
    if "median" in replayed.ranked:
        median = replayed.ranked["median"]
        shown[f"A typical slide: realization {median.realization}, of median run-out"] = median
    moving = {title: slide for title, slide in shown.items() if slide.record.status in SLID}
    return [_film(title, slide, replayed, section) for title, slide in moving.items()]


def _film(title: str, slide: ReplayedSlide, replayed: Replays, section: Section) -> Film:
    unit = section.right / UNITS
    ground, shots = replayed.ground, [slide.at(time) for time in replayed.times]
    shots[-1], end = slide.end, _caption(slide.end, at_least(slide.record))
    moving = moving_areas(ground, shots, section)
    never = ~moving.covers & (ground.lattice.x < section.right)
    frames = [frame_of(ground, section, moving, shot) for shot in shots]
    surfaces = np.stack([_surface(ground, shot) for shot in shots])
    x = ground.coordinates["x"]
    still = still_areas((ground.lattice.x, ground.lattice.y), never, section)
    data = {
        "places": _packed(np.stack([np.stack([x, y], -1) for x, y, _, _ in frames]) / unit, "<i2"),
        "shapes": _packed(np.stack([shape.reshape(-1, 4) for _, _, shape, _ in frames]) * SHAPE, "i1"),
        "levels": _packed(np.stack([level for _, _, _, level in frames]), "u1"),
        "surfaces": _packed(surfaces / unit, "<i2"),
        "x": np.round(x / unit).astype(int).tolist(),
        "half": 0.53 * moving.side / unit,
        "captions": [*(_caption(shot) for shot in shots[:-1]), end],
    }
    line = "L".join(f"{a:.0f} {b:.0f}" for a, b in zip(x / unit, surfaces[-1] / unit, strict=True))
    return Film(title, _path(still / unit), _last(frames[-1], moving.side, unit), f"M{line}", end, data)


def _surface(ground: Ground, shot: Snapshot) -> Array:
    now = ground.lattice._replace(x=shot.x, y=shot.y, volume=shot.volume)
    return deposit_surface(now, 0.5 * ground.model.particle_spacing, column_edges(ground.model))


def _last(frame: Frame, side: float, unit: float) -> list[str]:
    x, y, shape, levels = frame
    of_levels = np.eye(LEVELS, dtype=bool)[levels].T
    return [_path(covering(x[where], y[where], shape[where], side) / unit) for where in of_levels]


def _path(areas: Array) -> str:
    whole = np.round(areas).astype(int).tolist()
    return "".join("M" + "L".join(f"{x} {y}" for x, y in area) + "z" for area in whole)


def _packed(values: Array | NDArray[np.intp], dtype: str) -> str:
    limits = np.iinfo(dtype)
    whole = np.clip(np.round(np.nan_to_num(values)), limits.min, limits.max).astype(dtype)
    return base64.b64encode(whole.tobytes()).decode()


def _caption(shot: Snapshot, least: str = "") -> str:
    return f"{shot.time:.1f} s after release, run-out {least}{shot.runout:.3g} m"
