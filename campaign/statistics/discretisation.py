"""The discretisation error of the mean run-out, from a few slides repeated with half the cell.

Realization k is the same ground on every mesh, so that the difference between its two run-outs is free of the scatter
between realizations, and a few pairs tell what the whole campaign with half the cell would change. The estimate is that
plain difference. Richardson's extrapolation would multiply it by 2^p / (2^p - 1), but a run-out at two cells does not
reveal the order p; at first order the error is twice the difference.
"""

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from campaign.record import Status
from campaign.scene import Scene
from campaign.scene.cost import HALF_CELL_COST
from campaign.seeds import BASELINE
from campaign.statistics.intervals import Interval, Sample, mean_interval
from campaign.statistics.repetition import unhindered_runout, without_rule
from campaign.statistics.tally import Tally

METHOD = (
    "plain difference between run-outs of the same random fields with half the cell and with the cell; no "
    "extrapolation, because the order of convergence is not known (at first order the error is twice the difference)"
)


class Discretisation(NamedTuple):
    """What halving the cell changes.

    Attributes
    ----------
    cell : float
        The scene's own, in m.
    differences : array (pairs,)
        Final run-out of realization 0, 1, ... with half the cell minus that with the cell, in m; NaN unless it was
        repeated and both slid, without the wall ahead in the way.
    deterministic : float
        The same for the run with mean strengths.
    confidence : float
        Of `interval`.
    repeated, standing : int
        Slides that were repeated, without the run with mean strengths, and how many of them do not slide with half the
        cell.
    """

    cell: float
    differences: Sample
    deterministic: float
    confidence: float
    repeated: int = 0
    standing: int = 0

    @property
    def interval(self) -> Interval:
        """Mean difference in m, with Student's t interval."""
        known = self.differences[np.isfinite(self.differences)]
        return mean_interval(known, self.confidence)

    @property
    def error(self) -> float:
        """Estimated size in m of the discretisation error of the mean; NaN without a pair."""
        return abs(self.interval.estimate)


def with_half_cell(scene: Scene, pairs: int) -> Scene:
    """Return the scene of realizations 0 to `pairs` - 1 with half the cell; whatever depends on the cell follows it."""
    numerics = scene.numerics.model_copy(update={"cell": scene.numerics.cell / 2})
    repeated = without_rule(scene, pairs)
    timeout = {"realization_timeout": HALF_CELL_COST * scene.campaign.realization_timeout}
    return repeated.model_copy(update={"numerics": numerics, "campaign": repeated.campaign.model_copy(update=timeout)})


def estimate(scene: Scene, coarse: Tally, fine: Tally, repeated: Collection[int]) -> Discretisation:
    """Compare the realizations of `scene` with those of them that were `repeated` at half its cell."""
    pairs = range(fine.maximum)
    differences = np.array([_difference(k, coarse, fine) if k in repeated else np.nan for k in pairs])
    deterministic = _difference(BASELINE, coarse, fine)
    slides = [k for k in pairs if k in repeated]
    standing = sum(fine.summaries[k].status is Status.no_slide for k in slides)
    return Discretisation(
        scene.numerics.cell, differences, deterministic, scene.campaign.confidence, len(slides), standing
    )


def _difference(realization: int, coarse: Tally, fine: Tally) -> float:
    fine_runout, runout = (unhindered_runout(tally.summaries[realization], tally.front) for tally in (fine, coarse))
    return fine_runout - runout
