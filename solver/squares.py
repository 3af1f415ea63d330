"""Squares of a lattice that a surface cuts: the area and the centre of what lies below it, exact for a polyline."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from solver.surface import Surface

LEAST_SHARE = 0.25
"""Of a square: what is less is added to the neighbour that is fullest, because light particles bounce."""


class Squares(NamedTuple):
    """What a ground fills of squares of a lattice, one entry each."""

    column: np.ndarray  # (n,) from the left wall
    row: np.ndarray  # (n,) from the base
    area: np.ndarray  # (n,) m2
    x: np.ndarray  # (n,) m, of the centroid
    y: np.ndarray  # (n,) m


def filled_squares(surface: Surface, side: float, columns: int) -> Squares:
    """Return all squares with ground in them, those with little of it joined to their neighbours.

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
    lowest = np.full(columns, np.inf)
    highest = np.zeros(columns)
    np.minimum.at(lowest, pieces.column, np.minimum(pieces.left_y, pieces.right_y))
    np.maximum.at(highest, pieces.column, np.maximum(pieces.left_y, pieces.right_y))
    whole = np.maximum(np.floor(lowest / side + 1e-9), 0).astype(int)
    last = np.ceil(highest / side - 1e-9).astype(int)
    below = Squares(*_whole(whole, side))
    # Each piece of the surface meets the rows from the last whole one to the highest of its column.
    counts = np.maximum(last - whole, 0)[pieces.column]
    which = np.repeat(np.arange(pieces.column.size), counts)
    row = whole[pieces.column[which]] + _counted(counts)
    moments = _moments(_Pieces(*(each[which] for each in pieces)), row * side, side)
    key = pieces.column[which] * (last.max() + 1) + row
    square, member = np.unique(key, return_inverse=True)
    area, first_x, first_y = (np.bincount(member, weights=each, minlength=square.size) for each in moments)
    has_ground = area > 1e-9 * side**2
    area, first_x, first_y, square = (each[has_ground] for each in (area, first_x, first_y, square))
    cut = Squares(square // (last.max() + 1), square % (last.max() + 1), area, first_x / area, first_y / area)
    return Squares(*map(np.concatenate, zip(below, cut, strict=True)))


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


def _whole(rows: np.ndarray, side: float) -> tuple[np.ndarray, ...]:
    """Return whole squares, so many in each column."""
    column, row = np.repeat(np.arange(rows.size), rows), _counted(rows)
    return column, row, np.full(column.size, side**2), (column + 0.5) * side, (row + 0.5) * side


def _counted(counts: np.ndarray) -> np.ndarray:
    """Return 0, 1, ... for each count, one after the other."""
    ends = np.cumsum(counts)
    numbers: np.ndarray = np.arange(counts.sum()) - np.repeat(ends - counts, counts)
    return numbers


def _moments(pieces: _Pieces, bottom: np.ndarray, side: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return area, and area times x and y, of the ground under pieces of the surface in rows from ``bottom`` (m) on.

    Its thickness in the row, clip(surface - bottom, 0, side), is linear between the places where the surface enters
    and leaves the row.
    """
    width, rise = pieces.right_x - pieces.left_x, pieces.right_y - pieces.left_y
    safe = np.where(rise == 0.0, 1.0, rise)
    crossings = [np.where(rise == 0.0, 0.0, (level - pieces.left_y) / safe) for level in (bottom, bottom + side)]
    ends = np.sort(np.clip([np.zeros_like(width), *crossings, np.ones_like(width)], 0.0, 1.0), axis=0)
    area, first_x, first_y = (np.zeros_like(width) for _ in range(3))
    for a, b in pairwise(ends):
        x_a, x_b = pieces.left_x + a * width, pieces.left_x + b * width
        t_a, t_b = (np.clip(pieces.left_y + share * rise - bottom, 0.0, side) for share in (a, b))
        part = 0.5 * (x_b - x_a) * (t_a + t_b)
        area += part
        first_x += (x_b - x_a) * (x_a * (2.0 * t_a + t_b) + x_b * (t_a + 2.0 * t_b)) / 6.0
        first_y += bottom * part + (x_b - x_a) * (t_a**2 + t_a * t_b + t_b**2) / 6.0
    return area, first_x, first_y


def _without_slivers(squares: Squares, side: float) -> Squares:
    """Join squares with little ground to the fullest of their four neighbours, which keeps mass and its centre."""
    number = {place: k for k, place in enumerate(zip(squares.column.tolist(), squares.row.tolist(), strict=True))}
    area, first_x, first_y = squares.area.copy(), squares.area * squares.x, squares.area * squares.y
    for k in np.argsort(area, kind="stable"):
        if not 0.0 < area[k] < LEAST_SHARE * side**2:
            continue
        column, row = int(squares.column[k]), int(squares.row[k])
        beside = [(column, row - 1), (column - 1, row), (column + 1, row), (column, row + 1)]
        neighbours = [number[place] for place in beside if place in number and area[number[place]] > 0.0]
        if neighbours:
            fullest = max(neighbours, key=area.__getitem__)
            for each in (area, first_x, first_y):
                each[fullest] += each[k]
                each[k] = 0.0
    kept = area > 0.0
    return Squares(
        squares.column[kept], squares.row[kept], area[kept], first_x[kept] / area[kept], first_y[kept] / area[kept]
    )
