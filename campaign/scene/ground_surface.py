"""The ground surface that a scene describes."""

from collections.abc import Sequence

import numpy as np

from campaign.scene.sections import Geometry
from solver.faces import foot_of_slope
from solver.surface import Surface, slope_surface


def surface_of(geometry: Geometry) -> Surface:
    """Return the ground surface of a scene."""
    if geometry.slope is not None:
        slope = geometry.slope
        return slope_surface(slope.height, slope.angle, slope.crest, slope.plain, slope.foundation)
    return surface_through(geometry.surface or (), geometry.toe)


def surface_through(points: Sequence[Sequence[float]], toe: float | None = None) -> Surface:
    """Return the surface through points (x, elevation) in m, from left to right.

    Parameters
    ----------
    points
        Two or more.
    toe
        Place of the toe in m; the foot of the slope if not given.
    """
    x, y = np.array(points, dtype=float).T.copy()
    return Surface(x, y, foot_of_slope(x, y) if toe is None else toe)
