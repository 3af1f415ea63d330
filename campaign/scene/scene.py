"""A valid scene, and the identity that decides what its realizations are."""

import json
from collections.abc import Mapping
from hashlib import sha256
from typing import Any

from campaign.scene.sections import SceneFile

ADDED_LATER = {"soil.law": "mohr-coulomb"}
"""Values of keys that older scenes do not have; with these a scene is what it was before."""


class Scene(SceneFile):
    """A valid scene, with the name and the text it came from; every number in SI units."""

    name: str
    text: str
    overrides: tuple[str, ...] = ()

    def identity(self) -> dict[str, Any]:
        """Return, by dotted key, every SI value that decides what realization k is; ready for JSON."""
        sections = self.model_dump(mode="json", include={"geometry", "soil", "field", "numerics", "slide"})
        values = flatten(sections) | {"campaign.seed": self.campaign.seed}
        return {key: value for key, value in values.items() if value is not None and value != ADDED_LATER.get(key)}

    def digest(self) -> str:
        """Return the SHA-256 of the identity."""
        return sha256(json.dumps(self.identity(), sort_keys=True).encode()).hexdigest()


def flatten(tables: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return the values of nested tables by dotted key."""
    values: dict[str, Any] = {}
    for name, value in tables.items():
        key = prefix + name
        values |= flatten(value, f"{key}.") if isinstance(value, Mapping) else {key: value}
    return values
