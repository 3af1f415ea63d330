"""A mean that grows with depth."""

from typing import NamedTuple

import numpy as np

from campaign.fields.correlation import Array
from solver.surface import Surface


class Trend(NamedTuple):
    """What the mean at a depth is, over a value for reference; linear from the top of a layer down.

    The standard deviation grows alike, so that the coefficient of variation is that of the field without the trend.

    Attributes
    ----------
    at_top : float
        At the top, and above it.
    growth : float
        By which it grows [1/m].
    top : Surface
        Of the layer, or the ground surface.
    """

    at_top: float
    growth: float
    top: Surface

    def __call__(self, x: Array, y: Array) -> Array:
        """Return it at places `x`, `y` [m], which are broadcast against each other."""
        return np.asarray(self.at_top + self.growth * np.maximum(self.top.height_at(x) - y, 0.0))
