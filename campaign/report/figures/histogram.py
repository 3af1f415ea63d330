"""How the final run-outs of the slides are distributed."""

import numpy as np

from campaign.report import estimates
from campaign.report.figures.style import BLACK, BLUE, COLUMN, GREY, Illustration, need, need_slides, new_figure
from campaign.report.figures.svg import on_hover
from campaign.results.results import Results
from campaign.statistics.wording import at_least, metres, so_far
from campaign.terminal import counted


def histogram(results: Results) -> Illustration:
    """Draw the distribution of the final run-out (figure 7 of the paper)."""
    n, runouts = results.slide_runouts.size, results.slide_runouts
    need_slides(n, 2)
    mean, std = float(np.mean(runouts)), float(np.std(runouts, ddof=1))
    need(std > 0, "All final run-outs are equal, so they have no distribution to draw.")
    figure, (axes,) = new_figure(2.9, width=COLUMN)
    counts, edges = np.histogram(runouts, bins="auto")
    bars = axes.bar(edges[:-1], counts, np.diff(edges), align="edge", color=GREY, alpha=0.6, edgecolor="white")
    for count, low, high, bar in zip(counts, edges[:-1], edges[1:], bars, strict=True):
        on_hover(bar, f"{low:.2f} to {high:.2f} m: {counted(count, 'slide')} ({100 * count / n:.3g} %)")
    x = np.linspace(max(0.0, mean - 3.5 * std), mean + 3.5 * std, 100)
    density = np.exp(-0.5 * ((x - mean) / std) ** 2) / (std * np.sqrt(2.0 * np.pi))
    axes.plot(x, n * (edges[1] - edges[0]) * density, color=BLUE, label="normal distribution")
    if np.isfinite(results.deterministic):
        label = f"mean strengths: {at_least(results.deterministic_run)}{results.deterministic:.2f} m"
        axes.axvline(results.deterministic, color=BLACK, linestyle="--", label=label)
    axes.set(xlabel="final run-out (m)", ylabel="slides (-)")
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2)
    spread = estimates.std_runout(results)
    caption = (
        f"Final run-out of {counted(n, 'slide')}{so_far(results.outcomes)}: mean {mean:.2f} m "
        f"({metres(estimates.mean_runout(results))}, sampling alone), standard deviation {std:.2f} m ({metres(spread)})"
        ". Blue: the normal distribution with these two numbers. Dashed: the run with mean strengths everywhere."
    )
    alt = f"Histogram of {counted(n, 'run-out')} between {runouts.min():.2f} and {runouts.max():.2f} m."
    return Illustration(figure, caption, alt)
