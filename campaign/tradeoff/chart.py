"""Speed against accuracy in one chart, and up to which Courant numbers the methods are stable in another below it."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import NDArray

from campaign.report.figures.style import BLACK, BLUE, GREEN, GREY, ORANGE, Illustration, in_style, new_figure
from campaign.scene import Scene
from campaign.tradeoff.settings import CHOICES, in_short
from campaign.tradeoff.trials import Judged, Tradeoff, Trial
from solver.timestep import largest_courant

OFFSETS = 9.0 * np.array([(0, 1), (0, -1), (1, 0), (-1, 0), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)])
"""Places of a number about its point, in points of print."""

UNITS = {"s": 1, "min": 60, "h": 3600}
"""Of core time, in s."""

TIMES = {count * size: f"{count} {unit}" for unit, size in UNITS.items() for count in (1, 3, 10, 30)}
"""Ticks of core time in s."""

LENGTHS = [digit * 10.0**power for power in range(-3, 3) for digit in (1, 2, 5)]
"""Ticks of an error in m."""


class Point(NamedTuple):
    """A setting in the chart: the core time in s and the total error in m of a campaign; judged if it can be."""

    trial: Trial
    seconds: float
    error: float
    judged: Judged | None


def draw(tradeoff: Tradeoff, path: Path) -> None:
    """Write the chart as a PNG."""
    with in_style():
        chart(tradeoff).figure.savefig(path)


def chart(tradeoff: Tradeoff) -> Illustration:
    """Draw the total error of the mean run-out against the core time of a campaign, and the stable Courant numbers."""
    figure, (axes, names, steps) = new_figure(8.8, rows=3, height_ratios=(4.0, 1.6, 1.0))
    sound = [_point(each, tradeoff) for each in tradeoff.judged]
    top = 1.3 * max([*(point.error for point in sound), tradeoff.reference.std])
    failed = _failed(tradeoff, sound, top)
    times = [point.seconds for point in (*sound, *failed)]
    axes.set(xscale="log", yscale="log", xlim=(0.5 * min(times), 4 * max(times)))
    axes.set_ylim(0.5 * min(point.error for point in sound), 1.3 * top)
    _ticks(axes)
    _draw_levels(axes, tradeoff)
    _draw_lines(axes, tradeoff)
    _draw_points(axes, [*sound, *failed], tradeoff)
    _number(axes, names, [*sound, *failed], tradeoff)
    axes.set(xlabel="core time of a campaign", ylabel="total error of the mean run-out, at most (m)")
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2, fontsize=8)
    _draw_stable_steps(steps, tradeoff.scene)
    steps.set_title("Largest stable Courant number")
    caption = (
        f"Total error of the mean run-out against that with cells of {tradeoff.reference.cell:g} m, from "
        f"{len(tradeoff.reference.runouts)} random fields in each setting: what the setting may shift the mean by, and "
        f"the sampling error of a campaign that takes the core time. Points: {tradeoff.sampling:.2f} m of sampling "
        f"error; the bar below reaches to the shift as it is estimated. {tradeoff.advice}"
    )
    alt = f"{len(sound)} settings by cost and total error, and {len(tradeoff.trials) - len(sound)} without."
    return Illustration(figure, caption, alt)


def _point(judged: Judged, tradeoff: Tradeoff) -> Point:
    seconds = judged.sampling_cost(tradeoff.sampling)
    return Point(judged.trial, seconds, judged.error(seconds), judged)


def _failed(tradeoff: Tradeoff, sound: Sequence[Point], height: float) -> list[Point]:
    """Return the settings that were run in vain: at the top, at the cost of as many realizations as others take."""
    realizations = float(np.median([point.seconds / point.trial.seconds for point in sound]))
    vain = [trial for trial in tradeoff.trials if not (trial.is_sound or trial.why_not)]
    return [Point(trial, realizations * trial.seconds, height, None) for trial in vain]


def _draw_levels(axes: Axes, tradeoff: Tradeoff) -> None:
    """Draw what the errors are to be compared with."""
    left, bottom = axes.get_xlim()[0], axes.get_ylim()[0]
    for height, colour, words in (
        (tradeoff.wanted, GREEN, f"wanted, {tradeoff.wanted:.2f} m"),
        (tradeoff.reference.std, GREY, f"scatter between realizations, {tradeoff.reference.std:.2f} m"),
    ):
        axes.axhline(height, color=colour, linewidth=0.8, linestyle=":")
        axes.annotate(words, (0.995, height), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=8)
    if tradeoff.mesh_doubt > bottom:
        axes.axhspan(bottom, tradeoff.mesh_doubt, color=GREY, alpha=0.15, linewidth=0)
        words = " the finest mesh may be as far off itself"
        axes.text(left, tradeoff.mesh_doubt, words, va="top", fontsize=8, color=BLACK)


def _draw_lines(axes: Axes, tradeoff: Tradeoff) -> None:
    """Draw what a longer campaign gains."""
    seconds, widths = np.geomspace(*axes.get_xlim(), 60), np.geomspace(*axes.get_ylim(), 60)
    lines: dict[int, tuple[Judged, str, list[str]]] = {}
    for judged, colour, label in (
        (tradeoff.recommended, BLUE, "recommended"),
        (tradeoff.of(tradeoff.reference), BLACK, "finest mesh"),
        (tradeoff.of(tradeoff.trials[0]), GREY, "the scene as it is"),
    ):
        if judged is not None:
            lines.setdefault(id(judged.trial), (judged, colour, []))[2].append(label)
    for judged, colour, labels in lines.values():
        errors = [judged.error(each) for each in seconds]
        axes.plot(seconds, errors, color=colour, linewidth=1.2, label=", ".join(labels))
    costs = [tradeoff.multilevel_cost(width) for width in widths]
    if np.isfinite(costs).any():
        axes.plot(costs, widths, "--", color=GREEN, linewidth=1.2, label="finest mesh with cheaper models (--accuracy)")


def _draw_points(axes: Axes, points: Sequence[Point], tradeoff: Tradeoff) -> None:
    chosen, front = tradeoff.recommended, [each.trial for each in tradeoff.front]
    for trial, seconds, error, judged in points:
        if judged is None:
            axes.plot([seconds], [error], "x", color=ORANGE, markersize=7)
            continue
        colour = BLACK if trial in front else GREY
        if chosen is not None and trial is chosen.trial:
            colour = BLUE
        least = error - judged.bias + abs(judged.shift.estimate)
        axes.plot([seconds, seconds], [least, error], color=colour, linewidth=1)
        axes.plot([seconds], [error], "o", color=colour, markersize=5)


def _ticks(axes: Axes) -> None:
    axes.xaxis.set(major_locator=FixedLocator([*TIMES]), minor_locator=NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda seconds, _: TIMES[round(seconds)]))
    axes.yaxis.set(major_locator=FixedLocator(LENGTHS), minor_locator=NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda length, _: f"{length:g}"))


def _number(axes: Axes, list_of_names: Axes, points: Sequence[Point], tradeoff: Tradeoff) -> None:
    """Write numbers at the points where there is room, and list their names in another panel, in two columns."""
    points = sorted(points, key=lambda point: point.seconds)
    places = axes.transData.transform([point[1:3] for point in points]) * 72 / axes.figure.dpi
    taken = places
    for number, (point, place) in enumerate(zip(points, places, strict=True), start=1):
        offset = _roomiest(place, taken)
        taken = np.vstack([taken, place + offset])
        axes.annotate(str(number), point[1:3], offset, textcoords="offset points", ha="center", va="center", fontsize=8)
    names = [f"{number:2d}  {_name(point.trial, tradeoff)}" for number, point in enumerate(points, start=1)]
    names += [f" –  {_name(trial, tradeoff)}" for trial in tradeoff.trials if trial.why_not]
    half = math.ceil(len(names) / 2)
    list_of_names.set_axis_off()
    for left, column in ((0.0, names[:half]), (0.48, names[half:])):
        list_of_names.text(left, 1.0, "\n".join(column), va="top", fontsize=8, linespacing=1.5)


def _roomiest(place: NDArray[np.float64], taken: NDArray[np.float64]) -> tuple[float, float]:
    """Return the offset that is farthest from whatever is nearest to it."""
    room = [np.sort(np.hypot(*(taken - place - offset).T))[:2].sum() for offset in OFFSETS]
    x, y = OFFSETS[int(np.argmax(np.round(room, 3)))]
    return float(x), float(y)


def _name(trial: Trial, tradeoff: Tradeoff) -> str:
    """Return a setting in a few words, and what it is to the comparison: "cell 2 m (recommended)"."""
    chosen = tradeoff.recommended
    marks = {
        "finest mesh": trial is tradeoff.reference,
        "recommended": chosen is not None and trial is chosen.trial,
        trial.remark.partition(":")[0]: not trial.is_sound,
    }
    told = [mark for mark, holds in marks.items() if holds]
    name = in_short(trial.changes)
    return f"{name} ({', '.join(told)})" if told else name


def _draw_stable_steps(axes: Axes, scene: Scene) -> None:
    """Tell up to which Courant number each basis and stress update is stable, and where the scene is."""
    own = scene.numerics
    bases, updates = CHOICES["numerics.basis"], CHOICES["numerics.stress_update"]
    limits = np.array([[largest_courant(basis, update) for basis in bases] for update in updates])  # type: ignore[arg-type]
    axes.imshow(limits, cmap="Blues", vmin=0.0, vmax=3.0, aspect="auto")
    for (row, column), limit in np.ndenumerate(limits):
        is_own = (bases[column], updates[row]) == (own.basis, own.stress_update)
        words = (f"{limit:g}" if limit else "never stable") + (f" (the scene: {own.courant:g})" if is_own else "")
        axes.text(column, row, words, ha="center", va="center", fontsize=9, weight="bold" if is_own else "normal")
    axes.set_xticks(range(len(bases)), [str(basis) for basis in bases])
    axes.set_yticks(range(len(updates)), [str(update) for update in updates])
    axes.tick_params(length=0)
