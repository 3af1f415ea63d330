"""How much of the run-out depends on the way in which the slope is brought to failure.

A scene either releases its strength at rest or raises gravity while the ground yields. Neither is how a real slope
fails, so the difference between both in the run with mean strengths tells what the choice is worth.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from campaign.record import RealizationSummary
from campaign.scene import Scene, kept_scene

Protocol = Literal["release", "ramp"]

OTHER: dict[Protocol, Protocol] = {"release": "ramp", "ramp": "release"}


@dataclass(frozen=True)
class ReleaseComparison:
    """The deterministic run with the release protocol that the scene does not use.

    Parameters
    ----------
    other
        That protocol.
    summary
        Of its deterministic run.
    """

    other: Protocol
    summary: RealizationSummary

    @property
    def status(self) -> np.int8:
        """How that run ended."""
        return np.int8(self.summary.status)


def with_other_release(scene: Scene) -> Scene:
    """Return the scene of that run: the other protocol, no realization.

    Raises
    ------
    RefusalError
        If the scene is not valid with the other protocol.
    """
    other = kept_scene(scene.text, [*scene.overrides, f"numerics.gravity={OTHER[scene.numerics.gravity]}"])
    none = other.campaign.model_copy(update={"realizations": 0})
    return other.model_copy(update={"campaign": none, "name": scene.name})
