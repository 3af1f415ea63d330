"""The layers of a scene in a table for people: how thick they are, and of what."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.fields.properties import BY_NAME, PROPERTIES, RESIDUALS, SoilProperty, value_of
from campaign.scene.ground_surface import surface_of
from campaign.scene.ground_water import saturated_unit_weight
from campaign.scene.layers import interfaces_of, layer_names, layer_scenes, thickness_above
from campaign.scene.scene import Scene
from campaign.scene.sections import Soil
from campaign.scene.units import UNIT_WEIGHT, shown_in_unit
from campaign.terminal import as_sentence, listing

PLACES = 500
"""At which thicknesses are measured."""


class LayerRow(NamedTuple):
    """A layer in words; strengths are means with their coefficients of variation."""

    name: str
    thickness: str
    unit_weight: str
    cohesion: str
    friction_angle: str
    residual: str


HEADINGS = LayerRow("layer", "thickness", "unit weight", "cohesion", "friction angle", "residual")

NONE = "none"

LASTING = "does not soften"


def layer_rows(scene: Scene) -> list[LayerRow]:
    """Return a row for each layer, from the surface down; none where the ground is one soil."""
    if not scene.layer:
        return []
    return [
        LayerRow(
            name,
            _range(thickness),
            _unit_weight(layer.soil),
            _value(layer, "cohesion"),
            _value(layer, "friction_angle"),
            _residual(layer),
        )
        for name, layer, thickness in zip(layer_names(scene), layer_scenes(scene), thicknesses(scene), strict=True)
    ]


def told_by_layer(scene: Scene, words: Callable[[Scene], str]) -> str:
    """Say what holds in each layer: once where it holds in all, else with the names of those where it does."""
    told: dict[str, list[str]] = {}
    for name, layer in zip(layer_names(scene), layer_scenes(scene), strict=True):
        told.setdefault(words(layer), []).append(name)
    if len(told) == 1:
        return next(iter(told))
    return "; ".join(f"{listing(names)}: {each}" for each, names in told.items())


def trend_words(scene: Scene) -> str | None:
    """Say by how much means grow with depth; None where none does."""
    if not any(row.gradient(layer) for layer in layer_scenes(scene) for row in PROPERTIES):
        return None
    return as_sentence(told_by_layer(scene, _trends))


def _trends(scene: Scene) -> str:
    told = [
        f"the mean {row.long_name} grows by {row.unit.show(row.gradient(scene))} per metre of depth, from "
        f"{row.unit.show(row.mean(scene))}"
        for row in PROPERTIES
        if row.gradient(scene) and row.share_of_peak(scene) is None
    ]
    return listing(told) if told else "no growth with depth"


def thicknesses(scene: Scene) -> list[NDArray[np.float64]]:
    """Return the thickness in m of each layer at places between the walls."""
    surface = surface_of(scene.geometry)
    x = (np.arange(PLACES) + 0.5) * surface.width / PLACES
    return thickness_above(surface, interfaces_of(scene), x, np.zeros(PLACES))


def _range(thickness: NDArray[np.float64]) -> str:
    least, most = float(thickness.min()), float(thickness.max())
    return f"{most:.2g} m" if most - least < 0.05 * most else f"{least:.2g} to {most:.2g} m"


def _unit_weight(soil: Soil) -> str:
    """Return the moist unit weight, and the saturated one where it is another."""
    moist, saturated = (shown_in_unit(each, UNIT_WEIGHT) for each in (soil.unit_weight, saturated_unit_weight(soil)))
    return moist if moist == saturated else f"{moist.partition(' ')[0]}, wet {saturated}"


def _residual(scene: Scene) -> str:
    if scene.soil.softening.law == "none":
        return LASTING
    values = (_residual_value(scene, row) for row in RESIDUALS)
    return ", ".join(value for value in values if value != NONE)


def _residual_value(scene: Scene, row: SoilProperty) -> str:
    share = row.share_of_peak(scene)
    return _value(scene, row.name) if share is None else f"{100 * share:.3g} % of the peak"


def _value(scene: Scene, name: str) -> str:
    row = BY_NAME[name]
    mean, cov = value_of(scene, row.mean_key), value_of(scene, row.cov_key)
    if mean is None:
        return NONE
    shown = f"{mean * row.unit.shown_per_si:.4g} {row.unit.shown}"
    if gradient := row.gradient(scene):
        shown = f"{shown} + {gradient * row.unit.shown_per_si:.4g} {row.unit.shown}/m"
    return f"{shown} ({100 * cov:.3g} %)" if cov else shown
