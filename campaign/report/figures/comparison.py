"""Campaigns beside each other: run-outs of the same realizations, and the chance to exceed a distance in each."""

import numpy as np
from matplotlib.axes import Axes

from campaign.comparison.scenarios import Comparison
from campaign.report.figures.style import BLACK, BLUE, GREEN, GREY, ORANGE, Illustration, letter, new_figure
from campaign.statistics.intervals import Sample
from campaign.terminal import listing

COLOURS = (BLACK, BLUE, ORANGE, GREEN, "#CC79A7", "#56B4E9", "#E69F00")
"""Of the first scenario, and of the others by turns."""


def comparison(given: Comparison) -> Illustration:
    """Draw the run-outs of pairs against each other, and the exceedance curves of all scenarios."""
    figure, panels = new_figure(8.2, 2, height_ratios=[5, 4])
    _pairs(panels[0], given)
    _curves(panels[1], given)
    letter(panels, [f"Each realization beside that of {given.names[0]}", "Probability of a longer run-out"])
    first, others = given.names[0], ", ".join(given.names[1:])
    caption = (
        f"(a) Final run-out of {others} against that of {first} in the same {len(given.ids)} realizations: what lies "
        f"below the dashed line runs less far than in {first}. (b) Share of realizations that run farther than a "
        f"distance. Without a slide the run-out is 0 m{_cut_short(given)}."
    )
    alt = f"Scatter of the run-outs of {others} over those of {first}, and falling curves of the exceedance of each."
    return Illustration(figure, caption, alt)


def _cut_short(given: Comparison) -> str:
    """Say of which campaigns many run-outs are lower bounds, to follow a sentence."""
    cut = [name for scenario, name in enumerate(given.names) if given.is_cut_short(scenario)]
    return f"; slides of {listing(cut)} that were cut short are drawn as far as they came" if cut else ""


def _pairs(axes: Axes, given: Comparison) -> None:
    first = given.runouts(0)
    others = [given.runouts(other) for other in range(1, len(given.names))]
    size = max(6.0, min(20.0, 2000 / len(first)))
    for runouts, name, colour in zip(others, given.names[1:], _colours(given)[1:], strict=True):
        axes.scatter(first, runouts, s=size, color=colour, alpha=0.7, linewidths=0, label=name)
    low, high = _range([first, *others])
    axes.plot([low, high], [low, high], color=GREY, linestyle="--", linewidth=1.0, label="no difference")
    axes.set(xlim=(low, high), ylim=(low, high), aspect="equal")
    axes.set(xlabel=f"final run-out of {given.names[0]} (m)", ylabel="final run-out (m)")
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))


def _curves(axes: Axes, given: Comparison) -> None:
    samples = [given.runouts(scenario) for scenario in range(len(given.names))]
    low, high = _range(samples)
    for runouts, name, colour in zip(samples, given.names, _colours(given), strict=True):
        places = np.concatenate([[low], np.sort(runouts), [high]])
        shares = [float(np.mean(runouts > place)) for place in places]
        axes.step(places, shares, where="post", color=colour, label=name)
    axes.set(xlim=(low, high), ylim=(0, 1.02))
    axes.set(xlabel="distance from the initial toe (m)", ylabel="share that runs farther (-)")
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))


def _colours(given: Comparison) -> list[str]:
    first, *others = COLOURS
    return [first, *(others[k % len(others)] for k in range(len(given.names) - 1))]


def _range(samples: list[Sample]) -> tuple[float, float]:
    least, most = (float(find(samples)) for find in (np.min, np.max))
    margin = 0.06 * ((most - least) or 1.0)
    return max(-margin, least - margin), most + margin
