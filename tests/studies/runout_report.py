"""The run-out study as a page and a figure."""

import math

import matplotlib.pyplot as plt
import numpy as np
from runout_ladders import BY_CELL, NOISE, OTHERS, key_of

from campaign.report.figures.style import BLACK, BLUE, GREEN, GREY, ORANGE, WIDTH, in_style

LEGEND = [
    ("ma2023: cell averages, internal length", BLUE, "o-"),
    ("the same, 9 particles a cell", GREEN, "s-"),
    ("the same without softening", GREY, "^-"),
    ("plain uGIMP, rate of softening per cell", ORANGE, "o--"),
    ("cell averages, rate of softening per cell", BLACK, "s--"),
]

LARGEST_LAST_CHANGE = 0.05  # of the run-out, when the cell is halved for the last time: beyond it no limit is given

INTRODUCTION = """\
# How far from converged the run-out of `ma2023` is

Made by `python tests/studies/runout.py`. Deterministic runs; run-out is `final_runout_mass` in m.

## Cell size

| | {cells} | order | limit | 0.5 m against the limit |
|---|{rules}|
"""

OTHERS_HEAD = """
## Everything else, on cells of 0.5 m ({base:.2f} m as the scene says)

| | run-out and its change |
|---|---|"""

NOISE_HEAD = """
## Noise floor: the toe at places between two nodes

| cells | runs | mean | standard deviation | range |
|---|---|---|---|---|"""

EXPLANATION = """
The order is that of the last three cells, each half the one before, where they approach a limit from one side; the
limit is extrapolated with that order, but with no less than 1, which is what a band or a front between two nodes
allows. Where they do not, the limit is the mean of the last two. "-": there is none, or the last halving of the cell
still changes the run-out by more than 5 %. Two errors of coarse cells have opposite signs here: without softening they
hold the slide back, with softening they weaken ground that yields as a whole too much.

![Run-out against the cell size](runout.png)
"""


def runouts(ladder, results):
    """Return cells (m) and run-outs (m) of a ladder."""
    cells = np.array([run.cell for run in ladder.runs])
    return cells, np.array([results[key_of(run)]["final_runout_mass"] for run in ladder.runs])


def extrapolate(values):
    """Return observed order (NaN if none) and limit of three values on cells that are halved."""
    before, after = values[1] - values[0], values[2] - values[1]
    if before * after <= 0.0 or abs(after) >= abs(before):
        return math.nan, 0.5 * (values[1] + values[2])
    order = math.log2(before / after)
    return order, values[2] + after / (2.0 ** max(order, 1.0) - 1.0)


def cell_row(ladder, results, columns):
    """Return the line of a ladder of cell sizes."""
    cells, values = runouts(ladder, results)
    shown = [f"{values[cells == column][0]:.2f}" if column in cells else "" for column in columns]
    has_limit = abs(values[-1] - values[-2]) < LARGEST_LAST_CHANGE * values[-1]
    order, limit = extrapolate(values[-3:]) if has_limit else (math.nan, math.nan)
    at_half = values[cells == 0.5][0]
    end = [
        "-" if math.isnan(order) else f"{order:.1f}",
        "-" if math.isnan(limit) else f"{limit:.2f}",
        "-" if math.isnan(limit) else f"{at_half / limit - 1.0:+.1%}",
    ]
    return "| " + " | ".join([ladder.title, *shown, *end]) + " |"


def other_lines(results):
    """Return a table of everything else, all on cells of 0.5 m."""
    base = results[key_of(BY_CELL[0].runs[2])]["final_runout_mass"]
    yield OTHERS_HEAD.format(base=base)
    for ladder in OTHERS:
        found = []
        for run in ladder.runs:
            result = results[key_of(run)]
            value = result["final_runout_mass"]
            state = ", not at rest" if result["status"] == "not_settled" else ""
            found.append(f"{run.label}: {value:.2f} ({value / base - 1.0:+.1%}{state})")
        yield f"| {ladder.title} | {'; '.join(found)} |"


def noise_lines(results):
    """Return the table of the noise floor."""
    yield NOISE_HEAD
    for ladder in NOISE:
        _, values = runouts(ladder, results)
        yield (
            f"| {ladder.title} | {values.size} | {values.mean():.2f} | {values.std(ddof=1):.2f} "
            f"| {values.min():.2f} to {values.max():.2f} |"
        )


def draw(results, path):
    """Draw run-out against cell size."""
    with in_style():
        figure, axes = plt.subplots(figsize=(WIDTH, 3.6), layout="constrained")
        for ladder, (label, colour, marker) in zip(BY_CELL, LEGEND, strict=True):
            cells, values = runouts(ladder, results)
            axes.plot(cells, values, marker, color=colour, markersize=4, label=label)
        axes.set_xscale("log", base=2)
        axes.set_xticks([2.0, 1.0, 0.5, 0.25, 0.125], ["2", "1", "0.5", "0.25", "0.125"])
        axes.invert_xaxis()
        axes.set(xlabel="cell size (m)", ylabel="final run-out (m)", ylim=(0.0, None))
        axes.legend(loc="lower right", ncols=1)
        figure.savefig(path)


def write(results, page, picture):
    """Write the page and the figure beside it."""
    columns = [run.cell for run in BY_CELL[0].runs]
    head = INTRODUCTION.format(cells=" | ".join(f"{c:g} m" for c in columns), rules="---|" * (len(columns) + 2) + "---")
    lines = [cell_row(ladder, results, columns) for ladder in BY_CELL]
    body = [*lines, EXPLANATION.rstrip("\n"), *other_lines(results), *noise_lines(results)]
    page.write_text(head + "\n".join(body) + "\n", "utf-8")
    draw(results, picture)
