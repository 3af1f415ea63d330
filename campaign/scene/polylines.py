"""Polylines across the section: the tops of layers, and a water table."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from solver.surface import Surface

ROUNDING = 1e-9
"""Share of the width within which a polyline ends at a wall."""


def across(points: Sequence[Sequence[float]], width: float) -> Surface:
    """Return the polyline through points (x, elevation) in m; a single point is level over the whole width in m."""
    x, y = np.array(points, dtype=float).T.copy()
    return Surface(x, y) if x.size > 1 else Surface(np.array([0.0, width]), np.repeat(y, 2))


def cut_off(points: Sequence[Sequence[float]], width: float) -> str | None:
    """Return the complaint about a polyline that does not span the section, None about one that does or is level."""
    if len(points) == 1:
        return None
    first, last = points[0][0], points[-1][0]
    if first <= 0.0 and last >= width * (1.0 - ROUNDING):
        return None
    return (
        f"it goes from x = {first:g} m to {last:g} m, and the section from 0 m to {width:g} m; continue it to both "
        "walls"
    )


def upper_of(one: Surface, other: Surface) -> Surface:
    """Return the polyline that follows the upper one of two, over the width of the first."""
    lower = lower_of(Surface(one.x, -one.y), Surface(other.x, -other.y))
    return Surface(lower.x, -lower.y)


def lower_of(one: Surface, other: Surface) -> Surface:
    """Return the polyline that follows the lower one of two, over the width of the first."""
    places = np.union1d(one.x, other.x)
    places = places[(places >= one.x[0]) & (places <= one.width)]
    x: list[float] = []
    y: list[float] = []
    for left, right in pairwise(places.tolist()):
        begin, end = (np.array([_limits(each, left)[1], _limits(each, right)[0]]) for each in (one, other))
        gap = begin - end
        shares = [0.0, 1.0] if gap[0] * gap[1] >= 0.0 else [0.0, float(gap[0] / (gap[0] - gap[1])), 1.0]
        for share in shares:
            x.append(right if share == 1.0 else left + share * (right - left))
            y.append(float(min(each[0] + share * (each[1] - each[0]) for each in (begin, end))))
    return Surface(np.array(x), np.array(y))


def _limits(line: Surface, x: float) -> tuple[float, float]:
    """Return the elevations in m of a line just left and just right of a place; they differ on a vertical face."""
    mirrored = Surface(-line.x[::-1], line.y[::-1])
    left, right = mirrored.height_at(np.array([-x])), line.height_at(np.array([x]))
    return float(left[0]), float(right[0])
