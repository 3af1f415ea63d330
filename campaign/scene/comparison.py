"""How two scenes differ, in the units in which people read them."""

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Annotated, Any, get_args, get_origin

from pydantic import BeforeValidator

from campaign.scene.document import location_of, numbered_from_one, shown
from campaign.scene.sections import SceneFile
from campaign.scene.units import Kind, shown_in_unit
from campaign.scene.wording import section_fields

ABSENT = "absent"


def differences(here: Mapping[str, Any], there: Mapping[str, Any]) -> list[str]:
    """Say, key by key, how two identities differ; `there` is the one in the results directory."""
    return [
        f"{numbered_from_one(key)} is {one} here but {other} in the results directory"
        for key, (one, other) in differing_values(here, there).items()
    ]


def differing_values(here: Mapping[str, Any], there: Mapping[str, Any]) -> dict[str, tuple[str, str]]:
    """Return both values, as people write them, of each key in which two identities differ."""
    return {
        key: _texts(key, here.get(key), there.get(key))
        for key in sorted(here.keys() | there.keys())
        if here.get(key) != there.get(key)
    }


def kind_of(key: str) -> Kind | None:
    """Return the dimension of the quantity at a dotted key, None for what is no quantity."""
    *section, name = location_of(key)
    field = section_fields(SceneFile, tuple(section)).get(str(name))
    return next(_kinds(field.annotation, field.metadata), None) if field else None


def _kinds(annotation: Any, metadata: Any = ()) -> Iterator[Kind]:
    for validator in metadata:
        if isinstance(validator, BeforeValidator) and isinstance(validator.func, partial):
            yield from filter(None, [validator.func.keywords.get("kind")])
    if get_origin(annotation) is Annotated:
        metadata = annotation.__metadata__
        yield from _kinds(annotation.__origin__, metadata)
    else:
        for argument in get_args(annotation):
            yield from _kinds(argument)


def _texts(key: str, here: Any, there: Any) -> tuple[str, str]:
    """Write two different values of a key, to more digits than people need where they look alike."""
    kind = kind_of(key)
    texts = _text(here, kind), _text(there, kind)
    return texts if texts[0] != texts[1] else (repr(here), repr(there))


def _text(value: Any, kind: Kind | None) -> str:
    if value is None:
        return ABSENT
    if kind is None:
        return value if isinstance(value, str) else shown(value)
    return shown(_in_unit(value, kind)) if isinstance(value, list) else shown_in_unit(value, kind)


def _in_unit(value: Any, kind: Kind) -> Any:
    return [_in_unit(item, kind) for item in value] if isinstance(value, list) else shown_in_unit(value, kind)
