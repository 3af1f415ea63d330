"""The ground surface as a polyline; NumPy only, so that a scene is checked without a compiler."""

from typing import NamedTuple

import numpy as np

from solver.faces import descent, face_stack


class Surface(NamedTuple):
    """The ground surface as a polyline from the left wall to the right wall; the slide is expected towards +x."""

    x: np.ndarray  # (k,) m, not decreasing; equal neighbours are a vertical face
    y: np.ndarray  # (k,) m, above the base
    toe_x: float = np.nan  # m, from which run-out is measured; level ground has none

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
        """Place ``(x, y)`` of the toe in m."""
        return self.toe_x, float(self.height_at(np.array([self.toe_x]))[0])

    @property
    def crest_x(self) -> float:
        """Place in m of the crest: where the slope upslope of the toe begins, or the toe if there is none."""
        upslope = self.x <= self.toe_x
        x, y = self.x[upslope], self.y[upslope]
        if x[-1] < self.toe_x:
            x, y = np.append(x, self.toe[0]), np.append(y, self.toe[1])
        return float(x[face_stack(x, y)[0]]) if descent(y) > 0.0 else self.toe_x

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
    return Surface(np.array([0.0, crest, toe, toe + plain]), np.array([top, top, foundation, foundation]), float(toe))
