"""How large a scene's random field is, without building its sampler."""

from typing import NamedTuple

from campaign.fields.correlation import Correlation
from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.samplers import MEMORY_LIMIT
from campaign.scene import Scene
from campaign.scene.complaints import Complaint
from campaign.scene.ground_surface import surface_of
from campaign.simulation.scene_sampler import AUTOMATIC, correlation_of, reference_grid
from campaign.terminal import data_size

PERIODS = {
    "exponential": (3.5, 20.0),
    "squared-exponential": (9.5, 12.0),
    "turned": (9.5, 20.0),
    "matern-3/2": (9.5, 20.0),
    "matern-5/2": (9.5, 20.0),
    "spherical": (3.5, 5.5),
    "cosine-exponential": (3.5, 25.0),
}
"""Least and largest period over the reach of the correlation at which circulant embedding was exact, over grids of 15
to 120 cells and distances of 2 to 1000 cells. Along the axes the separable exponential needs no more than the grid."""


class FieldSize(NamedTuple):
    """The reference grid of a random field and the memory that its sampler takes.

    Attributes
    ----------
    resolution : float
        Side of a cell [m].
    shape : tuple of int
        Rows and columns.
    least, most : float
        Bounds of the memory [bytes]: how far a periodic grid must grow is known only when it is built.
    """

    resolution: float
    shape: tuple[int, int]
    least: float
    most: float


def field_size(scene: Scene) -> FieldSize:
    """Return the size of a scene's random field."""
    field, ground = scene.field, surface_of(scene.geometry)
    correlation = correlation_of(field)
    grid = reference_grid(scene, ground.width, ground.top)
    method = AUTOMATIC if field.sampler == "auto" else field.sampler
    if method == "circulant":
        return FieldSize(grid.resolution, grid.shape, *circulant_bytes(correlation, grid))
    points = max(grid.shape) if method == "kronecker" else ground.area / grid.resolution**2
    return FieldSize(grid.resolution, grid.shape, 8.0 * points**2, 8.0 * points**2)


def circulant_bytes(correlation: Correlation, grid: ReferenceGrid) -> tuple[float, float]:
    """Return bounds of the memory [bytes] of a circulant embedding, 64 bytes for each point of the periodic grid."""
    kind = "turned" if correlation.kind == "separable-exponential" else correlation.kind
    periods = (0.0, 0.0) if correlation.is_separable and kind == "turned" else PERIODS[kind]
    reach_x, reach_y = correlation.reach
    rows, columns = grid.shape

    def n_bytes(period: float) -> float:
        """Return the memory of a periodic grid that is so many times the reach long, and twice the grid or more."""
        return (
            64.0
            * max(2.0 * rows - 1.0, period * reach_y / grid.resolution)
            * max(2.0 * columns - 1.0, period * reach_x / grid.resolution)
        )

    return n_bytes(periods[0]), n_bytes(periods[1])


REMEDY = "use a coarser resolution, shorter correlation lengths, or another sampler"


def too_large(size: FieldSize) -> Complaint | None:
    """Complain about a field that its sampler will refuse."""
    if size.least <= MEMORY_LIMIT:
        return None
    return Complaint(
        "field.resolution", f"the sampler then takes {data_size(size.least)} or more, and {_limit(size)}; {REMEDY}"
    )


def perhaps_too_large(size: FieldSize) -> Complaint | None:
    """Complain about a field that its sampler may refuse."""
    if not size.least <= MEMORY_LIMIT < size.most:
        return None
    return Complaint(
        "field.resolution", f"the sampler may then take up to {data_size(size.most)}, and {_limit(size)}; {REMEDY}"
    )


def _limit(size: FieldSize) -> str:
    rows, columns = size.shape
    return f"the limit for a field of {columns:,} x {rows:,} points is {data_size(MEMORY_LIMIT)}"
