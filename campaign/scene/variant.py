"""A scene with something else than its author wrote."""

from collections.abc import Sequence

from campaign.scene.cost import realization_seconds
from campaign.scene.loading import load_scene
from campaign.scene.scene import Scene


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
