"""A scene as it was written: the TOML text, the overrides, and where each key stands."""

import json
import re
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from importlib.resources import files
from pathlib import Path
from typing import Any

from campaign.errors import SceneError
from campaign.scene.alternatives import replaced_by

Location = tuple[str | int, ...]

SCENES = files("campaign") / "scenes"
HEADER = re.compile(r"""\s*\[\s*([\w.\-\s]+?)\s*\]\s*(?:#.*)?""")
ARRAY_HEADER = re.compile(r"""\s*\[\[\s*([\w.\-\s]+?)\s*\]\]\s*(?:#.*)?""")
ASSIGNMENT = re.compile(r"""\s*([\w.\-"']+(?:\s*\.\s*[\w\-"']+)*)\s*=""")
BARE_QUANTITY = re.compile(r"=\s*[+-]?[\d.]+(?:[eE][+-]?\d+)?\s*[A-Za-z°%]")

ARRAYS = {
    "receptor": """receptor=[{name="road", x="42 m"}]""",
    "layer": """layer=[{name="clay", top="5 m"}]""",
    "boring": """boring=[{name="B1", x="30 m", cohesion=[["2 m", "20 kPa"]]}]""",
}
"""Arrays of tables that a scene may have, with an override that sets the whole."""

DEEPEST = 8
TOO_DEEP = "tables and lists are nested too deeply; a scene needs four levels"


@dataclass(frozen=True)
class Document:
    """The tables of a scene file with the overrides applied, and enough of the text to point at a key."""

    name: str
    file: str
    text: str
    tables: dict[str, Any]
    overrides: tuple[str, ...] = ()
    lines: Mapping[Location, int] = field(default_factory=dict)

    def value(self, location: Location) -> Any:
        """Return the value as written; raises LookupError if it is not."""
        value: Any = self.tables
        for part in location:
            value = value[part]
        return value

    def place(self, location: Location) -> str:
        """Name a key and where it was written, for the start of a message."""
        keys = tuple(part for part in location if isinstance(part, str))
        point = _point(location)
        for override in reversed(self.overrides):
            path = override_key(override)
            target = _target(path)
            created = target[: len(location)] == location and location not in self.lines
            if created or target == location[: len(target)]:
                return f"--set {'.'.join(path)}{'' if len(path) > len(keys) else point}"
        known = (self.lines[location[:n]] for n in range(len(location), 0, -1) if location[:n] in self.lines)
        line = next(known, None)
        return f"{'.'.join(keys)} ({self.file}{f', line {line}' if line else ''}{point})"


def builtin_scenes() -> dict[str, str]:
    """Return the title of each built-in scene by name."""
    texts = {Path(entry.name).stem: entry.read_text("utf-8") for entry in SCENES.iterdir() if entry.is_file()}
    return {name: tomllib.loads(text)["title"] for name, text in sorted(texts.items())}


def read_document(source: str | Path, overrides: Iterable[str] = ()) -> Document:
    """Read a scene file, or a built-in scene by its name, and apply the overrides.

    Raises
    ------
    SceneError
        If there is no such scene, or the file is not TOML, or an override cannot be read.
    """
    file, text = _read(source)
    return document_of(text, overrides, file)


def document_of(text: str, overrides: Iterable[str] = (), file: str = "scene.toml") -> Document:
    """Apply the overrides to the text of a scene; `file` is what messages call it.

    Raises
    ------
    SceneError
        If it is not TOML, or an override cannot be read.
    """
    tables = _parse(text, file)
    overrides = tuple(re.sub(r"[\r\n]+", " ", override) for override in overrides)  # each is told as a line
    if messages := [message for override in overrides if (message := _apply(override, tables))]:
        raise SceneError(messages)
    return Document(Path(file).stem, Path(file).name, text, tables, overrides, key_lines(text))


def key_lines(text: str) -> dict[Location, int]:
    """Map each key and section of a TOML text to its line, counted from 1; tables of an array have a number from 0."""
    section: Location = ()
    path: Location
    lines: dict[Location, int] = {}
    tables: Counter[Location] = Counter()
    for number, line in enumerate(text.split("\n"), start=1):
        if header := HEADER.fullmatch(line):
            section = path = _split(header[1])
        elif header := ARRAY_HEADER.fullmatch(line):
            array = _split(header[1])
            section = path = (*array, tables[array])
            tables[array] += 1
        elif assignment := ASSIGNMENT.match(line):
            path = section + _split(assignment[1])
        else:
            continue
        for depth in range(1, len(path) + 1):
            lines.setdefault(path[:depth], number)
    return lines


def location_of(dotted: str) -> Location:
    """Return the location of a dotted key, as "receptor.0.x" for that of the first receptor."""
    return tuple(int(part) if part.isdecimal() else part for part in dotted.split("."))


def override_key(override: str) -> tuple[str, ...]:
    """Return the key of an override KEY=VALUE as its parts."""
    return _split(override.partition("=")[0])


def numbered_from_one(dotted: str) -> str:
    """Return a dotted key as `--set` takes it, "receptor.1.x" for what is kept as "receptor.0.x"."""
    return ".".join(str(part + 1) if isinstance(part, int) else part for part in location_of(dotted))


def _target(path: tuple[str, ...]) -> Location:
    """Return the location that an override changes."""
    if path[0] not in ARRAYS or len(path) == 1 or not path[1].isdecimal():
        return path
    return (path[0], int(path[1]) - 1, *path[2:])


