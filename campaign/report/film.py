"""Slides as films for the page's script: moving ground by frames, in few bytes, and the last frame as it is drawn."""

import base64
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.report.figures.domains import covering, deformation_gradients
from campaign.report.figures.particles import rectangles
from campaign.report.figures.section import Section
from campaign.report.replays import Replays
from campaign.report.snapshots import ReplayedSlide, Snapshot
from campaign.simulation.ground import Ground
from campaign.simulation.solver_model import Array, column_edges
from solver.observables import deposit_surface

UNIT: Final = 0.02
"""Metres of the drawing's unit; places are whole numbers of it."""

SHAPE: Final = 36.0
"""Of the deformation gradient, so that it fits a byte: its elements are below 3.5."""

MOST = 2000
"""Moving areas of a film; more are joined to larger ones, or the page becomes large."""

DISTANCES: Final = (0.0, 1.0, 3.0, 6.0, 10.0)
"""Displacements in m from which on ground has the next colour, above that at which it begins to move."""


LEVELS: Final = len(DISTANCES) + 1
"""Colours of moving ground; the first is that of ground that does not move yet."""


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


class _Moving(NamedTuple):
    """The areas that a film shows.

    Attributes
    ----------
    which : ndarray (m,)
        Numbers of the particles that stand for them.
    side : float
        Of an area before the slide, in m.
    covers : bool ndarray (n,)
        The particles that lie in one of them.
    """

    which: NDArray[np.intp]
    side: float
    covers: NDArray[np.bool_]


def films(replayed: Replays, section: Section) -> list[Film]:
    """Return the films of the deterministic and of the median slide."""
    shown = {"With mean strengths everywhere": replayed.deterministic}
    if "median" in replayed.ranked:
        median = replayed.ranked["median"]
        shown[f"A typical slide: realization {median.realization}, of median run-out"] = median
    moving = {title: slide for title, slide in shown.items() if slide.end.runout > 0}
    return [_film(title, slide, replayed, section) for title, slide in moving.items()]


def _film(title: str, slide: ReplayedSlide, replayed: Replays, section: Section) -> Film:
    ground, shots = replayed.ground, [slide.at(time) for time in replayed.times]
    shots[-1] = slide.end
    moving = _moving(ground, shots, section)
    never = ~moving.covers & (ground.lattice.x < section.right)
    frames = [_frame(ground, moving, shot) for shot in shots]
    surfaces = np.stack([_surface(ground, shot) for shot in shots])
    x = ground.coordinates["x"]
    still = rectangles(ground.lattice.x[never], ground.lattice.y[never], np.zeros(never.sum(), np.intp), section.side)
    data = {
        "places": _packed(np.stack([np.stack([x, y], -1) for x, y, _, _ in frames]) / UNIT, "<i2"),
        "shapes": _packed(np.stack([shape.reshape(-1, 4) for _, _, shape, _ in frames]) * SHAPE, "i1"),
        "levels": _packed(np.stack([level for _, _, _, level in frames]), "u1"),
        "surfaces": _packed(surfaces / UNIT, "<i2"),
        "x": np.round(x / UNIT).astype(int).tolist(),
        "half": 0.53 * moving.side / UNIT,
        "captions": [_caption(shot) for shot in shots],
    }
    line = "L".join(f"{a:.0f} {b:.0f}" for a, b in zip(x / UNIT, surfaces[-1] / UNIT, strict=True))
    return Film(title, _path(still[0]), _last(frames[-1], moving.side), f"M{line}", _caption(slide.end), data)


def _moving(ground: Ground, shots: list[Snapshot], section: Section) -> _Moving:
    """Choose squares of one or more particles; each moves if the particle in its middle does."""
    lattice, farthest = ground.lattice, np.max([shot.displacement for shot in shots], axis=0)
    moves = (farthest > ground.scene.slide.displaced) & (lattice.x < section.right)
    step = max(1, int(np.ceil(np.sqrt(np.count_nonzero(moves) / MOST))))
    i, j = (np.floor(at / section.side).astype(int) for at in (lattice.x, lattice.y))
    block = i // step * (j.max() + 1) + j // step
    which = np.flatnonzero(moves & (i % step == step // 2) & (j % step == step // 2))
    return _Moving(which, step * section.side, np.isin(block, block[which]))


def _frame(ground: Ground, moving: _Moving, shot: Snapshot) -> tuple[Array, Array, Array, NDArray[np.intp]]:
    """Return places x, y (m), deformation gradients and colours of the moving areas."""
    which, lattice = moving.which, ground.lattice
    x, y, far = shot.x[which], shot.y[which], shot.displacement[which] - ground.scene.slide.displaced
    ratio = shot.volume[which] / lattice.volume[which]
    shape = deformation_gradients((lattice.x[which], lattice.y[which]), (x, y), ratio, moving.side)
    return x, y, shape, np.searchsorted(DISTANCES, far)


def _surface(ground: Ground, shot: Snapshot) -> Array:
    now = ground.lattice._replace(x=shot.x, y=shot.y, volume=shot.volume)
    return deposit_surface(now, 0.5 * ground.model.particle_spacing, column_edges(ground.model))


def _last(frame: tuple[Array, Array, Array, NDArray[np.intp]], side: float) -> list[str]:
    x, y, shape, levels = frame
    return [_path(covering(x[where], y[where], shape[where], side)) for where in np.eye(LEVELS, dtype=bool)[levels].T]


def _path(areas: Array) -> str:
    whole = np.round(areas / UNIT).astype(int).tolist()
    return "".join("M" + "L".join(f"{x} {y}" for x, y in area) + "z" for area in whole)


def _packed(values: Array | NDArray[np.intp], dtype: str) -> str:
    limits = np.iinfo(dtype)
    whole = np.clip(np.round(np.nan_to_num(values)), limits.min, limits.max).astype(dtype)
    return base64.b64encode(whole.tobytes()).decode()


def _caption(shot: Snapshot) -> str:
    return f"{shot.time:.1f} s after release, run-out {shot.runout:.1f} m"
