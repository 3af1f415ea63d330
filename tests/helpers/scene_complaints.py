"""What is wrong with a scene, as tests ask for it."""

from pathlib import Path
from typing import Any

import pytest

from campaign.errors import SceneError
from campaign.scene import load_scene
from campaign.scene.check import mistakes
from campaign.scene.document import Document, read_document
from campaign.scene.sections import SceneFile

EXAMPLE = read_document("ma2023")
FRICTION = EXAMPLE.text[EXAMPLE.text.index("[soil.friction_angle]") : EXAMPLE.text.index("[soil.softening]")]
UNDRAINED = (
    ('law = "mohr-coulomb" ', 'law = "tresca" '),
    (FRICTION, ""),
    ("cross_correlation = -0.5 ", "cross_correlation = 0.0 "),
)
"""Changes that give ma2023 undrained strength."""

SURFACE = [["0 m", "19 m"], ["20 m", "19 m"], ["35 m", "4 m"], ["75 m", "4 m"]]


def complaints(*overrides: str, source: str | Path = "ma2023") -> list[str]:
    """Return the messages of the refusal that must come."""
    with pytest.raises(SceneError) as refusal:
        load_scene(source, overrides)
    return refusal.value.messages


def complaint(*overrides: str, source: str | Path = "ma2023") -> str:
    """Return the only message of the refusal that must come."""
    messages = complaints(*overrides, source=source)
    assert len(messages) == 1, messages
    return messages[0]


def any_complaints(*overrides: str) -> list[str]:
    """Return the messages of a refusal, or none if ma2023 is accepted."""
    try:
        load_scene("ma2023", overrides)
    except SceneError as refusal:
        return refusal.messages
    return []


def written(directory: Path, *changes: tuple[str, str]) -> Path:
    """Write ma2023 with parts of its text replaced."""
    text = EXAMPLE.text
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path = directory / "slope.toml"
    path.write_text(text, "utf-8")
    return path


def line_of(text: str, path: Path) -> int:
    """Return the number of the first line that begins with the text."""
    return next(number for number, line in enumerate(path.read_text("utf-8").split("\n"), 1) if line.startswith(text))


def found_in(tables: dict[str, Any]) -> list[str]:
    """Return the mistakes of a scene that is written like ma2023."""
    return mistakes(Document("scene", "scene.toml", "", tables), SceneFile, EXAMPLE)
