"""How probable it is that a slide runs farther than a distance."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from matplotlib.ticker import PercentFormatter

from campaign.report.distances import Curve
from campaign.report.figures.style import BLACK, BLUE, COLUMN, Illustration, need, need_slides, new_figure
from campaign.report.figures.svg import on_hover
from campaign.results.results import Results
from campaign.statistics.wording import chance
from campaign.terminal import counted

BEYOND = 1000.0
"""Metres for which the last probability is drawn; panels end before."""

STEPS = 40
"""Strips that tell their value on hover."""

FRONTS = {"mass": "front of the mass", "tip": "front-most ground"}
"""What the run-out of a slide is measured to."""


def exceedance(results: Results, curve: Curve) -> Illustration:
    """Draw the probability of a run-out beyond a distance, whether or not the slope slides."""
    n = results.slide_runouts.size
    need_slides(n, 2)
    need(curve.distance[-1] > 0, "No slide has come beyond the toe.")
    shortest, longest = curve.distance[1], curve.distance[-1]
    figure, (axes,) = new_figure(2.9, width=COLUMN)
    draw_curve(axes, curve, f"{100 * results.confidence:g} % interval")
    if np.isfinite(results.deterministic):
        axes.axvline(results.deterministic, color=BLACK, linestyle="--", label="mean strengths")
    axes.set(xlim=(max(0.0, shortest - 0.1 * longest), 1.05 * longest), ylim=(0, 1.02))
    axes.set(xlabel="distance from the toe (m)", ylabel="probability of a longer run-out (%)")
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=3)
    caption = (
        f"Probability of a run-out beyond a distance, counted in {counted(results.outcomes.usable, 'realization')} "
        f"with {n} slides, with its interval; without a slide the run-out is zero. No "
        f"{FRONTS[results.scene.slide.front]} was seen beyond {longest:.2f} m; {_left_open(results, curve)}."
    )
    alt = f"Falling curve of the probability from {chance(curve.estimate[0])} to zero at {longest:.2f} m."
    return Illustration(figure, caption, alt)


def _left_open(results: Results, curve: Curve) -> str:
    """Say how probable it is for all that that a slide runs farther than the longest."""
    most = f"leaves a probability of up to {chance(curve.upper[-1])}"
    cut_short = results.outcomes.cut_short
    return f"with {counted(cut_short, 'slide')} cut short before that {most}" if cut_short else f"that alone {most}"


def draw_curve(axes: Axes, curve: Curve, label: str, origin: float = 0.0) -> None:
    """Draw a curve of probabilities with its interval, from `origin` (m) on, with values on hover."""
    distance = origin + np.append(curve.distance, BEYOND + curve.distance[-1])
    lower, share, upper = (np.append(each, each[-1]) for each in (curve.lower, curve.estimate, curve.upper))
    axes.fill_between(distance, lower, upper, step="post", color=BLUE, alpha=0.25, linewidth=0, label=label)
    axes.step(distance, share, where="post", color=BLUE, label="counted share")
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, symbol=""))
    end = 1.05 * curve.distance[-1]
    for left in np.linspace(0.0, end, STEPS, endpoint=False):
        middle = left + 0.5 * end / STEPS
        strip = Rectangle((origin + left, 0.0), end / STEPS, 1.0, facecolor="white", alpha=0.01, linewidth=0)
        on_hover(strip, f"farther than {middle:.1f} m: {curve.words(middle)}")
        axes.add_patch(strip)
