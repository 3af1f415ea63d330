"""The models of a scene: the same realizations with other cells, and in softer ground, whose waves allow longer steps.

Realization k is the same random field in all of them.
"""

from collections.abc import Mapping
from typing import NamedTuple

from campaign.accuracy.pursuit import Ladder, Model
from campaign.errors import RefusalError, SceneError
from campaign.scene import Scene
from campaign.scene.cost import realization_seconds
from campaign.scene.variant import in_all_layers, variant_of

OWN = "own"
"""The name of the scene as it is."""

HALF, QUARTER = "half-cell", "quarter-cell"

SOFTER = 10.0
"""By which Young's modulus is divided where steps may be longer, by the root of it: slides are plastic, and run as far
but for some per cent."""


class Setting(NamedTuple):
    """Cell and Young's modulus of a model, relative to those of the scene."""

    cell: float
    stiffness: float


SETTINGS = {
    QUARTER: Setting(0.25, 1.0),
    HALF: Setting(0.5, 1.0),
    OWN: Setting(1.0, 1.0),
    "softer": Setting(1.0, 1 / SOFTER),
    "double-cell-softer": Setting(2.0, 1 / SOFTER),
}
"""From the finest mesh to the cheapest."""


class Models(NamedTuple):
    """The models that a scene has.

    Attributes
    ----------
    ladders : tuple of ladders
        The first has half the cell as its finest mesh, the second a quarter of it.
    scenes : mapping
        Of each model.
    """

    ladders: tuple[Ladder, ...]
    scenes: Mapping[Model, Scene]


def models_of(scene: Scene) -> Models:
    """Return the models of a scene, without those that are no valid scenes.

    Raises
    ------
    RefusalError
        If half the cell is none: nothing tells the error of the mesh then.
    """
    scenes = {name: valid for name in SETTINGS if (valid := _with(scene, name)) is not None}
    if HALF not in scenes:
        raise RefusalError("An accuracy takes runs with half the cell, which is not valid in this scene.")
    models = {Model(name, realization_seconds(changed)): changed for name, changed in scenes.items()}
    whole = tuple(models)
    coarser = tuple(model for model in models if model.name != QUARTER)
    return Models((coarser,) if coarser == whole else (coarser, whole), models)


def _with(scene: Scene, name: str) -> Scene | None:
    if name == OWN:
        return scene
    cell, stiffness = SETTINGS[name]
    changes = [
        f"numerics.cell={cell * scene.numerics.cell!r} m",
        *in_all_layers(scene, "soil.young_modulus", lambda soil: f"{stiffness * soil.young_modulus!r} Pa"),
    ]
    try:
        return variant_of(scene, changes)
    except SceneError:
        return None
