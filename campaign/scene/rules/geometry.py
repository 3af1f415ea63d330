"""The ground must span the cells."""

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
