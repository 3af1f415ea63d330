"""A scene with something else than its author wrote."""

from collections.abc import Callable, Sequence

from campaign.scene.cost import realization_seconds
from campaign.scene.layer_soil import gives
from campaign.scene.loading import load_scene
from campaign.scene.scene import Scene
from campaign.scene.sections import Soil
from campaign.scene.units import PRESSURE, shown_in_unit


def variant_of(scene: Scene, changes: Sequence[str]) -> Scene:
    """Return the scene with changes as `--set` takes them; where a realization costs more it may take longer, too.

    Raises
    ------
    SceneError
        If that is no valid scene.
    """
    if not changes:
        return scene
    changed = load_scene(scene, changes)
    longer = max(1.0, realization_seconds(changed) / realization_seconds(scene))
    timeout = {"realization_timeout": longer * scene.campaign.realization_timeout}
    return changed.model_copy(update={"campaign": scene.campaign.model_copy(update=timeout)})


def with_cell(scene: Scene, factor: float) -> str:
    """Return the change to so many times the cell."""
    return f"numerics.cell={factor * scene.numerics.cell:g} m"


def with_stiffness(scene: Scene, factor: float) -> tuple[str, ...]:
    """Return the changes to so many times Young's modulus, with which waves and steps change by the root of it."""
    return in_all_layers(scene, "soil.young_modulus", lambda soil: shown_in_unit(factor * soil.young_modulus, PRESSURE))


def in_all_layers(scene: Scene, key: str, value: Callable[[Soil], str]) -> tuple[str, ...]:
    """Return the changes of a key of [soil], and of the layers that do not leave it out, to a value for each soil."""
    own = (
        f"layer.{number}.{key.partition('.')[2]}={value(scene.soils[number])}"
        for number, layer in enumerate(scene.layer, start=1)
        if gives(layer, key)
    )
    return (f"{key}={value(scene.soil)}", *own)
