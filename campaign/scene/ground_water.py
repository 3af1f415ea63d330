"""The ground water that a scene describes."""

from campaign.scene.ground_surface import surface_of
from campaign.scene.polylines import across, lower_of, upper_of
from campaign.scene.scene import Scene
from solver.surface import Surface
from solver.water import NO_WATER, Water


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
