"""The ground surface after the slides."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from campaign.report.figures.section import Section
from campaign.report.figures.style import BLUE, ORANGE, STILL
from campaign.results.results import Results
from campaign.simulation.solver_model import Array
from solver.surface import Surface

FEWEST = 20
"""Of fewer slides the band is from the lowest to the highest surface, as a 5 % quantile is not known."""

POINTS = 20
"""In each column, at which the elevation of the ground is averaged."""

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


def deposit_of(results: Results, surface: Surface) -> Deposit:
    """Return the surface of the ground and what the slides make of it, or all realizations if nothing slid.

    The dataset's surfaces are those of particles, up to a quarter of a cell off the ground that they fill. So it is the
    change from its initial surface that is added to the ground's own, column by column.
    """
    data, which = results.data, results.has_slid if results.outcomes.slides else ~results.has_failed
    x, ground = data["x"].values, columns_of(surface, data["x"].values)
    surfaces = ground + data["deposit_surface"].values[which] - data["initial_surface"].values
    shares, band = ([0.05, 0.5, 0.95], "5 to 95 %") if len(surfaces) >= FEWEST else ([0, 0.5, 1], "lowest to highest")
    before, low, median, high = (
        np.pad(column, 1, mode="edge") for column in (ground, *np.quantile(surfaces, shares, axis=0))
    )
    return Deposit(np.concatenate([[0.0], x, [surface.width]]), before, low, median, high, band)


def columns_of(surface: Surface, x: Array) -> Array:
    """Return the mean elevation in m of the ground in each of the columns around `x` (m), which fill its width."""
    within = (np.arange(POINTS) + 0.5) / POINTS - 0.5
    mean: Array = surface.height_at(x[:, None] + surface.width / len(x) * within).mean(axis=1)
    return mean


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
