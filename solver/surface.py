"""The ground surface as a polyline; NumPy only, so that a scene is checked without a compiler."""

from typing import NamedTuple

import numpy as np

from solver.faces import descent, face_stack

NARROW = 0.1
"""In heights of the slope: on its edge or in its foot, what is narrower is a bump or a ditch and not the slope's."""


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
    def height(self) -> float:
        """Height in m of the slope from its toe to its crest, whatever lies behind or ahead; the relief without a toe.

        A bump on the edge of the crest and a ditch at the toe that are narrower than a tenth of it do not count.
        """
        if np.isnan(self.toe_x):
            return self.relief
        (upslope_x, upslope_y), crest = self._upslope(), self._crest()
        toe_x, toe_y = self.toe
        rough = float(upslope_y[crest]) - toe_y
        behind = upslope_x[crest] - upslope_x[crest::-1], upslope_y[crest::-1]
        downslope = self.x > toe_x
        ahead = np.append(0.0, self.x[downslope] - toe_x), np.append(toe_y, self.y[downslope])
        lowered = _rise_beyond(NARROW * rough, behind[0], -behind[1])
        raised = _rise_beyond(NARROW * rough, *ahead)
        return max(0.0, rough - lowered - raised)

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
        return float(self._upslope()[0][self._crest()])

    def _upslope(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the points of the surface down to the toe."""
        upslope = self.x <= self.toe_x
        x, y = self.x[upslope], self.y[upslope]
        if x[-1] < self.toe_x:
            x, y = np.append(x, self.toe[0]), np.append(y, self.toe[1])
        return x, y

    def _crest(self) -> int:
        """Return which of these points is the crest."""
        x, y = self._upslope()
        return face_stack(x, y)[0] if descent(y) > 0.0 else x.size - 1

    def height_at(self, x: np.ndarray) -> np.ndarray:
        """Return the elevation in m above each ``x``; on a vertical face that of the ground to its right."""
        segment = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, self.x.size - 2)
        run = self.x[segment + 1] - self.x[segment]
        share = np.divide(x - self.x[segment], run, out=np.zeros_like(run), where=run > 0)
        height: np.ndarray = self.y[segment] + share * (self.y[segment + 1] - self.y[segment])
        return height


def _rise_beyond(distance: float, x: np.ndarray, y: np.ndarray) -> float:
    """Return by how much (m) the lowest ground from a distance on lies above that at 0; 0 if below, or without any.

    Parameters
    ----------
    distance : float
        In m.
    x, y : ndarray (k,)
        Distances in m from 0 on, and elevations in m.
    """
    if x[-1] < distance:
        return 0.0
    beyond = np.append(y[x > distance], np.interp(distance, x, y))
    return float(max(0.0, beyond.min() - y[0]))


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