def in_force(overrides: Iterable[str]) -> list[str]:
    """Return the overrides without those that a later one of the same key replaces."""
    kept: dict[tuple[str, ...], str] = {}
    for override in overrides:
        kept.pop(override_key(override), None)
        kept[override_key(override)] = override
    return list(kept.values())


def shown(value: Any) -> str:
    """Write a value as the scene file would, shortened if it is long."""
    return _short(json.dumps(value, ensure_ascii=False, default=str))


def _short(text: str) -> str:
    return text if len(text) <= 60 else f"{text[:57]}..."


def _read(source: str | Path) -> tuple[str, str]:
    builtin = SCENES / f"{source}.toml"
    path = Path(source)
    try:
        if len(path.parts) == 1 and builtin.is_file():
            return builtin.name, builtin.read_text("utf-8")
        # Editors on Windows put a byte order mark in front.
        return str(path), path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise SceneError([_unknown_scene(str(source))]) from None
    except (OSError, ValueError) as error:  # ValueError for what is not UTF-8, and for a name that holds a NUL
        raise SceneError(
            [f"The scene {shown(str(source))} cannot be read: {error}. Give a text file in UTF-8."]
        ) from error


def _unknown_scene(source: str) -> str:
    names = list(builtin_scenes())
    near = get_close_matches(source, [*names, *(path.name for path in Path().glob("*.toml"))], n=1, cutoff=0.75)
    guess = f' Did you mean "{near[0]}"?' if near else ""
    return f'"{source}" is neither a file nor a built-in scene; built in are {", ".join(names)}.{guess}'


def _parse(text: str, file: str) -> dict[str, Any]:
    try:
        return _loaded(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"line (\d+)", str(error))
        line = text.split("\n")[int(found[1]) - 1].strip() if found else ""
        written = f" That line reads: {line} ." if line else ""
        remedy = ' Put a value with a unit in quotes, for instance "20 kPa".' if BARE_QUANTITY.search(line) else ""
        raise SceneError([f"{Path(file).name} is not valid TOML: {error}.{written}{remedy}"]) from error


def _loaded(text: str) -> dict[str, Any]:
    """Read TOML; what Python cannot hold, or the rest of this program not follow, is an error of the text as well."""
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except RecursionError:
        raise tomllib.TOMLDecodeError(TOO_DEEP) from None
    except ValueError:
        raise tomllib.TOMLDecodeError("a number has thousands of digits") from None
    if _levels(tables) > DEEPEST:
        raise tomllib.TOMLDecodeError(TOO_DEEP)
    return tables


def _levels(value: Any) -> int:
    """Return how many tables and lists lie within each other, counted up to one more than is allowed."""
    level, inside = 0, [value]
    while level <= DEEPEST and (inside := [part for part in inside if isinstance(part, dict | list)]):
        level += 1
        inside = [item for part in inside for item in (part.values() if isinstance(part, dict) else part)]
    return level


def _apply(override: str, tables: dict[str, Any]) -> str | None:
    *sections, last = path = override_key(override)
    if "=" not in override or not all(path):
        return (
            f'--set {_short(override)} has no key and value; write KEY=VALUE, for instance --set numerics.cell="0.5 m".'
        )
    if len(path) > DEEPEST:
        return f"--set {_short('.'.join(path))}: {TOO_DEEP}."
    inner: Any = tables
    for depth, part in enumerate(sections, start=1):
        inner = _inside(inner, part)
        if not isinstance(inner, dict | list):
            return f"--set {'.'.join(path)}: {_why_not(path, depth, inner, tables)}"
    if not isinstance(inner, dict):
        return f"--set {'.'.join(path)}: {_why_not(path, len(path), inner, tables)}"
    for name in replaced_by(path):
        inner.pop(name, None)
    inner[last] = _override_value(override.partition("=")[2].strip())
    return None


def _inside(tables: Any, part: str) -> Any:
    """Return the section of that name, which is made if it is not there, or the table of an array of that number."""
    if isinstance(tables, dict):
        return tables.setdefault(part, [] if part in ARRAYS else {})
    return tables[int(part) - 1] if part.isdecimal() and 1 <= int(part) <= len(tables) else None


def _why_not(path: tuple[str, ...], depth: int, inner: Any, tables: dict[str, Any]) -> str:
    """Say why no key can be set in what is found at the first parts of a path."""
    before, array = ".".join(path[: depth - 1]), path[0]
    if depth == 2 and array in ARRAYS and isinstance(tables[array], list):
        number = len(tables[array])
        there = f"{array} is a list of {number}" if number else f"the scene has no [[{array}]]"
        one = f"one key of one of them, as {array}.1.name, or " if number else ""
        return f"{there}; set {one}all of it, for instance --set '{ARRAYS[array]}'."
    if inner is None or isinstance(inner, list):
        return f"{before} is a list; set all of it."
    return f"{'.'.join(path[:depth])} is a value, not a section; set it itself."


def _override_value(text: str) -> Any:
    # A shell strips the quotes of --set numerics.cell="0.5 m", so what is not TOML is text.
    try:
        return _loaded(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def _split(dotted: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in dotted.split("."))


def _point(location: Location) -> str:
    """Name the first number in a location, counted from 1: of a table by its section, of anything else as a point."""
    for depth, part in enumerate(location):
        if isinstance(part, int):
            return f", {location[0] if depth == 1 else 'point'} {part + 1}"
    return ""
