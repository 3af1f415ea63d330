"""The ground surface as a polyline; NumPy only, so that a scene is checked without a compiler."""

from typing import NamedTuple

import numpy as np


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
        """Place in m of the crest: where the steepest face upslope of the toe begins, or the toe if there is none."""
        upslope = self.x <= self.toe_x
        x, y = self.x[upslope], self.y[upslope]
        if x[-1] < self.toe_x:
            x, y = np.append(x, self.toe[0]), np.append(y, self.toe[1])
        return float(x[steepest_face(x, y)[0]]) if _descent(x, y) > 0.0 else self.toe_x

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


def foot_of_steepest_face(x: np.ndarray, y: np.ndarray) -> float:
    """Return the place in m where the steepest face of the surface through ``x, y`` (m) ends; see ``steepest_face``."""
    return float(x[steepest_face(x, y)[1]])


def _descent(x: np.ndarray, y: np.ndarray) -> float:
    """Return the largest descent in m between two points of a surface, the lower one on the right."""
    return float(np.max(np.where(x - x[:, None] >= 0.0, y[:, None] - y, 0.0)))


def _is_steep(drop: float, run: float, steepness: float) -> bool:
    return bool(drop > steepness * run if run > 0.0 else drop > 0.0)


def steepest_face(x: np.ndarray, y: np.ndarray) -> tuple[int, int]:
    """Return the numbers of the points between which a surface that descends to the right has its steepest face.

    The face is the steepest stretch between two points that makes up half of the largest descent or more, so that a
    step of the ground is none. It begins and ends where the ground beside it falls less than half as steeply.

    Parameters
    ----------
    x, y : ndarray (k,)
        Points of the surface in m, from left to right.

    Raises
    ------
    ValueError
        If the ground nowhere descends to the right.
    """
    drop = y[:, None] - y
    run = x - x[:, None]
    largest = _descent(x, y)
    if not largest > 0.0:
        raise ValueError("The ground nowhere descends to the right, where slides go; mirror it.")
    is_face = (run >= 0.0) & (drop >= 0.5 * largest)
    steepness = np.divide(drop, run, out=np.full_like(drop, np.inf), where=run > 0.0)
    steepest = np.max(steepness[is_face])
    # Of equally steep stretches the one that falls most is the whole face.
    candidates = is_face & (steepness >= steepest * (1.0 - 1e-9) if np.isfinite(steepest) else np.isinf(steepness))
    head, foot = map(int, np.unravel_index(np.argmax(np.where(candidates, drop, -np.inf)), drop.shape))
    while head > 0 and _is_steep(y[head - 1] - y[head], x[head] - x[head - 1], 0.5 * steepest):
        head -= 1
    while foot + 1 < x.size and _is_steep(y[foot] - y[foot + 1], x[foot + 1] - x[foot], 0.5 * steepest):
        foot += 1
    return head, foot
