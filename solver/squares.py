"""Squares of a lattice that a surface cuts, and the area of what lies below it, exact for a polyline."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from solver.surface import Surface

LEAST_SHARE = 0.5
"""Of a square that is a particle. What is less goes to the fullest neighbour: light particles bounce."""


class Squares(NamedTuple):
    """What a ground fills of squares of a lattice, one entry each."""

    column: np.ndarray  # (n,) from the left wall
    row: np.ndarray  # (n,) from the base
    area: np.ndarray  # (n,) m2


def filled_squares(surface: Surface, side: float, columns: int) -> Squares:
    """Return the squares with half of their area below the surface or more, and all of the ground shared among them.

    Parameters
    ----------
    surface : Surface
        Continued beyond its end with its last slope.
    side : float
        Of a square in m; columns and rows begin at the origin.
    columns : int
        How many there are.
    """
    return _without_slivers(_cut(surface, side, columns), side)


def _cut(surface: Surface, side: float, columns: int) -> Squares:
    """Return the squares below the surface, and of those it cuts the part below."""
    pieces = _pieces(surface, side, columns)
    lowest, highest = np.full(columns, np.inf), np.zeros(columns)
    np.minimum.at(lowest, pieces.column, np.minimum(pieces.left_y, pieces.right_y))
    np.maximum.at(highest, pieces.column, np.maximum(pieces.left_y, pieces.right_y))
    whole = np.maximum(np.floor(lowest / side + 1e-9), 0).astype(int)
    rows = np.maximum(np.ceil(highest / side - 1e-9).astype(int), whole)
    column, row = np.repeat(np.arange(columns), whole), _counted(whole)
    # Each piece of the surface meets the rows from the last whole one to the highest of its column.
    counts = (rows - whole)[pieces.column]
    which = np.repeat(np.arange(pieces.column.size), counts)
    met = whole[pieces.column[which]] + _counted(counts)
    area = _areas(_Pieces(*(each[which] for each in pieces)), met * side, side)
    square, member = np.unique(pieces.column[which] * rows.max() + met, return_inverse=True)
    areas = np.bincount(member, weights=area, minlength=square.size)
    return Squares(
        np.concatenate([column, square // rows.max()]),
        np.concatenate([row, square % rows.max()]),
        np.concatenate([np.full(column.size, side**2), areas]),
    )


class _Pieces(NamedTuple):
    """Straight pieces of a surface within columns; a face on the edge of a column is in none."""

    column: np.ndarray
    left_x: np.ndarray  # m
    right_x: np.ndarray
    left_y: np.ndarray
    right_y: np.ndarray


def _pieces(surface: Surface, side: float, columns: int) -> _Pieces:
    edges = side * np.arange(columns + 1)
    inner = surface.x[(surface.x > 0.0) & (surface.x < edges[-1])]
    x = np.unique(np.concatenate([edges, inner]))
    x = x[np.concatenate([[True], np.diff(x) > 1e-9 * side])]
    left, right = x[:-1], x[1:]
    middle = 0.5 * (left + right)
    segment = np.clip(np.searchsorted(surface.x, middle, side="right") - 1, 0, surface.x.size - 2)
    slope = (surface.y[segment + 1] - surface.y[segment]) / (surface.x[segment + 1] - surface.x[segment])
    at_left = surface.y[segment] + slope * (left - surface.x[segment])
    at_right = surface.y[segment] + slope * (right - surface.x[segment])
    return _Pieces((middle / side).astype(int), left, right, at_left, at_right)


def _counted(counts: np.ndarray) -> np.ndarray:
    """Return 0, 1, ... for each count, one after the other."""
    ends = np.cumsum(counts)
    counted: np.ndarray = np.arange(counts.sum()) - np.repeat(ends - counts, counts)
    return counted


def _areas(pieces: _Pieces, bottom: np.ndarray, side: float) -> np.ndarray:
    """Return the area in m2 of the ground under pieces of the surface, in rows from ``bottom`` (m) on.

    Its thickness in the row, clip(surface - bottom, 0, side), is linear between the places where the surface enters
    and leaves the row.
    """
    width, rise = pieces.right_x - pieces.left_x, pieces.right_y - pieces.left_y
    safe = np.where(rise == 0.0, 1.0, rise)
    crossings = [np.where(rise == 0.0, 0.0, (level - pieces.left_y) / safe) for level in (bottom, bottom + side)]
    ends = np.sort(np.clip([np.zeros_like(width), *crossings, np.ones_like(width)], 0.0, 1.0), axis=0)
    area: np.ndarray = np.zeros_like(width)
    for a, b in pairwise(ends):
        thickness = (np.clip(pieces.left_y + share * rise - bottom, 0.0, side) for share in (a, b))
        area += 0.5 * (b - a) * width * sum(thickness)
    return area


def _without_slivers(squares: Squares, side: float) -> Squares:
    """Give the ground of squares with little of it to the fullest of their four neighbours."""
    number = {place: k for k, place in enumerate(zip(squares.column.tolist(), squares.row.tolist(), strict=True))}
    area = squares.area.copy()
    for k in np.argsort(area, kind="stable"):
        if area[k] > (LEAST_SHARE - 1e-9) * side**2:
            break
        column, row = int(squares.column[k]), int(squares.row[k])
        beside = [(column, row - 1), (column - 1, row), (column + 1, row), (column, row + 1)]
        neighbours = [number[place] for place in beside if place in number and area[number[place]] > 0.0]
        if neighbours:
            area[max(neighbours, key=area.__getitem__)] += area[k]
            area[k] = 0.0
    kept = area > 0.0
    return Squares(squares.column[kept], squares.row[kept], area[kept])
