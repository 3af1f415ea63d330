"""Where the layers of a scene lie, and the scene as it were with the soil of one of them everywhere.

Layers are numbered from the surface down; number 0 is [soil]. A top above the surface, or above that of a layer before,
is cut there.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from campaign.fields.properties import PROPERTIES, SoilProperty, marginals
from campaign.scene.ground_surface import surface_of
from campaign.scene.polylines import across, lower_of
from campaign.scene.rules.layer import FIRST
from campaign.scene.scene import Scene
from campaign.scene.sections import Layer
from solver.surface import Surface

Array = NDArray[np.float64]


def layer_names(scene: Scene) -> tuple[str, ...]:
    """Return what the layers are called, from the surface down."""
    return (FIRST, *(layer.name for layer in scene.layer))


def layer_scenes(scene: Scene) -> tuple[Scene, ...]:
    """Return for each layer the scene as it were with the soil of that layer alone."""
    if not scene.layer:
        return (scene,)
    return tuple(scene.model_copy(update={"soil": soil, "layer": ()}) for soil in scene.soils)


def random_properties(scene: Scene) -> tuple[SoilProperty, ...]:
    """Return the properties that are random in any layer, in the order of their table."""
    random = {name for layer in layer_scenes(scene) for name in marginals(layer)}
    return tuple(row for row in PROPERTIES if row.name in random)


def interfaces_of(scene: Scene) -> tuple[Surface, ...]:
    """Return the tops of the layers below the first, none above the surface or above one before."""
    surface = surface_of(scene.geometry)
    interfaces = [surface]
    for layer in scene.layer:
        interfaces.append(lower_of(interfaces[-1], _drawn_top(layer, surface)))
    return tuple(interfaces[1:])


def tops_of(scene: Scene) -> tuple[Surface, ...]:
    """Return the top of each layer as it is drawn, from which its depth counts also where it is cut."""
    surface = surface_of(scene.geometry)
    return surface, *(_drawn_top(layer, surface) for layer in scene.layer)


def _drawn_top(layer: Layer, surface: Surface) -> Surface:
    if layer.depth is not None:
        return Surface(surface.x, surface.y - layer.depth)
    return across(layer.top or (), surface.width)


def layer_at(interfaces: Sequence[Surface], x: Array, y: Array) -> NDArray[np.intp]:
    """Return the number of the layer in which each place lies; one on an interface is above it."""
    number = np.zeros(np.broadcast(x, y).shape, dtype=np.intp)
    for top in interfaces:
        number += y < top.height_at(x)
    return number


def thickness_above(surface: Surface, interfaces: Sequence[Surface], x: Array, y: Array) -> list[Array]:
    """Return how much in m of each layer lies above places of the ground, an array for each layer.

    Interfaces must be cut by the surface and by those before.
    """
    tops = [surface.height_at(x), *(top.height_at(x) for top in interfaces)]
    bottoms = [*(np.maximum(top, y) for top in tops[1:]), y]
    return [np.maximum(top - bottom, 0.0) for top, bottom in zip(tops, bottoms, strict=True)]


def weight_above(
    surface: Surface,
    interfaces: Sequence[Surface],
    unit_weights: tuple[Sequence[float], Sequence[float]],
    table: Array,
    x: Array,
    y: Array,
) -> Array:
    """Return the weight in Pa of the ground above places.

    Parameters
    ----------
    surface, interfaces
        Of the ground, and the tops of its layers below the first.
    unit_weights
        Of each layer in N/m3, moist above the water table and saturated below it.
    table
        Elevation in m of the water table above each place.
    x, y
        Of the places in m.
    """
    whole, moist = (thickness_above(surface, interfaces, x, bottom) for bottom in (y, np.maximum(table, y)))
    weight = np.zeros(np.broadcast(x, y).shape)
    for gamma, gamma_wet, thickness, above in zip(*unit_weights, whole, moist, strict=True):
        weight += gamma * above + gamma_wet * (thickness - above)
    return weight
