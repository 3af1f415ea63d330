"""The ground surface as a polyline; NumPy only, so that a scene is checked without a compiler."""

from typing import NamedTuple

import numpy as np


class Surface(NamedTuple):
    """The ground surface as a polyline from the left wall to the right wall; the slide is expected towards +x."""

    x: np.ndarray  # (k,) m, not decreasing; equal neighbours are a vertical face
    y: np.ndarray  # (k,) m, above the base

    @property
    def width(self) -> float:
        """Distance between the side walls in m."""
        return float(self.x[-1])

    @property
    def top(self) -> float:
        """Highest elevation in m."""
        return float(self.y.max())

    @property
    def relief(self) -> float:
        """Difference in m between the highest and the lowest elevation."""
        return float(np.ptp(self.y))

    @property
    def area(self) -> float:
        """Area in m2 of the ground under the surface."""
        return float(np.sum(np.diff(self.x) * 0.5 * (self.y[1:] + self.y[:-1])))

    @property
    def toe(self) -> tuple[float, float]:
        """Place ``(x, y)`` in m where the surface reaches the level of its right end for the first time."""
        level = self.y[-1]
        first = int(np.argmax(self.y <= level + 1e-9))
        if first == 0:
            return float(self.x[0]), float(level)
        share = (self.y[first - 1] - level) / (self.y[first - 1] - self.y[first])
        return float(self.x[first - 1] + share * (self.x[first] - self.x[first - 1])), float(level)

    def height_at(self, x: np.ndarray) -> np.ndarray:
        """Return the elevation in m above each ``x``; on a vertical face that of the ground to its right."""
        segment = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, self.x.size - 2)
        run = self.x[segment + 1] - self.x[segment]
        share = np.divide(x - self.x[segment], run, out=np.zeros_like(run), where=run > 0)
        height: np.ndarray = self.y[segment] + share * (self.y[segment + 1] - self.y[segment])
        return height


def slope_surface(height: float, angle: float, crest: float, plain: float, foundation: float) -> Surface:
    """Return the surface of a straight slope that descends to the right.

    Parameters
    ----------
    height, crest, plain, foundation : float
        Height of the slope, lengths of the flats above and below it, and depth of the ground under the toe, in m.
    angle : float
        Inclination in rad.
    """
    toe = crest + height / np.tan(angle)
    top = foundation + height
    return Surface(np.array([0.0, crest, toe, toe + plain]), np.array([top, top, foundation, foundation]))
