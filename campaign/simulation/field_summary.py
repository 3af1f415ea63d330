"""What the random field of a realization was, in few numbers: what regressions of the run-out start from.

Three summaries: means over the ground that slides and over its slip zone, which only the slide tells, and a coarse map
of the whole ground, which does not know of the slide. The map is read off the field itself, so that it is the same on
every mesh.
"""

from collections.abc import Callable
from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.fields.properties import PROPERTIES
from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.strengths import Strengths
from campaign.record import Quantity, Value
from campaign.simulation.solver_model import Array
from solver.particles import Particles
from solver.surface import Surface

BOXES = (12, 19)
"""Rows and columns of the map: for a slope some three times as wide as high, boxes about twice as wide as high."""

FEWEST_POINTS = 4
"""Along each side of a box, at which the field is read."""

FULL_SLIP = 0.95
"""Share of the sliding ground whose plastic strain is below that of full slip; beyond it single particles decide."""

SLIP_SHARE = 0.5
"""Of the plastic strain of full slip, from which on ground belongs to the slip zone."""

ZONES = {
    "sliding": "ground displaced farther than slide.displaced",
    "slip": f"slip zone, the ground with {100 * SLIP_SHARE:g} % or more of the plastic strain that "
    f"{100 * (1 - FULL_SLIP):.0f} % of the sliding ground exceed",
}

QUANTITIES: dict[str, Quantity] = {
    f"{zone}_{row.name}": Quantity((), row.unit.si, f"mean {row.long_name} over the {meaning}")
    for zone, meaning in ZONES.items()
    for row in PROPERTIES
}
"""Means over zones; NaN without a slide. Weights are areas before the slide."""


def zone_means(particles: Particles, start: Particles, displaced: NDArray[np.bool_]) -> dict[str, Value]:
    """Return the values of `QUANTITIES`.

    Parameters
    ----------
    particles, start : Particles
        At the end and before the slide, with the strengths of the realization.
    displaced : ndarray (n,)
        The mask of the ground that slides.
    """
    zones = {"sliding": displaced, "slip": slip_zone(particles.plastic_strain, displaced)}
    return {
        f"{zone}_{row.name}": _mean(getattr(start, row.particle_array)[where], start.volume[where])
        for zone, where in zones.items()
        for row in PROPERTIES
    }


def slip_zone(plastic_strain: Array, displaced: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the mask (n,) of the particles that belong to the slip zone; none without a slide."""
    if not displaced.any():
        return np.zeros_like(displaced)
    return np.asarray(plastic_strain >= SLIP_SHARE * np.quantile(plastic_strain[displaced], FULL_SLIP))


def _mean(values: Array, weights: Array) -> float:
    return float(np.average(values, weights=weights)) if values.size else np.nan


class BoxMap(NamedTuple):
    """Equal boxes over the bounding box of the ground, and the cells of the reference grid that are read in each.

    Attributes
    ----------
    x, y : ndarray (columns,), (rows,)
        Middle of the boxes in m.
    box : ndarray (m,)
        Number of the box, row by row, in which each of m points lies; all of them are in the ground.
    cell : tuple of ndarray (m,)
        Row and column of the cell of the reference grid in which it lies.
    """

    x: Array
    y: Array
    box: NDArray[np.intp]
    cell: tuple[NDArray[np.intp], NDArray[np.intp]]

    def means(self, field: Strengths) -> Array:
        """Return the means of ln(property) over the boxes, (property, row, column); NaN where none is random.

        Without its trend: the logarithm is the Gaussian field but for a factor and a constant, whatever the unit.
        """
        return self.averages(field.random_values(), np.log)

    def averages(self, values: Array, of: Callable[[Array], Array] = np.asarray) -> Array:
        """Return the means over the boxes, (n, row, column), of a function of values on the reference grid (n, ny, nx).

        Points where a value is not finite do not count; without any that count the mean is NaN.
        """
        read = of(values[:, *self.cell])
        boxes = self.y.size * self.x.size
        means = np.full((len(read), boxes), np.nan)
        for mean, value in zip(means, read, strict=True):
            is_drawn = np.isfinite(value)
            count = np.bincount(self.box[is_drawn], minlength=boxes)
            total = np.bincount(self.box[is_drawn], value[is_drawn], minlength=boxes)
            np.divide(total, count, out=mean, where=count > 0)
        return means.reshape(-1, self.y.size, self.x.size)


def box_map(surface: Surface, grid: ReferenceGrid) -> BoxMap:
    """Lay the boxes over the ground and find the cells of the reference grid in each."""
    rows, columns = BOXES
    x, column = _points(surface.width, columns, grid.resolution)
    y, row = _points(surface.top, rows, grid.resolution)
    points_x, points_y = np.meshgrid(x, y)
    inside = points_y < surface.height_at(points_x)
    box = row[:, None] * columns + column
    cell = grid.index(points_x[inside], points_y[inside])
    return BoxMap(_middles(surface.width, columns), _middles(surface.top, rows), box[inside], cell)


def _middles(side: float, boxes: int) -> Array:
    return (np.arange(boxes) + 0.5) * side / boxes


def _points(side: float, boxes: int, resolution: float) -> tuple[Array, NDArray[np.intp]]:
    """Return places (m) along a side, as close as the field is known, and the number of the box of each."""
    each = max(FEWEST_POINTS, ceil(side / boxes / resolution))
    return _middles(side, boxes * each), np.arange(boxes * each) // each
