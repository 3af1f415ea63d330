"""How the estimates tighten with the number of realizations, and where the stopping rule was satisfied."""

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes

from campaign.report.figures.style import (
    BLACK,
    BLUE,
    COLUMN,
    GREEN,
    Illustration,
    letter,
    need,
    need_slides,
    new_figure,
)
from campaign.results.results import Results
from campaign.statistics.intervals import Interval, Sample, mean_interval, std_interval
from campaign.statistics.verdict import CONVERGED

FIRST = 5
"""The variance has an interval from here on."""

FEWEST = 10
"""Of fewer there is no history to draw."""

POINTS = 80


def convergence(results: Results) -> Illustration:
    """Draw mean and standard deviation of the run-out over the number of realizations, with tolerances."""
    rule, n = results.scene.campaign, results.slide_runouts.size
    need_slides(n, FEWEST)
    need(np.ptp(results.slide_runouts) > 0, "All final run-outs are equal, so nothing converges.")
    figure, panels = new_figure(3.8, 2, width=COLUMN, sharex=True)
    estimate: list[tuple[str, Callable[[Sample, float], Interval], float]] = [
        ("mean", mean_interval, rule.mean_tolerance),
        ("standard deviation", std_interval, rule.variance_tolerance),
    ]
    for panel, (name, interval, tolerance) in zip(panels, estimate, strict=True):
        _history(panel, results, interval)
        last = interval(results.slide_runouts, results.confidence).estimate
        _tolerance(panel, last * _within(name, tolerance))
        panel.set_ylabel(f"{name} (m)")
    _dots(panels, results)
    stopped = _mark_stop(panels, results)
    panels[-1].set(xlabel="realizations", xlim=(0, 1.02 * results.realizations))
    panels[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    letter(panels, ["", ""])
    caption = (
        f"(a) Mean and (b) standard deviation of the final run-out as realizations were added, with their "
        f"{100 * rule.confidence:g} % intervals, up to {n} slides in {results.realizations} realizations. Green: the "
        f"half-widths asked for ({100 * rule.mean_tolerance:g} % of the mean, {100 * rule.variance_tolerance:g} % of "
        f"the variance) about the last estimate; dots: where the rule looked. {stopped}"
    )
    alt = f"Two curves with bands that narrow as the number of realizations grows to {results.realizations}."
    return Illustration(figure, caption, alt)


def _within(name: str, tolerance: float) -> Sample:
    bounds = np.array([1 - tolerance, 1 + tolerance])
    return bounds if name == "mean" else np.sqrt(bounds)


def _history(axes: Axes, results: Results, interval: Callable[[Sample, float], Interval]) -> None:
    runouts, has_slid = results.runouts, results.has_slid
    first = int(np.flatnonzero(has_slid)[FIRST - 1]) + 1
    counts = np.unique(np.linspace(first, results.realizations, POINTS).round().astype(int))
    rows = np.array([interval(runouts[:count][has_slid[:count]], results.confidence)[:3] for count in counts])
    label = f"{100 * results.confidence:g} % interval"
    axes.fill_between(counts, rows[:, 1], rows[:, 2], color=BLUE, alpha=0.25, linewidth=0, label=label)
    axes.plot(counts, rows[:, 0], color=BLUE, label="estimate")
    # The first intervals are too wide for the later ones to be seen beside them.
    late = rows[counts >= min(0.15 * results.realizations, counts[-1])]
    low, high = np.nanmin(late), np.nanmax(late)
    axes.set_ylim(max(0.0, low - 0.1 * (high - low)), high + 0.1 * (high - low))


def _tolerance(axes: Axes, bounds: Sample) -> None:
    for bound, label in zip(bounds, ("tolerance", None), strict=True):
        axes.axhline(bound, color=GREEN, linestyle="-.", linewidth=1.0, label=label)


def _dots(panels: list[Axes], results: Results) -> None:
    data = results.data
    looks = data["checkpoint"].values
    for panel, values in zip(
        panels, (data["runout_mean"].values, np.sqrt(data["runout_variance"].values)), strict=True
    ):
        panel.plot(looks, values, "o", markersize=3, color=BLUE)


def _mark_stop(panels: list[Axes], results: Results) -> str:
    verdict = str(results.data.attrs["verdict"])
    if not verdict.startswith(CONVERGED):
        return f"The campaign is {verdict}." if verdict.startswith("not converged") else f"Verdict: {verdict}."
    for panel in panels:
        panel.axvline(results.realizations, color=BLACK, linestyle=":", linewidth=1.2, label="rule satisfied")
    return f"Verdict: {verdict}."
