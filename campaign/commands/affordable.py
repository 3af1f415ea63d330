"""What cannot be run is refused at the door, before anything of its size is allocated."""

from campaign.commands.machine import memory
from campaign.errors import SceneError
from campaign.scene import Scene
from campaign.scene.complaints import sentences
from campaign.scene.limits import refusals


def refuse_unaffordable(scene: Scene) -> None:
    """Refuse a valid scene that cannot be run here.

    Raises
    ------
    SceneError
        With every reason.
    SamplerError
        If data of borings lie too close together.
    """
    complaints = refusals(scene, memory())
    if not complaints:
        from campaign.simulation.field_size import field_size, too_large

        complaints = [complaint] if (complaint := too_large(field_size(scene))) else []
    if complaints:
        raise SceneError(sentences(complaints, scene))
    if scene.boring:
        from campaign.simulation.scene_sampler import refuse_crowded_data

        refuse_crowded_data(scene)
