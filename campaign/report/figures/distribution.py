"""All slides together: their run-out in time, its distribution, and the chance to exceed a distance."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator
from scipy import stats

from campaign.report.figures.style import BLACK, BLUE, GREY, ORANGE, Illustration, letter, need, need_slides, new_figure
from campaign.results.results import Results
from campaign.statistics import proportions

FEWEST_FOR_BANDS = 20
"""A 5 % quantile is not more than the smallest of fewer."""


def curves(results: Results) -> Illustration:
    """Draw run-out over time (figure 6 of the paper)."""
    n = results.slide_runouts.size
    need_slides(n, 1)
    runouts = results.data["runout"].values[results.has_slid]
    time = results.data["time"].values
    figure, (axes,) = new_figure(4.2)
    lines = [np.column_stack([time, runout]) for runout in runouts]
    axes.add_collection(LineCollection(lines, colors=GREY, linewidths=0.5, alpha=max(0.15, min(0.8, 20 / n))))
    axes.plot([], [], color=GREY, linewidth=0.8, label="realizations")
    if n >= FEWEST_FOR_BANDS:
        _bands(axes, time, runouts)
    _deterministic_curve(axes, results)
    axes.set(xlim=(0, _last_motion(results)), ylim=(0, None), xlabel="time since release (s)", ylabel="run-out (m)")
    axes.legend(loc="upper left")
    bands = "" if n >= FEWEST_FOR_BANDS else f" No quantiles are drawn from fewer than {FEWEST_FOR_BANDS} slides."
    half = float(np.median(np.nan_to_num(results.data["settle_time"].values[results.has_slid], nan=np.inf)))
    rest = f" Half of them rest after {half:.1f} s." if np.isfinite(half) else ""
    caption = f"Run-out of the front-most particle of {n} slides over time.{rest}{bands}"
    return Illustration(figure, caption, f"Run-out against time for {n} slides; all rise and level off.")


def histogram(results: Results) -> Illustration:
    """Draw the distribution of the final run-out, and the run-out of each realization (figure 7 of the paper)."""
    n = results.slide_runouts.size
    need_slides(n, 2)
    runouts, ids = results.slide_runouts, results.data["realization"].values[results.has_slid]
    mean, std = float(np.mean(runouts)), float(np.std(runouts, ddof=1))
    need(std > 0, "All final run-outs are equal, so they have no distribution to draw.")
    figure, panels = new_figure(6.6, 2, height_ratios=[3, 2])
    _density(panels[0], runouts, mean, std)
    panels[1].scatter(ids, runouts, s=max(3.0, min(16.0, 4000 / n)), color=GREY, linewidths=0)
    panels[1].axhline(mean, color=BLUE, linestyle=":", label=f"mean {mean:.2f} m")
    if np.isfinite(results.deterministic):
        label = f"deterministic {results.deterministic:.2f} m"
        panels[0].axvline(results.deterministic, color=BLACK, linestyle="--")
        panels[1].axhline(results.deterministic, color=BLACK, linestyle="--", label=label)
    panels[1].xaxis.set_major_locator(MaxNLocator(integer=True))
    panels[1].set(xlabel="realization", ylabel="final run-out (m)")
    panels[1].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    letter(panels, ["", ""])
    skewness = float(stats.skew(runouts, bias=False)) if n > 2 else np.nan
    caption = (
        f"Final run-out of {n} slides. (a) Histogram with the normal distribution of the same mean ({mean:.2f} m) and "
        f"standard deviation ({std:.2f} m), and in blue the share of slides up to a distance, counted and after the "
        f"normal distribution; dashed: the deterministic run. The skewness is {skewness:.2f} (normal: 0). (b) Run-out "
        "by realization: a trend would betray realizations that are not independent."
    )
    alt = f"Histogram of {n} run-outs between {runouts.min():.2f} and {runouts.max():.2f} m, and their scatter plot."
    return Illustration(figure, caption, alt)


def exceedance(results: Results) -> Illustration:
    """Draw the probability of a run-out beyond a distance, whether or not the slope slides."""
    n = results.slide_runouts.size
    need_slides(n, 2)
    runouts = np.sort(results.slide_runouts)
    distances = np.concatenate([[max(0.0, runouts[0] - 0.05 * runouts[-1])], runouts, [1.03 * runouts[-1]]])
    given = results.outcomes
    shares = [proportions.exceedance(given, distance, results.confidence) for distance in distances]
    figure, (axes,) = new_figure(4.0)
    lower, upper = [share.lower for share in shares], [share.upper for share in shares]
    label = f"{100 * results.confidence:g} % interval"
    axes.fill_between(distances, lower, upper, step="post", color=BLUE, alpha=0.25, linewidth=0, label=label)
    axes.step(
        distances, [share.estimate or np.nan for share in shares], where="post", color=BLUE, label="counted share"
    )
    if np.isfinite(results.deterministic):
        axes.axvline(results.deterministic, color=BLACK, linestyle="--", label="deterministic")
    axes.set(yscale="log", ylim=(0.3 / given.usable, 1.3), xlim=(distances[0], distances[-1]))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set(xlabel="distance from the initial toe (m)", ylabel="probability of a longer run-out (-)")
    axes.legend(loc="lower left")
    caption = (
        f"Probability of a run-out beyond a distance, counted in {given.usable} realizations with {n} slides, with its "
        "interval (Wilson); without a slide the run-out is zero. "
        f"Nothing was seen beyond {runouts[-1]:.2f} m; that alone leaves a probability of up to {upper[-1]:.2g}."
    )
    alt = (
        f"Falling curve of the exceedance probability from {shares[0].estimate:.2g} at {runouts[0]:.2f} m to "
        f"{1 / given.usable:.2g} at {runouts[-1]:.2f} m."
    )
    return Illustration(figure, caption, alt)


def _bands(axes: Axes, time: np.ndarray, runouts: np.ndarray) -> None:
    q = np.quantile(runouts, [0.05, 0.25, 0.5, 0.75, 0.95], axis=0)
    axes.fill_between(time, q[0], q[4], color=BLUE, alpha=0.2, linewidth=0, label="5 to 95 %")
    axes.fill_between(time, q[1], q[3], color=BLUE, alpha=0.4, linewidth=0, label="25 to 75 %")
    axes.plot(time, q[2], color=BLUE, label="median")


def _deterministic_curve(axes: Axes, results: Results) -> None:
    runout = results.data["deterministic_runout"].values
    if np.isfinite(runout).any():
        axes.plot(results.data["time"].values, runout, color=BLACK, linestyle="--", label="deterministic")


def _last_motion(results: Results) -> float:
    """Return when all slides are at rest, or the last time (s)."""
    end = float(results.data["time"].values[-1])
    settled = results.data["settle_time"].values[results.has_slid]
    return min(end, 1.03 * float(np.max(settled))) if np.isfinite(settled).all() else end


def _density(axes: Axes, runouts: np.ndarray, mean: float, std: float) -> None:
    low, high = min(runouts.min(), mean - 3 * std), max(runouts.max(), mean + 3 * std)
    x = np.linspace(max(0.0, low - 0.2 * std), high + 0.2 * std, 200)
    axes.hist(runouts, bins="auto", density=True, color=GREY, alpha=0.5, label="slides")
    axes.plot(x, stats.norm.pdf(x, mean, std), color=ORANGE, label="normal density")
    axes.set(xlabel="final run-out (m)", ylabel="probability density (1/m)", xlim=(x[0], x[-1]))
    share = axes.twinx()
    share.spines["right"].set_visible(True)
    share.ecdf(runouts, color=BLUE, linewidth=1.0, label="share of slides")
    share.plot(x, stats.norm.cdf(x, mean, std), color=BLUE, linestyle=":", label="normal distribution")
    share.set(ylim=(0, 1.03))
    share.set_ylabel("share up to this run-out (-)", color=BLUE)
    (bars, density), (counted, normal) = axes.get_legend_handles_labels()[0], share.get_legend_handles_labels()[0]
    axes.legend(handles=[bars, density, counted, normal], loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
