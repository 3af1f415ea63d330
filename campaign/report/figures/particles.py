"""Ground as areas: particles of one colour are one path, and neighbours on the lattice one rectangle."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from campaign.report.figures.domains import SEAM
from campaign.report.figures.section import Section
from campaign.report.figures.style import STILL
from campaign.simulation.solver_model import Array

LEVELS: Final = 24
"""Colours of a scale; more cannot be told apart."""

MANY: Final = 4000
"""Areas of a panel from which on they are an image: as shapes they would make the page slow and large."""


@dataclass(frozen=True)
class Scale:
    """Colours between two values, in `LEVELS` steps."""

    colours: str
    low: float
    high: float

    @property
    def mappable(self) -> ScalarMappable:
        """What a colour bar is made of."""
        return ScalarMappable(Normalize(self.low, self.high), mpl.colormaps[self.colours].resampled(LEVELS))

    def levels(self, values: Array) -> NDArray[np.intp]:
        """Return the number of the colour of each value."""
        share = (values - self.low) / (self.high - self.low)
        return np.clip((LEVELS * share).astype(np.intp), 0, LEVELS - 1)

    def colour(self, level: int) -> Any:
        """Return a colour by its number."""
        return self.mappable.cmap(level)


def draw_areas(axes: Axes, areas: Array, values: Array, scale: Scale) -> None:
    """Draw polygons (n, 4, 2) (m) in the colours of their values."""
    levels = scale.levels(values)
    for level in np.unique(levels):
        _add(axes, areas[levels == level], scale.colour(level), len(areas) > MANY)


def draw_still(axes: Axes, lattice: tuple[Array, Array], is_still: NDArray[np.bool_], section: Section) -> None:
    """Draw ground that has not moved, where it is on the lattice, in grey; see `still_areas`."""
    _add(axes, still_areas(lattice, is_still, section), STILL, False)


def still_areas(lattice: tuple[Array, Array], is_still: NDArray[np.bool_], section: Section) -> Array:
    """Return the corners (k, 4, 2) in m of ground that has not moved; it ends at the surface and not at a particle's.

    Parameters
    ----------
    lattice : tuple of arrays (n,)
        Places x, y in m of all particles.
    is_still : bool array (n,)
    section : Section
    """
    (x, y), side = lattice, section.side
    column, row = (np.floor(at / side).astype(np.intp) for at in (x, y))
    top = np.full(column.max() + 1, -1)
    np.maximum.at(top, column, row)
    is_top = is_still & (row == top[column])
    below = is_still & ~is_top
    whole, _ = rectangles(x[below], y[below], np.zeros(np.count_nonzero(below), dtype=np.intp), side)
    left, low = side * column[is_top], side * row[is_top] - 0.5 * (SEAM - 1.0) * side
    right = left + side
    # Just inside its ends, so that each column follows the surface on its own side of a vertical face.
    ends = [section.surface.height_at(at).clip(low) for at in (left + 1e-6 * side, right - 1e-6 * side)]
    tops = np.array([(left, low), (right, low), (right, ends[1]), (left, ends[0])]).transpose(2, 0, 1)
    return np.concatenate([whole, tops])


def draw_lattice(axes: Axes, x: Array, y: Array, values: Array, scale: Scale, side: float) -> None:
    """Draw ground where it was before the slide, in the colours of its values."""
    areas, levels = rectangles(x, y, scale.levels(values), side)
    for level in np.unique(levels):
        _add(axes, areas[levels == level], scale.colour(level), len(areas) > MANY)


def rectangles(x: Array, y: Array, levels: NDArray[np.intp], side: float) -> tuple[Array, NDArray[np.intp]]:
    """Join neighbours of one level in each row of the lattice; return corners (k, 4, 2) in m and levels (k,)."""
    runs = list(_runs(np.floor(x / side).astype(int), np.floor(y / side).astype(int), levels))
    if not runs:
        return np.empty((0, 4, 2)), np.empty(0, dtype=np.intp)
    row, first, last, level = np.array(runs).T
    over = 0.5 * (SEAM - 1.0) * side
    left, right = side * first - over, side * (last + 1) + over
    low, high = side * row - over, side * (row + 1) + over
    corners = [(left, low), (right, low), (right, high), (left, high)]
    return np.array(corners).transpose(2, 0, 1), level


def _runs(
    column: NDArray[np.int_], row: NDArray[np.int_], levels: NDArray[np.intp]
) -> Iterator[tuple[int, int, int, int]]:
    order = np.lexsort((column, row))
    column, row, levels = column[order], row[order], levels[order]
    goes_on = (np.diff(row) == 0) & (np.diff(column) == 1) & (np.diff(levels) == 0)
    begins = np.flatnonzero(np.r_[column.size > 0, ~goes_on])
    ends = np.r_[begins[1:] - 1, column.size - 1]
    for begin, end in zip(begins, ends, strict=False):
        yield row[begin], column[begin], column[end], levels[begin]


def _add(axes: Axes, areas: Array, colour: Any, as_image: bool) -> None:
    if not len(areas):
        return
    closed = np.concatenate([areas, areas[:, :1]], axis=1).reshape(-1, 2)
    codes = np.tile([Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY], len(areas))
    axes.add_artist(PathPatch(Path(closed, codes), facecolor=colour, linewidth=0, rasterized=as_image))
