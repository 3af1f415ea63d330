"""Realizations of a campaign that are repeated in another setting, whatever comes of them."""

import math

import numpy as np

from campaign.record import UNHINDERED, Front, RealizationSummary, Status
from campaign.scene import Scene
from campaign.seeds import BASELINE

UNASKED = RealizationSummary(BASELINE, Status.no_slide, math.nan, math.nan, math.nan)
"""Stands for the deterministic run where nobody asks for it."""


def without_rule(scene: Scene, realizations: int) -> Scene:
    """Return the scene of realizations 0, 1, ..., so many in all: no rule ends it earlier, no failure is too many."""
    whole = {
        "realizations": realizations,
        "minimum": realizations + 1,
        "block": realizations + 1,
        "max_failed_fraction": 1.0,
    }
    return scene.model_copy(update={"campaign": scene.campaign.model_copy(update=whole)})


def unhindered_runout(summary: RealizationSummary, front: Front) -> float:
    """Return the run-out of a slide in m, NaN of all that did not slide or had the wall ahead in the way."""
    return summary.runout(front) if summary.status in UNHINDERED else np.nan
