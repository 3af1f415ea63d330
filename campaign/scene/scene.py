"""A valid scene, and the identity that decides what its realizations are."""

import json
from collections.abc import Mapping
from hashlib import sha256
from typing import Any

from campaign.scene.ground_surface import surface_of
from campaign.scene.layer_soil import soils_of, written_out
from campaign.scene.sections import SceneFile, Soil

ADDED_LATER = {"soil.law": "mohr-coulomb", "water.unit_weight": 9810.0, "numerics.filling": "lattice"}
"""Values of keys that older scenes do not have; with these a scene is what it was before."""

NOT_IDENTITY = {"slide": {"front"}}
"""What decides the statistics and not the realizations, though it stands among what does."""


FRONT_WEDGE = 0.1
"""Side, in heights of the slope, of the square of ground ahead of a front whose `slide.front_area` is left out."""


class Scene(SceneFile):
    """A valid scene, with the name and the text it came from; every number in SI units."""

    name: str
    text: str
    overrides: tuple[str, ...] = ()

    @property
    def front_area(self) -> float:
        """Area of slid ground in m2 that the front of the mass leaves ahead of it; by default it grows with the slope.

        It does not depend on the cells, so that one front is followed on every mesh.
        """
        given = self.slide.front_area
        return (FRONT_WEDGE * surface_of(self.geometry).height) ** 2 if given is None else given

    @property
    def soils(self) -> tuple[Soil, ...]:
        """The soil of each layer, whole, from the surface down."""
        return soils_of(self)

    def identity(self) -> dict[str, Any]:
        """Return, by dotted key, every SI value that decides what realization k is; ready for JSON."""
        told = {"geometry", "soil", "water", "field", "numerics", "slide", "receptor", "boring"}
        sections = self.model_dump(mode="json", include=told, exclude=NOT_IDENTITY) | {"layer": written_out(self)}
        values = flatten(sections) | {"campaign.seed": self.campaign.seed, "slide.front_area": self.front_area}
        return {key: value for key, value in values.items() if value is not None and value != ADDED_LATER.get(key)}

    def digest(self) -> str:
        """Return the SHA-256 of the identity."""
        return sha256(json.dumps(self.identity(), sort_keys=True).encode()).hexdigest()


def flatten(tables: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return the values of nested tables by dotted key; the tables of an array have their number, from 0, as name."""
    values: dict[str, Any] = {}
    for name, value in tables.items():
        key, inner = prefix + name, _tables_in(value)
        values |= {key: value} if inner is None else flatten(inner, f"{key}.")
    return values


def _tables_in(value: Any) -> Mapping[str, Any] | None:
    """Return a table, or an array of tables by their number; None for anything else."""
    if isinstance(value, list | tuple) and all(isinstance(item, Mapping) for item in value):
        return {str(number): item for number, item in enumerate(value)}
    return value if isinstance(value, Mapping) else None
