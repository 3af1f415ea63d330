"""A layer has one top, which spans the section."""

from campaign.scene.ground_surface import surface_through
from campaign.scene.polylines import cut_off
from campaign.scene.rules.measures import Points
from campaign.scene.rules.rule import Rules
from solver.surface import slope_surface

FIRST = "soil"
"""What the layer at the surface is called."""

RULES = Rules()


@RULES.on("layer.*.name")
def _own_name(name: str) -> str | None:
    return f"the ground at the surface is told as {FIRST}; give another name" if name == FIRST else None


@RULES.on("layer.*.top", "layer.*.depth")
def _one_top(top: Points | None, depth: float | None) -> str | None:
    if top is None and depth is None:
        return 'each layer has one; add for instance top = "5 m", an elevation, or depth = "3 m", below the surface'
    if top is not None and depth is not None:
        return "the depth says the same in other terms; leave out one of the two"
    return None


@RULES.on(
    "layer.*.top",
    "geometry.slope.height",
    "geometry.slope.angle",
    "geometry.slope.crest",
    "geometry.slope.plain",
)
def _spans_the_slope(top: Points | None, height: float, angle: float, crest: float, plain: float) -> str | None:
    any_foundation = 1.0  # it has no part in the width
    return _spans(top, slope_surface(height, angle, crest, plain, any_foundation).width)


@RULES.on("layer.*.top", "geometry.surface")
def _spans_the_surface(top: Points | None, surface: Points | None) -> str | None:
    return None if surface is None else _spans(top, surface_through(surface).width)


def _spans(top: Points | None, width: float) -> str | None:
    complaint = None if top is None else cut_off(top, width)
    return complaint and f"{complaint}, with points behind the surface where the layer ends"
