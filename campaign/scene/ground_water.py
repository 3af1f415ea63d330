"""The ground water that a scene describes."""

import numpy as np
from numpy.typing import NDArray

from campaign.scene.ground_surface import surface_of
from campaign.scene.layers import interfaces_of, weight_above
from campaign.scene.polylines import across, lower_of, upper_of
from campaign.scene.scene import Scene
from campaign.scene.sections import Soil
from solver.surface import Surface
from solver.water import NO_WATER, Water

Array = NDArray[np.float64]

PLACES = 401
"""Across the section, at which water is measured."""

ROUNDING = 1e-6
"""Height in m above the ground within which a table that is cut there lies in it."""

AFTERWARDS = "In a slide each part of the ground keeps its share: it does not drain."


def water_of(scene: Scene) -> Water:
    """Return the ground water of a scene."""
    water, table = scene.water, table_of(scene)
    if table is not None:
        return Water(table, unit_weight=water.unit_weight, level=water.level)
    return Water(ratio=water.r_u, unit_weight=water.unit_weight) if water.r_u else NO_WATER


def table_of(scene: Scene) -> Surface | None:
    """Return the water table of a scene as it is, None without one.

    What is drawn of it above the ground is cut there, and it is nowhere below water that stands.
    """
    water, ground = scene.water, surface_of(scene.geometry)
    table = None if water.table is None else lower_of(ground, across(water.table, ground.width))
    if water.level is None:
        return table
    standing = across(((0.0, water.level),), ground.width)
    return standing if table is None else upper_of(table, standing)


def water_words(scene: Scene) -> str | None:
    """Say where water is, how much of the weight above it carries, and what becomes of it; None without water."""
    water, ground, table = scene.water, surface_of(scene.geometry), table_of(scene)
    if table is None:
        ratio = f"Pore pressure is r_u = {water.r_u} of the weight above, everywhere."
        return f"{ratio} {AFTERWARDS}" if water.r_u else None
    x = _places(ground)
    heights, top = table.height_at(x), ground.height_at(x)
    in_ground = heights[heights <= top + ROUNDING] if np.any(heights <= top + ROUNDING) else top
    sentences = [
        f"The table is at elevations from {in_ground.min():.4g} m to {in_ground.max():.4g} m; its pore pressure "
        f"carries at most {100 * most_carried(scene):.0f} % of the weight above."
    ]
    if water.level is not None:
        depth = water.level - float(ground.y.min())
        sentences.append(
            f"Water stands at {water.level:.4g} m, at most {depth:.3g} m deep: it lifts what is below its level, and "
            "has neither waves nor drag."
        )
    return " ".join([*sentences, AFTERWARDS])


def most_carried(scene: Scene) -> float:
    """Return the largest share of the weight above that the pore pressure carries: at the base."""
    x = _places(surface_of(scene.geometry))
    return float(np.max(carried_share(scene, x, np.zeros_like(x))))


def carried_share(scene: Scene, x: Array, y: Array) -> Array:
    """Return which share of the weight above places in the ground their pore pressure carries, without lakes."""
    ground, table = surface_of(scene.geometry), table_of(scene)
    if table is None:
        return np.full_like(x, scene.water.r_u or 0.0)
    unit_weights = [soil.unit_weight for soil in scene.soils], [saturated_unit_weight(soil) for soil in scene.soils]
    elevation = table.height_at(x)
    weight = weight_above(ground, interfaces_of(scene), unit_weights, elevation, x, y)
    share: Array = scene.water.unit_weight * (np.clip(elevation, y, ground.height_at(x)) - y) / weight
    return share


def saturated_unit_weight(soil: Soil) -> float:
    """Return the unit weight in N/m3 of a soil below the water table."""
    return soil.unit_weight if soil.saturated_unit_weight is None else soil.saturated_unit_weight


def _places(ground: Surface) -> Array:
    return np.linspace(0.0, ground.width, PLACES)
