"""The ground must span the cells, and have its toe on it."""

from campaign.scene.ground_surface import surface_through
from campaign.scene.rules.measures import Points
from campaign.scene.rules.rule import Rules

LEAST_CELLS_OF_LENGTH = 2

RULES = Rules()


@RULES.on("geometry.slope.crest", "numerics.cell")
@RULES.on("geometry.slope.plain", "numerics.cell")
@RULES.on("geometry.slope.foundation", "numerics.cell")
def _cells_of_length(length: float, cell: float) -> str | None:
    if length < cell * LEAST_CELLS_OF_LENGTH:
        return (
            f"it must span at least {LEAST_CELLS_OF_LENGTH} cells of {cell:g} m; "
            f"use at least {LEAST_CELLS_OF_LENGTH * cell:g} m or a smaller numerics.cell"
        )
    return None


@RULES.on("geometry.toe", "geometry.slope.height")
def _toe_of_a_slope(toe: float | None, _height: float) -> str | None:
    return None if toe is None else "the toe of a slope is its lower end; leave it out, or give a geometry.surface"


@RULES.on("geometry.toe", "geometry.surface", "numerics.cell")
def _toe_on_the_ground(toe: float | None, surface: Points | None, cell: float) -> str | None:
    if toe is None or surface is None or _is_on_ground(toe, surface, cell):
        return None
    return f"a slide must begin and end between the walls, at 0 m and {surface[-1][0]:g} m; keep {_clear(cell)} of each"


@RULES.on("geometry.surface", "geometry.toe", "numerics.cell")
def _toe_found_on_the_ground(surface: Points | None, toe: float | None, cell: float) -> str | None:
    if surface is None or toe is not None:
        return None
    found = surface_through(surface).toe_x
    if _is_on_ground(found, surface, cell):
        return None
    return (
        f"the foot of its slope, x = {found:g} m, lies on a wall, where no slide can run out; "
        f"add ground beyond it, {_clear(cell)} or more, or give geometry.toe"
    )


def _is_on_ground(toe: float, surface: Points, cell: float) -> bool:
    return LEAST_CELLS_OF_LENGTH * cell <= toe <= surface[-1][0] - LEAST_CELLS_OF_LENGTH * cell


def _clear(cell: float) -> str:
    return f"{LEAST_CELLS_OF_LENGTH} cells of {cell:g} m"
