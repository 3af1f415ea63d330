"""Run-out over time, of all slides together."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from campaign.report.figures.style import BLACK, BLUE, COLUMN, GREY, Illustration, need_slides, new_figure
from campaign.results.results import Results
from campaign.statistics.wording import so_far
from campaign.terminal import counted

FEWEST_FOR_BANDS = 20
"""A 5 % quantile is not more than the smallest of fewer."""

MOST_LINES = 80
"""More would be an area, and 3 kB of the page each; the quantiles are of all."""


def curves(results: Results) -> Illustration:
    """Draw run-out over time (figure 6 of the paper)."""
    n = results.slide_runouts.size
    need_slides(n, 1)
    runouts = results.data["runout" if results.front == "tip" else "runout_mass"].values[results.has_slid]
    time = results.data["time"].values
    figure, (axes,) = new_figure(2.9, width=COLUMN)
    draw_histories(axes, time, runouts)
    deterministic = results.data["deterministic_runout"].values
    if results.front == "tip" and np.isfinite(deterministic).any():
        axes.plot(time, deterministic, color=BLACK, linestyle="--", label="mean strengths")
    axes.set(xlim=(0, _last_motion(results)), ylim=(0, None), xlabel="time since release (s)", ylabel="run-out (m)")
    axes.legend(loc="upper left")
    half = float(np.median(np.nan_to_num(results.data["settle_time"].values[results.has_slid], nan=np.inf)))
    rest = f" Half of them rest after {half:.1f} s." if np.isfinite(half) else ""
    caption = f"Run-out of {counted(n, 'slide')} over time{so_far(results.outcomes)}.{rest}{what_is_drawn(n)}"
    level = "some still rise at the end" if results.outcomes.cut_short else "all rise and level off"
    return Illustration(figure, caption, f"Run-out against time for {counted(n, 'slide')}; {level}.")


def draw_histories(axes: Axes, time: np.ndarray, histories: np.ndarray) -> None:
    """Draw the history (t,) of each slide, and where there are enough their median and bands."""
    n = len(histories)
    lines = [np.column_stack([time, history]) for history in histories[:MOST_LINES]]
    axes.add_collection(LineCollection(lines, colors=GREY, linewidths=0.5, alpha=max(0.15, min(0.8, 20 / n))))
    axes.plot([], [], color=GREY, linewidth=0.8, label="single slides")
    if n >= FEWEST_FOR_BANDS:
        q = np.quantile(histories, [0.05, 0.25, 0.5, 0.75, 0.95], axis=0)
        axes.fill_between(time, q[0], q[4], color=BLUE, alpha=0.2, linewidth=0, label="5 to 95 %")
        axes.fill_between(time, q[1], q[3], color=BLUE, alpha=0.4, linewidth=0, label="25 to 75 %")
        axes.plot(time, q[2], color=BLUE, label="median")


def what_is_drawn(n: int) -> str:
    """Say what `draw_histories` leaves out."""
    if n < FEWEST_FOR_BANDS:
        return f" No bands are drawn from fewer than {FEWEST_FOR_BANDS} slides."
    return f" The first {MOST_LINES} are drawn." if n > MOST_LINES else ""


def _last_motion(results: Results) -> float:
    """Return when all slides are at rest, or the last time (s)."""
    end = float(results.data["time"].values[-1])
    settled = results.data["settle_time"].values[results.has_slid]
    return min(end, 1.03 * float(np.max(settled))) if np.isfinite(settled).all() else end
