"""Water has one description, and lies in the ground or stands over it."""

import numpy as np

from campaign.scene.ground_surface import surface_through
from campaign.scene.polylines import across, cut_off
from campaign.scene.rules.measures import Points
from campaign.scene.rules.rule import Rules
from solver.surface import Surface, slope_surface

ROUGHLY = 0.05
"""Share of the ground's height by which a table may be drawn above it: a sketch, which is cut at the surface."""

RULES = Rules()


@RULES.on("water.r_u", "water.table", "water.level")
def _one_description(r_u: float | None, table: Points | None, level: float | None) -> str | None:
    if r_u and (table is not None or level is not None):
        return "a water table says more than a ratio; leave out one of the two"
    return None


@RULES.on("water.table", "water.level", "geometry.slope.height", "geometry.slope.angle", "geometry.slope.crest",
          "geometry.slope.plain", "geometry.slope.foundation")  # fmt: skip
def _table_in_the_slope(
    table: Points | None, level: float | None, height: float, angle: float, crest: float, plain: float, depth: float
) -> str | None:
    return _in_the_ground(table, level, slope_surface(height, angle, crest, plain, depth))


@RULES.on("water.table", "water.level", "geometry.surface")
def _table_in_the_ground(table: Points | None, level: float | None, surface: Points | None) -> str | None:
    return None if surface is None else _in_the_ground(table, level, surface_through(surface))


def _in_the_ground(table: Points | None, level: float | None, ground: Surface) -> str | None:
    if table is None:
        return None
    if complaint := cut_off(table, ground.width):
        return complaint
    drawn = across(table, ground.width)
    x = np.union1d(drawn.x, ground.x)
    x = x[x <= ground.width]
    above = drawn.height_at(x) - np.maximum(ground.height_at(x), -np.inf if level is None else level)
    worst = int(np.argmax(above))
    if above[worst] <= ROUGHLY * ground.relief:
        return None
    return (
        f"at x = {x[worst]:.4g} m it lies {above[worst]:.3g} m above the ground; draw it below the surface, and give "
        "the elevation of water that stands over the ground as water.level"
    )


@RULES.on("water.level", "geometry.surface")
def _level_over_the_ground(level: float | None, surface: Points | None) -> str | None:
    return None if surface is None else _stands(level, min(y for _, y in surface))


@RULES.on("water.level", "geometry.slope.foundation")
def _level_over_the_plain(level: float | None, foundation: float) -> str | None:
    return _stands(level, foundation)


def _stands(level: float | None, lowest: float) -> str | None:
    if level is None or level > lowest:
        return None
    return (
        f"no ground lies below it, for the lowest is at {lowest:g} m: elevations count from the base, at 0; a water "
        "table in the ground is water.table"
    )


@RULES.on("soil.saturated_unit_weight", "soil.unit_weight", "water.unit_weight")
def _heavier_when_wet(saturated: float | None, moist: float, of_water: float) -> str | None:
    if saturated is None:
        return None
    if saturated < moist:
        return f"ground full of water weighs no less than moist, {moist / 1e3:g} kN/m^3"
    if saturated <= of_water:
        return f"it must be more than that of water, {of_water / 1e3:g} kN/m^3, or the ground would float"
    return None


@RULES.on("soil.unit_weight", "water.unit_weight", "water.level", "soil.saturated_unit_weight")
def _sinks(moist: float, of_water: float, level: float | None, saturated: float | None) -> str | None:
    if level is not None and saturated is None and moist <= of_water:
        return f"under water it must be more than that of water, {of_water / 1e3:g} kN/m^3, or the ground would float"
    return None
