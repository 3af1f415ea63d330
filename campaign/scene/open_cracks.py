"""Ground that cracks: what its cut-off of tension tells of a slide, and what it does not."""

from collections.abc import Iterator
from math import inf, tan

from campaign.scene.complaints import Complaint
from campaign.scene.first_look import mean_peak
from campaign.scene.layer_soil import gives
from campaign.scene.layers import layer_scenes
from campaign.scene.scene import Scene

KEY = "soil.tension_cutoff"


def open_cracks(scene: Scene) -> Iterator[Complaint]:
    """Yield, for each cut-off that is below c cot(phi) at the mean strengths, that gaps do not close again."""
    for number, layer in enumerate(layer_scenes(scene)):
        cutoff, peak = layer.soil.tension_cutoff, mean_peak(layer)
        apex = peak.cohesion / tan(peak.friction_angle) if peak.friction_angle else inf
        is_own = not number or gives(scene.layer[number - 1], KEY)
        if cutoff is not None and cutoff < apex and is_own:
            yield Complaint(
                KEY if not number else f"layer.{number - 1}.tension_cutoff",
                "gaps that open stay open when the ground is compressed again, so that slides take more room and run "
                "too far; trust it for how a slope begins to fail, and compare run-outs with those without it",
            )
