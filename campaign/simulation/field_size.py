"""How large a scene's random field is, without building its sampler."""

from typing import NamedTuple

from campaign.fields.correlation import Correlation
from campaign.fields.embedding import circulant_bytes
from campaign.fields.reference_grid import ReferenceGrid
from campaign.fields.samplers import MEMORY_LIMIT
from campaign.fields.stretched import LARGEST_EMBEDDING, stretched_bytes
from campaign.scene import Scene
from campaign.scene.complaints import Complaint
from campaign.scene.ground_surface import surface_of
from campaign.simulation.scene_sampler import AUTOMATIC, correlation_of, reference_grid
from campaign.terminal import data_size


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
        return FieldSize(grid.resolution, grid.shape, *automatic_bytes(correlation, grid))
    points = max(grid.shape) if method == "kronecker" else ground.area / grid.resolution**2
    return FieldSize(grid.resolution, grid.shape, 8.0 * points**2, 8.0 * points**2)


def automatic_bytes(correlation: Correlation, grid: ReferenceGrid) -> tuple[float, float]:
    """Return bounds of the memory [bytes] of a circulant embedding, or of the fewer nodes that take its place."""
    least, most = circulant_bytes(correlation, grid.shape, (grid.resolution,) * 2)
    if least <= LARGEST_EMBEDDING and most <= MEMORY_LIMIT:
        return least, most
    stretched = stretched_bytes(correlation, grid.shape, grid.resolution)
    return stretched if least > LARGEST_EMBEDDING else (least, max(MEMORY_LIMIT, stretched[1]))


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
