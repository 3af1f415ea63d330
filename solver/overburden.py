"""The weight of the ground above a place, as a scene draws its layers and its water."""

import numpy as np

from solver.model import Model


def overburden(model: Model, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the weight in Pa of the ground above each place, ``sum gamma_k thickness_k`` over the layers.

    Below the water table a layer has its saturated unit weight.
    """
    weight = np.zeros_like(x)
    tops = [surface.height_at(x) for surface in (model.surface, *model.interfaces)]
    bottoms = [*tops[1:], np.full_like(x, -np.inf)]
    table = model.water.height_at(x)
    for material, top, bottom in zip(model.materials, tops, bottoms, strict=True):
        top, bottom = np.minimum(top, tops[0]), np.maximum(bottom, y)
        thickness = np.maximum(top - bottom, 0.0)
        wet = np.maximum(np.minimum(top, table) - bottom, 0.0)
        weight += material.unit_weight * (thickness - wet) + material.saturated_unit_weight * wet
    return weight
