"""A scene as TOML again, from its text with the overrides applied: values as they were written, without comments."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from campaign.scene.document import document_of
from campaign.scene.scene import Scene


def toml_of(scene: Scene, without: frozenset[str] = frozenset()) -> str:
    """Return the text of a scene file that says what a scene with its overrides says.

    Parameters
    ----------
    scene
    without
        Dotted keys of which the overrides are left out, so that they are as in the scene's own file.
    """
    overrides = [each for each in scene.overrides if each.partition("=")[0].strip() not in without]
    return "\n".join(_table(document_of(scene.text, overrides).tables)) + "\n"


def _table(table: Mapping[str, Any], path: str = "") -> Iterator[str]:
    """Yield the lines of a table: its values first, since what follows the header of another table belongs to that."""
    inner = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    several = {key: value for key, value in table.items() if _is_array_of_tables(value)}
    values = {key: value for key, value in table.items() if key not in inner | several}
    yield from (f"{key} = {_value(value)}" for key, value in values.items())
    for key, value in inner.items():
        yield from ("", f"[{path}{key}]", *_table(value, f"{path}{key}."))
    for key, rows in several.items():
        for row in rows:
            yield from ("", f"[[{path}{key}]]", *_table(row, f"{path}{key}."))


def _is_array_of_tables(value: Any) -> bool:
    return isinstance(value, list) and any(isinstance(item, Mapping) for item in value)


def _value(value: Any) -> str:
    """Write a text, a number or a list of them; JSON is TOML there."""
    return json.dumps(value, ensure_ascii=False)
