"""The wording of mistakes in a scene: what stands where, why it cannot be, and what to write instead."""

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from campaign.scene.document import Document, Location, shown

TWO_COORDINATES = 'a point has two coordinates, for instance ["20 m", "4 m"]'
EXPECTED = {
    "bool_type": "true or false is needed",
    "finite_number": "a finite number is needed",
    "float_type": "a number without unit and quotes is needed",
    "int_type": "a whole number without quotes is needed",
    "string_type": "text in quotes is needed",
    "too_long": TWO_COORDINATES,
    "tuple_type": 'a list is needed, for instance [["0 m", "19 m"], ["20 m", "4 m"]]',
    "model_type": "a section of keys is needed here",
}


def explain(details: list[ErrorDetails], document: Document, model: type[BaseModel], example: Document) -> list[str]:
    """Turn pydantic's errors into sentences.

    Parameters
    ----------
    details
        `ValidationError.errors()`.
    document
        The scene as written.
    model
        The model it was checked against.
    example
        A complete scene, from which a missing key is illustrated.
    """
    unknown = [error["loc"] for error in details if error["type"] == "extra_forbidden"]
    # A misspelt required key is both unknown and missing; one message is enough.
    misspelt = {(*location[:-1], _intended(location, model)) for location in unknown}
    return [
        _sentence(error, document, model, example)
        for error in details
        if not (error["type"] == "missing" and error["loc"] in misspelt)
    ]


def wrong_value(location: Location, complaint: str, document: Document) -> str:
    """Return the sentence "KEY (FILE, LINE) is VALUE, but COMPLAINT."."""
    return f"{document.place(location)} {_state(location, document)}, but {complaint}."


def _state(location: Location, document: Document) -> str:
    """Say what a value is; what a layer leaves out is as in [soil]."""
    try:
        return f"is {shown(document.value(location))}"
    except LookupError:
        array, *rest = location
        return "is not given" if array != "layer" else _state_as_in_soil(("soil", *rest[1:]), document)


def _state_as_in_soil(location: Location, document: Document) -> str:
    try:
        return f"is {shown(document.value(location))} as in [soil]"
    except LookupError:
        return "is not given"


def section_fields(model: type[BaseModel], location: Location) -> Mapping[str, Any]:
    """Return the fields of the section at `location`; none if it is not a section."""
    for part in location:
        if isinstance(part, int):  # the fields of one table of an array are those of all
            continue
        field = model.model_fields.get(part)
        options = (field.annotation, *get_args(field.annotation)) if field else ()
        sections = [option for option in options if isinstance(option, type) and issubclass(option, BaseModel)]
        if not sections:
            return {}
        model = sections[0]
    return model.model_fields


def _sentence(error: ErrorDetails, document: Document, model: type[BaseModel], example: Document) -> str:
    location = error["loc"]
    if error["type"] == "missing":
        return _missing(location, document, model, example)
    if error["type"] == "extra_forbidden":
        return _unknown(location, document, model)
    return wrong_value(location, _complaint(error), document)


def _complaint(error: ErrorDetails) -> str:
    if error["type"] == "value_error":
        return str(error["ctx"]["error"])
    if error["type"] == "literal_error":
        return f"it must be {error['ctx']['expected'].replace(chr(39), chr(34))}"
    return EXPECTED.get(error["type"], error["msg"])


def _missing(location: Location, document: Document, model: type[BaseModel], example: Document) -> str:
    *section, name = location
    if isinstance(name, int):
        return wrong_value(tuple(section), TWO_COORDINATES, document)
    field = section_fields(model, tuple(section))[name]
    value = field.examples[0] if field.examples else example.value(location)
    remedy = _as_written(location, value, section_fields(model, location))
    place = document.place(tuple(section)) if section else document.file
    return f"{place} has no {name}; add {remedy}."


def _as_written(location: Location, value: Any, fields: Mapping[str, Any]) -> str:
    if not isinstance(value, dict):
        return f"it, for instance {location[-1]} = {shown(value)}"
    needed = [key for key, field in fields.items() if field.is_required()]
    keys = ", ".join(
        f"{key} = {shown(item)}" for key, item in value.items() if key in needed and not isinstance(item, dict)
    )
    return f"a section [{'.'.join(map(str, location))}]" + (f", for instance with {keys}" if keys else "")


def _unknown(location: Location, document: Document, model: type[BaseModel]) -> str:
    *section, name = location
    known = ", ".join(section_fields(model, tuple(section)))
    home = next((".".join(key) for key in _keys(model) if key[-1] == name), None)
    near = _intended(location, model)
    if near:
        remedy = f'did you mean "{near}"?'
    elif home:
        remedy = f'it belongs to another section, as "{home}".'
    else:
        remedy = f"the keys here are {known}."
    return f'{document.place(location)}: there is no key "{name}"; {remedy}'


def _intended(location: Location, model: type[BaseModel]) -> str | None:
    near = get_close_matches(str(location[-1]), section_fields(model, location[:-1]), n=1)
    return near[0] if near else None


def _keys(model: type[BaseModel], section: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    for name in section_fields(model, section):
        yield (*section, name)
        yield from _keys(model, (*section, name))
