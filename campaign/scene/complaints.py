"""Sentences about a valid scene that point at a key as it was written."""

from collections.abc import Callable, Iterable
from typing import NamedTuple

from campaign.scene import Scene
from campaign.scene.document import document_of, location_of
from campaign.scene.wording import wrong_value


class Complaint(NamedTuple):
    """What is to be said about the value of a key, worded to follow "KEY is VALUE, but"."""

    key: str
    text: str


Check = Callable[..., Complaint | None]


def found(complaints: Iterable[Complaint | None]) -> list[Complaint]:
    """Return the complaints that there are."""
    return [complaint for complaint in complaints if complaint is not None]


def sentences(complaints: Iterable[Complaint], scene: Scene) -> list[str]:
    """Write complaints as sentences with the place and the value as the user wrote them."""
    document = document_of(scene.text, scene.overrides, f"{scene.name}.toml")
    return [wrong_value(location_of(key), text, document) for key, text in complaints]
