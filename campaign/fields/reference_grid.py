"""The grid on which random fields are drawn, whatever the mesh of the simulation."""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from campaign.fields.correlation import Array

Mask = Callable[[Array, Array], NDArray[np.bool_]]

ROUNDING = 1e-6
"""Share of a cell of the reference grid within which two places are the same."""


@dataclass(frozen=True)
class ReferenceGrid:
    """Square cells over the bounding box of the ground, from the origin on, on which fields are drawn.

    Parameters
    ----------
    resolution : float
        Side of a cell [m].
    shape : tuple of int
        Rows and columns (ny, nx); the last ones may stick out of the box.
    """

    resolution: float
    shape: tuple[int, int]

    @classmethod
    def covering(cls, width: float, height: float, resolution: float) -> "ReferenceGrid":
        """Return the smallest grid over a box of `width` x `height` [m]."""
        rows, columns = (ceil(length / resolution - ROUNDING) for length in (height, width))
        return cls(resolution, (rows, columns))

    @property
    def x(self) -> Array:
        """Centres of the columns [m], shape (nx,)."""
        return np.asarray(self.resolution * (np.arange(self.shape[1]) + 0.5), dtype=np.float64)

    @property
    def y(self) -> Array:
        """Centres of the rows [m], shape (ny,)."""
        return np.asarray(self.resolution * (np.arange(self.shape[0]) + 0.5), dtype=np.float64)

    def index(self, x: Array, y: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return the row and the column of the cell with the nearest centre; a tie goes up and to the right.

        Parameters
        ----------
        x, y : ndarray of shape (n,)
            Places [m].

        Raises
        ------
        ValueError
            If a place is outside the grid.
        """
        row, column = self._cell(y, self.shape[0], "y"), self._cell(x, self.shape[1], "x")
        return row, column

    def _cell(self, place: Array, n: int, axis: str) -> NDArray[np.intp]:
        cells = np.asarray(place) / self.resolution
        if outside := np.flatnonzero((cells < -ROUNDING) | (cells > n + ROUNDING)).tolist():
            raise ValueError(
                f"The place {axis} = {np.ravel(place)[outside[0]]:g} m is outside the random field, which goes "
                f"from 0 m to {n * self.resolution:g} m; build the field for the whole ground."
            )
        # On a tie rounding must not decide, or two meshes would read different cells at the same place.
        return np.floor(cells + ROUNDING).astype(np.intp).clip(0, n - 1)

    def cells_with(self, soil: Mask | None) -> NDArray[np.bool_]:
        """Mark, shape (ny, nx), the cells of which the centre or a corner is in the ground; all without a mask."""
        if soil is None:
            return np.ones(self.shape, dtype=bool)
        rows, columns = self.shape
        edge_x, edge_y = np.meshgrid(self.resolution * np.arange(columns + 1), self.resolution * np.arange(rows + 1))
        corner = soil(edge_x, edge_y)
        centre = soil(*np.meshgrid(self.x, self.y))
        return np.asarray(centre | corner[:-1, :-1] | corner[:-1, 1:] | corner[1:, :-1] | corner[1:, 1:])
