"""Ground water, as a scene draws it; NumPy only.

Above the water table the ground is moist and free of pore pressure, below it saturated, with the pressure of the water
column up to the table, ``u = gamma_w (z_w - y)``. Without a table the pore pressure is everywhere the same share of the
weight of the ground above, ``u = r_u gamma d``: the pore pressure ratio of Bishop and Morgenstern (1960, Geotechnique
10:129).
"""

from typing import NamedTuple

import numpy as np

from solver.constants import STANDARD_GRAVITY
from solver.surface import Surface

UNIT_WEIGHT = 9810.0  # N/m3


class Water(NamedTuple):
    """A water table, or a ratio of pore pressure to overburden where there is none; and standing water."""

    table: Surface | None = None
    ratio: float = 0.0  # r_u
    unit_weight: float = UNIT_WEIGHT  # N/m3
    level: float | None = None  # m, of the water that stands where the table is above the ground

    def raised(self, by: float) -> "Water":
        """Return the same water by so many m higher."""
        table = self.table and self.table._replace(y=self.table.y + by)
        return self._replace(table=table, level=None if self.level is None else self.level + by)

    def height_at(self, x: np.ndarray) -> np.ndarray:
        """Return the elevation in m of the table above each ``x``; below all ground without one."""
        return np.full_like(x, -np.inf) if self.table is None else self.table.height_at(x)

    def pore_pressure(self, x: np.ndarray, y: np.ndarray, overburden: np.ndarray) -> np.ndarray:
        """Return the pore pressure in Pa at places ``x``, ``y`` (m) of the ground under an ``overburden`` (Pa)."""
        if self.table is None:
            return self.ratio * overburden
        column: np.ndarray = self.unit_weight * np.maximum(self.height_at(x) - y, 0.0)
        return column

    def uplift(self, top: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the weight in Pa of the standing water in the place of the ground between elevations (m)."""
        level = -np.inf if self.level is None else self.level
        weight: np.ndarray = self.unit_weight * np.maximum(np.minimum(top, level) - y, 0.0)
        return weight

    def standing_pressure(self, y: np.ndarray) -> np.ndarray:
        """Return the pressure in Pa of standing water at elevations ``y`` (m), were it to reach everywhere."""
        level = -np.inf if self.level is None else self.level
        pressure: np.ndarray = self.unit_weight * np.maximum(level - y, 0.0)
        return pressure


NO_WATER = Water()
"""A ratio of zero: the ground is free of pore pressure."""

LEVEL, DENSITY, GRAVITY, LIGHTENING = range(4)
"""Entries of ``Grid.lake``: m; kg/m3 of the water; m/s2 now; density of the water over that of the ground."""

NO_LAKE = np.array([-1e9, 0.0, STANDARD_GRAVITY, 0.0])


def lake_of(water: Water, density: float) -> np.ndarray:
    """Return the entries of ``Grid.lake`` for ground of a ``density`` in kg/m3."""
    if water.level is None:
        return NO_LAKE
    of_water = water.unit_weight / STANDARD_GRAVITY
    return np.array([water.level, of_water, STANDARD_GRAVITY, of_water / density])
