"""The soil of each layer of a scene: what [[layer]] says, and the rest as in [soil]."""

from typing import Any, TypeVar

from campaign.scene.alternatives import replaced_by
from campaign.scene.rules.soil import FRICTIONLESS, WITH_CUTOFF
from campaign.scene.sections import FrictionAngle, Layer, SceneFile, Section, Soil

T = TypeVar("T", bound=Section)


def soils_of(scene: SceneFile) -> tuple[Soil, ...]:
    """Return the soil of each layer, whole, from the surface down; the first is [soil]."""
    return (scene.soil, *(soil_of(layer, scene.soil) for layer in scene.layer))


def written_out(scene: SceneFile) -> list[dict[str, Any]]:
    """Return the layers below the first, in JSON, with the whole soil of each whether or not it was written."""
    beside = {"name", "top", "depth", "field"}
    return [
        layer.model_dump(mode="json", include=beside) | soil.model_dump(mode="json")
        for layer, soil in zip(scene.layer, soils_of(scene)[1:], strict=True)
    ]


def soil_of(layer: Layer, above: Soil) -> Soil:
    """Return the soil of a layer with all that it leaves out as in another soil.

    A law without friction takes over neither friction nor dilation angle, one without a cut-off of tension no cut-off,
    and a rate no slip to residual strength.
    """
    own = {name: value for name, value in layer if name in layer.model_fields_set & Soil.model_fields.keys()}
    law = own.get("law", above.law)
    if law == FRICTIONLESS:
        above = above.model_copy(update={"friction_angle": None, "dilation_angle": 0.0})
    if law != WITH_CUTOFF:
        above = above.model_copy(update={"tension_cutoff": None})
    return _with(above, own, ("soil",))


def gives(layer: Layer, key: str) -> bool:
    """Whether a layer itself says what it has at a key, as "soil.cohesion.mean"."""
    section: Any = layer
    for name in key.split(".")[1:]:
        if not isinstance(section, Section) or name not in section.model_fields_set:
            return False
        section = getattr(section, name)
    return True


def _with(section: T, own: dict[str, Any], path: tuple[str, ...]) -> T:
    values: dict[str, Any] = {replaced: None for name in own for replaced in replaced_by((*path, name))}
    for name, value in own.items():
        below = getattr(section, name)
        if isinstance(value, Section):
            inner = {key: item for key, item in value if key in value.model_fields_set}
            values[name] = _friction_angle(inner) if below is None else _with(below, inner, (*path, name))
        else:
            values[name] = value
    return section.model_copy(update=values)


def _friction_angle(own: dict[str, Any]) -> FrictionAngle:
    """Return the friction angle of a layer below soil without one; `campaign.scene.check` sees that it is whole."""
    return FrictionAngle.model_construct(**own)
