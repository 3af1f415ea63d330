"""Every key that a scene may have, with what it takes and what holds where it is left out."""

from collections.abc import Iterator
from typing import Any, Literal, NamedTuple, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from campaign.fields.correlation import KERNELS
from campaign.fields.properties import PROPERTIES, RESIDUALS
from campaign.scene.comparison import kind_of
from campaign.scene.sections import SceneFile, Soil
from campaign.scene.units import shown_in_unit

REQUIRED = "required"

DEPENDS = {
    "layer.top": "depth",
    "layer.depth": "top",
    "slide.front_area": "height^2 / 100",
    "geometry.toe": "the foot of the slope",
    "field.resolution": "the shorter distance / 8",
    "soil.saturated_unit_weight": "unit_weight",
    "soil.k0": "nu / (1 - nu)",
    **{row.mean_key: row.share_key.rpartition(".")[2] for row in RESIDUALS},
    **{row.cov_key: "0" for row in RESIDUALS},
    **{row.gradient_key: "0" for row in PROPERTIES},
    "boring.noise": "0",
}
"""What holds in place of keys that are None by default."""

TAKES = {
    "geometry.surface": "points of x and elevation",
    "receptor.x": "a place, or both ends of a range",
    **{f"boring.{row.name}": "pairs of depth or elevation and value" for row in PROPERTIES},
    "boring.noise": "a number",
    "layer.top": "an elevation, or points of x and elevation",
    "water.table": "an elevation, or points of x and elevation",
    "water.r_u": "a number",
    "soil.k0": "a number",
    "field.correlation": ", ".join(f'"{name}"' for name in KERNELS),
    "campaign.accuracy": "a share or a length",
    "soil.softening.rate": "a number",
    **{key: "a number" for row in RESIDUALS for key in (row.share_key, row.cov_key)},
}
"""What their types do not tell."""

TYPES = {int: "a whole number", float: "a number"}


class Key(NamedTuple):
    """A key: its dotted name, what it takes, and its default, `REQUIRED` or "none"."""

    name: str
    takes: str
    left_out: str


def keys(model: type[BaseModel] = SceneFile, prefix: str = "") -> Iterator[Key]:
    """Yield the keys of a section, and of those below it, in their order."""
    for name, field in model.model_fields.items():
        if prefix + name == "field.pairs":  # a key for each pair of properties
            continue
        if prefix == "layer." and name in Soil.model_fields:  # the keys of [soil] again, none of which is required
            continue
        if section := _section(field.annotation):
            yield from keys(section, f"{prefix}{name}.")
        else:
            yield Key(prefix + name, _takes(prefix + name, field), _left_out(prefix + name, field))


def _section(annotation: Any) -> type[BaseModel] | None:
    """Return the section that a field holds, or that of which it holds several."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next(filter(None, map(_section, get_args(annotation))), None)


def _takes(name: str, field: FieldInfo) -> str:
    if name in TAKES:
        return TAKES[name]
    if choices := _choices(field.annotation):
        return ", ".join(f'"{each}"' for each in choices)
    if kind := kind_of(name):
        return kind.name if kind.si_unit else "a number"
    types = (field.annotation, *get_args(field.annotation))
    return next((words for kept, words in TYPES.items() if kept in types), "a text")


def _choices(annotation: Any) -> tuple[Any, ...]:
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    return next(filter(None, map(_choices, get_args(annotation))), ())


def _left_out(name: str, field: FieldInfo) -> str:
    if field.is_required():
        return REQUIRED
    if field.default is None or field.default == ():
        return DEPENDS.get(name, "none")
    kind = kind_of(name)
    return shown_in_unit(field.default, kind) if kind is not None and kind.si_unit else f"{field.default}"


def markdown() -> str:
    """Return the keys as a table for README.md."""
    lines = ["| key | takes | left out |", "|---|---|---|"]
    return "\n".join([*lines, *(f"| `{name}` | {takes} | {left_out} |" for name, takes, left_out in keys())])
