"""Find every mistake in a scene at once: keys by themselves, then the rules across keys."""

from collections.abc import Mapping
from copy import deepcopy
from itertools import takewhile
from typing import Any

from pydantic import BaseModel, ValidationError

from campaign.scene.document import Document, Location, location_of
from campaign.scene.layer_soil import soils_of, written_out
from campaign.scene.rules import (
    cross_correlation,
    field,
    geometry,
    layer,
    numerics,
    receptor,
    residual,
    slide,
    soil,
    water,
)
from campaign.scene.scene import flatten
from campaign.scene.sections import FrictionAngle, SceneFile
from campaign.scene.wording import explain, section_fields, wrong_value

Key = tuple[str | int, ...]

# A cell too large breaks rules of the ground as well, and is to be read first.
SECTIONS = (numerics, geometry, slide, soil, residual, layer, water, field, cross_correlation, receptor)


def mistakes(document: Document, model: type[BaseModel], example: Document) -> list[str]:
    """Return a sentence for every mistake.

    Parameters
    ----------
    document
        The scene as written.
    model
        The model of the whole file.
    example
        A valid scene with every key that the model requires.
    """
    details = []
    try:
        model.model_validate(document.tables)
    except ValidationError as error:
        details = error.errors(include_url=False)
    faulty = {_key(error["loc"]) for error in details}
    sound = _sound_values(document, model, faulty, example)
    broken = (complaint for section in SECTIONS for complaint in section.RULES.broken(sound))
    return [
        *explain(details, document, model, example),
        *_geometry_choice(document),
        *_repeated_names(document),
        *_half_given_friction(document),
        *(wrong_value(location_of(key), complaint, document) for key, complaint in broken),
    ]


def _key(location: Location) -> Key:
    """Return the key of a location; a mistake in a list makes the whole faulty, but one in a table of an array not."""
    following = (*location[1:], None)
    kept = takewhile(lambda pair: str in map(type, pair), zip(location, following, strict=True))
    return tuple(part for part, _ in kept)


def _geometry_choice(document: Document) -> list[str]:
    geometry = document.tables.get("geometry")
    if not isinstance(geometry, dict):
        return []
    slope, surface = (document.place(("geometry", name)) for name in ("slope", "surface"))
    if {"slope", "surface"} <= geometry.keys():
        return [f"{slope} and {surface} contradict each other; remove one of them."]
    if not {"slope", "surface"} & geometry.keys():
        return [f'{slope} is not given; add it with its height, for instance height = "15 m", or a geometry.surface.']
    return []


def _repeated_names(document: Document) -> list[str]:
    return [message for array in ("receptor", "layer", "boring") for message in _repeated_names_in(array, document)]


def _repeated_names_in(array: str, document: Document) -> list[str]:
    names = [table.get("name") if isinstance(table, dict) else None for table in _tables_of(array, document)]
    return [
        wrong_value((array, number, "name"), f"{array} {names.index(name) + 1} has that name, too", document)
        for number, name in enumerate(names)
        if isinstance(name, str) and name in names[:number]
    ]


def _half_given_friction(document: Document) -> list[str]:
    """Refuse a friction angle that a layer gives in part where the soil has none that completes it."""
    soil = document.tables.get("soil")
    if not isinstance(soil, dict) or "friction_angle" in soil:
        return []
    friction_angles = {
        number: table["friction_angle"]
        for number, table in enumerate(_tables_of("layer", document))
        if isinstance(table, dict) and isinstance(table.get("friction_angle"), dict)
    }
    return [
        f"{document.place(('layer', number, 'friction_angle'))} has no {name}; add it, since [soil] has no friction "
        "angle from which it could be taken."
        for number, given in friction_angles.items()
        for name, field in FrictionAngle.model_fields.items()
        if field.is_required() and name not in given
    ]


def _tables_of(array: str, document: Document) -> list[Any]:
    tables = document.tables.get(array)
    return tables if isinstance(tables, list) else []


def _sound_values(document: Document, model: type[BaseModel], faulty: set[Key], example: Document) -> dict[str, Any]:
    """Return the SI values of all keys but the faulty ones, so that rules across keys can still speak.

    Faulty keys are replaced by those of the example, which makes the whole valid, and then left out.
    """
    tables = deepcopy(document.tables)
    for key in _outermost(faulty):
        _replace(key, tables, example.tables, section_fields(model, key[:-1]))
    whole = model.model_validate(tables)
    written, dotted = whole.model_dump(mode="json"), [".".join(map(str, key)) for key in faulty]
    if isinstance(whole, SceneFile):
        written |= {"layer": written_out(whole), "laws": [soil.law for soil in soils_of(whole)]}
        of_soil = [key.removeprefix("soil.") for key in dotted if key.startswith("soil.")]
        dotted += [f"layer.{number}.{key}" for number in range(len(whole.layer)) for key in of_soil]
    values = flatten(written)
    return {name: value for name, value in values.items() if not any(_within(name, key) for key in dotted)}


def _outermost(keys: set[Key]) -> set[Key]:
    """Return the keys that lie within none of the others."""
    return {key for key in keys if not any(key[:length] in keys for length in range(1, len(key)))}


def _replace(key: Key, tables: Any, example: Mapping[Any, Any], fields: Mapping[Any, Any]) -> None:
    """Replace a key by that of the example, or of its field where a scene need not have such a section."""
    *sections, name = key
    for section in sections:
        tables, example = tables[section], example.get(section, {})
    if name in example:
        tables[name] = deepcopy(example[name])
    elif name in fields and fields[name].is_required() and fields[name].examples:
        tables[name] = fields[name].examples[0]
    else:
        tables.pop(name, None)


def _within(name: str, key: str) -> bool:
    return name == key or name.startswith(f"{key}.")
