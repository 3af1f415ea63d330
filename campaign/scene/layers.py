"""Where the layers of a scene lie, and the scene as it were with the soil of one of them everywhere.

Layers are numbered from the surface down; number 0 is [soil]. A top above the surface, or above that of a layer before,
is cut there.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from campaign.fields.properties import PROPERTIES, SoilProperty, marginals
from campaign.scene.ground_surface import surface_of
from campaign.scene.scene import Scene
from campaign.scene.sections import Layer
from solver.surface import Surface

Array = NDArray[np.float64]

FIRST = "soil"
"""What the layer at the surface is called."""


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


def _drawn_top(layer: Layer, surface: Surface) -> Surface:
    if layer.depth is not None:
        return Surface(surface.x, surface.y - layer.depth)
    x, y = np.array(layer.top, dtype=float).T.copy()
    return Surface(x, y) if x.size > 1 else Surface(np.array([0.0, surface.width]), np.repeat(y, 2))


def lower_of(one: Surface, other: Surface) -> Surface:
    """Return the polyline that follows the lower one of two, over the width of the first."""
    places = np.union1d(one.x, other.x)
    places = places[(places >= one.x[0]) & (places <= one.width)]
    x: list[float] = []
    y: list[float] = []
    for left, right in pairwise(places.tolist()):
        begin, end = (np.array([limits(each, left)[1], limits(each, right)[0]]) for each in (one, other))
        gap = begin - end
        shares = [0.0, 1.0] if gap[0] * gap[1] >= 0.0 else [0.0, float(gap[0] / (gap[0] - gap[1])), 1.0]
        for share in shares:
            x.append(right if share == 1.0 else left + share * (right - left))
            y.append(float(min(each[0] + share * (each[1] - each[0]) for each in (begin, end))))
    return Surface(np.array(x), np.array(y))


def limits(line: Surface, x: float) -> tuple[float, float]:
    """Return the elevations in m of a line just left and just right of a place; they differ on a vertical face."""
    mirrored = Surface(-line.x[::-1], line.y[::-1])
    left, right = mirrored.height_at(np.array([-x])), line.height_at(np.array([x]))
    return float(left[0]), float(right[0])


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
