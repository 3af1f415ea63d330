"""The ground surface that a scene describes."""

from collections.abc import Sequence

import numpy as np

from campaign.scene.sections import Geometry
from solver.surface import Surface, slope_surface


def surface_of(geometry: Geometry) -> Surface:
    """Return the ground surface of a scene."""
    if geometry.slope is not None:
        slope = geometry.slope
        return slope_surface(slope.height, slope.angle, slope.crest, slope.plain, slope.foundation)
    return surface_through(geometry.surface or ())


def surface_through(points: Sequence[Sequence[float]]) -> Surface:
    """Return the surface through points (x, elevation) in m, from left to right."""
    coordinates = np.array(points, dtype=float)
    return Surface(coordinates[:, 0].copy(), coordinates[:, 1].copy())
