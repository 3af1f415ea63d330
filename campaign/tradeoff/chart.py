"""Speed against accuracy: the settings of a scene in one chart."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from campaign.report.figures.style import BLUE, GREEN, GREY, Illustration, in_style, new_figure
from campaign.tradeoff.trials import NEAR, Tradeoff, Trial

RED = "#c00000"

OFFSETS = 9.0 * np.array([(0, 1), (0, -1), (1, 0), (-1, 0), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)])
"""Places of a number about its point, in points of print."""


def draw(tradeoff: Tradeoff, path: Path) -> None:
    """Write the chart as a PNG."""
    with in_style():
        chart(tradeoff).figure.savefig(path)


def chart(tradeoff: Tradeoff) -> Illustration:
    """Draw the RMS difference of run-outs against the CPU time of a realization, with the Pareto front."""
    figure, (axes,) = new_figure(4.4)
    reference, compared, front = tradeoff.reference, tradeoff.compared, tradeoff.front
    failed = [trial for trial in tradeoff.trials if trial.was_run and trial.failures]
    allowed = NEAR * float(np.mean(reference.runouts))
    top = 1.2 * max([allowed, *(trial.rms(reference) for trial in compared)])
    axes.axhspan(0, allowed, color=GREEN, alpha=0.15, linewidth=0, label=f"within {100 * NEAR:g} % of the run-out")
    costs, errors = [t.seconds for t in front], [t.rms(reference) for t in front]
    axes.step(costs, errors, where="post", color=BLUE, marker="o", label="nothing is cheaper and as near")
    others = [trial for trial in compared if trial not in front]
    axes.plot([t.seconds for t in others], [t.rms(reference) for t in others], "o", color=GREY)
    if failed:
        axes.plot(
            [t.seconds for t in failed],
            [top] * len(failed),
            "x",
            color=RED,
            markersize=8,
            label="no run-out to compare",
        )
    axes.set(xscale="log", ylim=(-0.06 * top, 1.08 * top), xlabel="CPU time of a realization (s)")
    axes.set_ylabel("RMS difference of final run-out (m)")
    axes.margins(x=0.08)
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=3, fontsize=8)
    _number(axes, [(t, t.rms(reference)) for t in compared] + [(t, top) for t in failed], tradeoff)
    n = len(reference.runouts) - 1
    caption = (
        f"Root mean square difference of the final run-out from that with {reference.setting}, over {n} random fields "
        f"and the run with mean strengths, against the CPU time of one of them. {tradeoff.advice}"
    )
    alt = f"{len(compared)} settings by cost and difference, and {len(failed)} without a run-out."
    return Illustration(figure, caption, alt)


def _number(axes: Axes, points: list[tuple[Trial, float]], tradeoff: Tradeoff) -> None:
    """Write numbers at the points where there is room, and list their names beside the chart."""
    points = sorted(points, key=lambda point: point[0].seconds)
    axes.autoscale_view()
    places = axes.transData.transform([(trial.seconds, error) for trial, error in points]) * 72 / axes.figure.dpi
    taken = places
    for number, ((trial, error), place) in enumerate(zip(points, places, strict=True), start=1):
        offset = _roomiest(place, taken)
        taken = np.vstack([taken, place + offset])
        axes.annotate(
            str(number),
            (trial.seconds, error),
            offset,
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=8,
        )
    names = [f"{number:2d}  {_name(trial, tradeoff)}" for number, (trial, _) in enumerate(points, start=1)]
    axes.text(1.03, 1.0, "\n".join(names), transform=axes.transAxes, va="top", fontsize=8, linespacing=1.5)


def _roomiest(place: NDArray[np.float64], taken: NDArray[np.float64]) -> tuple[float, float]:
    """Return the offset that is farthest from whatever is nearest to it."""
    room = [np.sort(np.hypot(*(taken - place - offset).T))[:2].sum() for offset in OFFSETS]
    x, y = OFFSETS[int(np.argmax(np.round(room, 3)))]
    return float(x), float(y)


def _name(trial: Trial, tradeoff: Tradeoff) -> str:
    """Return a setting without its sections, and what it is to the comparison: "cell = 2 m"."""
    parts = [part.partition(".")[2].replace("=", " = ").replace("_", " ") for part in trial.setting.split(", ")]
    name = ", ".join(parts) if "=" in trial.setting else trial.setting
    if trial is tradeoff.reference:
        return f"{name} (reference)"
    return f"{name} (recommended)" if trial is tradeoff.recommended else name
