"""What accuracy a comparison is made for."""

from campaign.scene.constraints import Tolerance, tolerance
from campaign.scene.scene import Scene

NEAR = Tolerance(0.05, is_relative=True)
"""Of the mean run-out, where the scene asks for none."""


def wanted_accuracy(scene: Scene, mean: float) -> float:
    """Return what the scene asks for, in m, of a mean run-out in m."""
    asked = scene.campaign.accuracy
    return (tolerance(asked) if asked else NEAR).metres(mean)
