"""Which inputs matter: what more of each changes, and how closely the run-out follows the random soil."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from campaign.report.figures.style import BLACK, BLUE, COLUMN, ORANGE, Illustration, letter, need, new_figure
from campaign.report.inputs import TENTH, names
from campaign.results.results import Results
from campaign.results.sensitivity import effects_of, ranking_of
from campaign.scene.inputs import Input, by_key
from campaign.statistics.changed_inputs import InputEffects
from campaign.statistics.intervals import Interval
from campaign.statistics.sensitivity import FEWEST, Ranking
from campaign.terminal import counted

BAR, OVERHEAD = 0.3, 0.85
"""Inches that a bar and the rest of a panel take."""


def ranking(results: Results) -> Illustration:
    """Draw bars with intervals: metres for each input, and correlations for each random property."""
    effects, soil = effects_of(results), _soil(results)
    need(effects or soil, f"It needs {FEWEST} slides, or slides repeated with one input changed.")
    rows = [len(effects.known())] if effects else []
    rows += [2 * len(found.correlation) for found in soil.values()]
    figure, panels = new_figure(sum(rows) * BAR + len(rows) * OVERHEAD, len(rows), COLUMN, height_ratios=rows)
    titles, captions, rest = [], [], iter(panels)
    if effects:
        captions.append(_inputs(next(rest), effects, by_key(results.scene)))
        titles.append(f"{TENTH} of one input")
    for outcome, found in soil.items():
        captions.append(_properties(next(rest), found, names(results)))
        titles.append(f"{outcome} and the random soil")
    letter(panels, titles)
    level = f"Lines: {100 * results.confidence:g} % intervals."
    text = " ".join(f"({sign}) {caption}" for sign, caption in zip("abc", captions, strict=False))
    return Illustration(figure, f"{text} {level}", "Bars that rank the inputs by their effect on the run-out.")


def _soil(results: Results) -> dict[str, Ranking]:
    found = {"sliding": ranking_of(results.data, "slide"), "run-out": ranking_of(results.data, "runout")}
    return {outcome: each for outcome, each in found.items() if each is not None}


def _inputs(axes: Axes, effects: InputEffects, named: Mapping[str, Input]) -> str:
    ranked = effects.known()
    _bars(axes, [named[key].name for key in ranked], list(ranked.values()), 0.6, BLUE)
    axes.set_xlabel("change of the run-out (m)")
    return (
        f"What {TENTH} of one input, all else unchanged, makes of the run-out of a slide: the mean of "
        f"{counted(len(effects.realizations), 'slide')} computed again."
    )


def _properties(axes: Axes, found: Ranking, named: list[str]) -> str:
    _bars(axes, named, found.correlation, 0.35, BLUE, -0.19, "rank correlation")
    _bars(axes, named, found.regression, 0.35, ORANGE, 0.19, "regression on all together")
    axes.set(xlabel="correlation or coefficient (-)", xlim=(-1, 1), xticks=[-1, -0.5, 0, 0.5, 1])
    axes.legend(loc="upper center", bbox_to_anchor=(0.3, -0.35), ncols=2)
    return (
        "Rank correlation with the mean of each random property over the ground that moves, and, where all of them are "
        "regressed on together, standard deviations per standard deviation; from "
        f"{found.correlation[0].n} realizations."
    )


def _bars(
    axes: Axes,
    named: Sequence[str],
    values: Sequence[Interval],
    thickness: float,
    colour: str,
    shift: float = 0.0,
    label: str = "",
) -> None:
    places, estimates = np.arange(len(named)) + shift, np.array([each.estimate for each in values])
    bounds = np.array([(each.lower, each.upper) for each in values])
    errors = np.abs(bounds.T - estimates)
    axes.barh(places, estimates, thickness, color=colour, alpha=0.75, label=label or None)
    axes.errorbar(estimates, places, xerr=errors, fmt="none", ecolor=BLACK, elinewidth=1.2, capsize=3)
    axes.axvline(0.0, color=BLACK, linewidth=0.8)
    axes.set_yticks(np.arange(len(named)), named)
    axes.set_ylim(len(named) - 0.45, -0.55)
