"""Sections that can be computed but hardly be meant: drawn the other way round, above the sea, finer than the cells."""

from math import inf

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from campaign.scene import Scene
from campaign.scene.complaints import Complaint
from campaign.scene.more_ground import key_of
from solver.faces import descent, steepest_face
from solver.surface import Surface

MIRRORED = 1.5
"""Descent to the left over that to the right from which on a section may have been drawn the other way round."""

DEEP = 4.0
"""Depth of the ground below the slope, in heights of the slope, beyond which it can hardly be meant."""

SAMPLES = 16
"""Places in a cell at which the surface is looked at."""


def odd_sections(scene: Scene, surface: Surface) -> list[Complaint | None]:
    """Return what is odd about the section of a scene, None for what is not."""
    return [mirrored(surface), deep_ground(scene, surface), unseen_feature(scene.numerics.cell, surface)]


def mirrored(surface: Surface) -> Complaint | None:
    """Warn of a section whose slope falls to the left, where no slide goes."""
    x, y = surface.x, surface.y
    right, left = descent(y), descent(y[::-1])
    if left < MIRRORED * right or _steepness(-x[::-1], y[::-1]) < _steepness(x, y):
        return None
    return Complaint(
        "geometry.surface",
        f"the ground falls by {left:.3g} m towards the left and by {right:.3g} m towards the right, where slides go; "
        "if the higher slope is meant, mirror the section",
    )


def _steepness(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
    """Return drop over run of the steepest face, infinite for a wall."""
    head, foot = steepest_face(x, y)
    return (y[head] - y[foot]) / (x[foot] - x[head]) if x[foot] > x[head] else inf


def deep_ground(scene: Scene, surface: Surface) -> Complaint | None:
    """Warn of ground that goes far below the slope: elevations above the sea instead of those above the base."""
    depth, height = float(np.min(surface.y)), descent(surface.y)
    if depth <= DEEP * height:
        return None
    return Complaint(
        key_of(scene, "foundation"),
        f"the ground goes {depth:.4g} m below the foot of a slope of {height:.3g} m, and what lies deeper than one "
        "height has no part in a slide but takes its time; elevations count from the fixed base, y = 0",
    )


def unseen_feature(cell: float, surface: Surface) -> Complaint | None:
    """Warn of a wall or a slot that is narrower than a cell and higher than one: the mesh has particles beside it only.

    Ground that is lost where a window of one cell passes below it, or filled where that passes above (opening and
    closing of mathematical morphology, by which slopes and corners stay as they are).
    """
    x = np.arange(0.0, surface.width, cell / SAMPLES)
    y = np.asarray(surface.height_at(x))
    lost = np.maximum(y - _passed_below(y), -y - _passed_below(-y))
    worst = int(np.argmax(lost))
    if lost[worst] <= cell:
        return None
    return Complaint(
        "geometry.surface",
        f"around x = {x[worst]:.3g} m it has a wall or a slot {lost[worst]:.2g} m high that is narrower than a cell of "
        f"{cell:g} m, of which the mesh sees little or nothing; draw it wider, or use smaller cells",
    )


def _passed_below(y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how high a window of one cell comes below the surface at each place."""
    beside = SAMPLES // 2
    lowest = sliding_window_view(np.pad(y, beside, mode="edge"), 2 * beside + 1).min(axis=1)
    highest: NDArray[np.float64] = sliding_window_view(np.pad(lowest, beside, mode="edge"), 2 * beside + 1).max(axis=1)
    return highest
