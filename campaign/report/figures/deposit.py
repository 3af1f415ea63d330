"""The ground surface after the slides."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from campaign.report.figures.section import Section
from campaign.report.figures.style import BLUE, ORANGE, STILL
from campaign.results.results import Results
from campaign.simulation.solver_model import Array

FEWEST = 20
"""Of fewer slides the band is from the lowest to the highest surface, as a 5 % quantile is not known."""

VISIBLE = 0.05
"""Metres of movement from which on a surface is drawn that has not slid."""

SCAR = "#9fc5e8"


class Deposit(NamedTuple):
    """Surfaces before the slides and after them, column by column; every array is (k,), in m, from wall to wall."""

    x: Array
    before: Array
    low: Array
    median: Array
    high: Array
    band: str  # what the lowest and the highest are

    def clear(self, x: Array) -> Array:
        """Return the elevation in m above which there is nothing but sky."""
        return np.interp(x, self.x, np.maximum(self.before, self.high))


def deposit_of(results: Results, width: float) -> Deposit:
    """Return the surfaces after the slides, or of all realizations if nothing slid, between walls `width` m apart."""
    data, which = results.data, results.has_slid if results.outcomes.slides else ~results.has_failed
    surfaces = data["deposit_surface"].values[which]
    shares, band = ([0.05, 0.5, 0.95], "5 to 95 %") if len(surfaces) >= FEWEST else ([0, 0.5, 1], "lowest to highest")
    before, low, median, high = (
        np.pad(column, 1, mode="edge")
        for column in (data["initial_surface"].values, *np.quantile(surfaces, shares, axis=0))
    )
    x = np.concatenate([[0.0], data["x"].values, [width]])
    return Deposit(x, before, low, median, high, band)


def draw_deposit(axes: Axes, deposit: Deposit, section: Section, has_slides: bool) -> None:
    """Fill the ground by its layers, and draw what the slides add and take away with the band of their surfaces."""
    x, before, median = deposit.x, deposit.before, deposit.median
    lowest = np.minimum(before, median)
    if section.layers:
        shown = np.minimum(x, section.right)
        still = [(0.0, 0.0), *zip(shown.tolist(), lowest.tolist(), strict=True), (float(shown[-1]), 0.0)]
        section.tint_layers(axes, axes.add_patch(Polygon(still, facecolor="none", edgecolor="none")))
    else:
        axes.fill_between(x, 0.0, lowest, color=STILL, linewidth=0)
    changes = {"ground added": (median > before, ORANGE), "ground lost": (median < before, SCAR)} if has_slides else {}
    for label, (where, colour) in changes.items():
        axes.fill_between(
            x, before, median, where=where, interpolate=True, color=colour, alpha=0.5, linewidth=0, label=label
        )
    if not has_slides and np.ptp(deposit.high - deposit.low) < VISIBLE:
        return
    label = f"surface after it, {deposit.band}"
    axes.fill_between(x, deposit.low, deposit.high, color=BLUE, alpha=0.3, linewidth=0, label=label)
    axes.plot(x, median, color=BLUE, label="median")
