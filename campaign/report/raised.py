"""How far the ground is raised, where a slide pushes and throws ground ahead of its front."""

import numpy as np

from campaign.results.results import Results
from campaign.statistics.intervals import Sample, is_least_quantile

CLEARLY_FARTHER = 2.0
"""In cells: how much farther than their fronts the ground must be raised in half of the slides to be told."""


def least_rise(results: Results) -> float:
    """Return half a cell in m, the least rise of the surface that columns of a cell can tell from single particles."""
    return 0.5 * results.scene.numerics.cell


def raised_reach(results: Results) -> Sample:
    """Return for each slide how far from the toe its ground is raised by `least_rise`, in m; 0 where nowhere."""
    data = results.data
    rise = data["deposit_surface"].values[results.has_slid] - data["initial_surface"].values
    ahead = np.maximum(data["x"].values - float(data.attrs["toe_x"]), 0.0)
    return np.asarray(np.max(np.where(rise >= least_rise(results), ahead, 0.0), axis=1))


def goes_ahead(results: Results, share: float) -> str:
    """Say how far from the toe the ground is raised in a share of the slides, "as far as 62.5 m"; "" if fronts tell it.

    Slides that were cut short would have raised it farther.
    """
    if not results.outcomes.slides:
        return ""
    raised = raised_reach(results)
    farther = float(np.median(raised) - np.median(results.slide_runouts))
    if farther <= CLEARLY_FARTHER * results.scene.numerics.cell:
        return ""
    least = "at least " if is_least_quantile(raised, share, results.outcomes.is_cut_short) else ""
    return f"{least}as far as {np.quantile(raised, share):.1f} m"
