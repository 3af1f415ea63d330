"""A receptor lies on the ground, where a slide can come."""

from campaign.scene.ground_surface import surface_through
from campaign.scene.rules.measures import Points
from campaign.scene.rules.rule import Rules
from solver.surface import slope_surface

RULES = Rules()


@RULES.on(
    "receptor.*.x",
    "geometry.slope.height",
    "geometry.slope.angle",
    "geometry.slope.crest",
    "geometry.slope.plain",
)
def _on_the_slope(stretch: list[float], height: float, angle: float, crest: float, plain: float) -> str | None:
    any_foundation = 1.0  # it has no part in the width, and its mistakes hide none of a receptor
    width = slope_surface(height, angle, crest, plain, any_foundation).width
    return _between_walls(stretch, width, "lengthen geometry.slope.plain")


@RULES.on("receptor.*.x", "geometry.surface")
def _on_the_surface(stretch: list[float], surface: Points | None) -> str | None:
    return None if surface is None else _between_walls(stretch, surface_through(surface).width, "continue the surface")


def _between_walls(stretch: list[float], width: float, longer: str) -> str | None:
    near, far = stretch
    if near > 0.0 and far < width:
        return None
    other = longer if near > 0.0 else "add ground behind the crest, and as much to every x"
    return f"it must lie between the walls, at 0 m and {width:g} m; move it, or {other}"
