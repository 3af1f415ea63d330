"""What `campaign screen` leaves: a table on the terminal and as CSV, a dataset, and a chart."""

import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from campaign.results.variables import texts, variable
from campaign.running import findings
from campaign.screening.effects import Realizations
from campaign.screening.screening import Screened, Screening
from campaign.screening.verdict import Effect
from campaign.terminal import aligned, counted

NAME = "screen"


def write_screening(found: Screening, directory: Path) -> None:
    """Print what was found and write it to `directory`.

    Raises
    ------
    RefusalError
        When nothing can be written.
    """
    told = f"{table(found)}\n\n{found.advice}"
    findings.leave(directory / NAME, as_csv(found), as_dataset(found), told, partial(_draw, found))


def table(found: Screening) -> str:
    """Return the table for a terminal."""
    about = f"{counted(len(found.own.runouts), 'realization')} of each; what does not matter: {found.tolerances}"
    receptors = (f"P({receptor.name})" for receptor in found.scene.receptor)
    titles = ("choice -> instead", "mean m", "std m", "P(slide) points", *receptors, "cost", "verdict")
    rows = [_line(each, found) for each in found.rows]
    return "\n".join([about, *aligned([titles, *rows])])


def _line(each: Screened, found: Screening) -> tuple[str, ...]:
    blank = [""] * (3 + len(found.scene.receptor))
    numbers = [effect.told for effect in each.effects] or blank
    cost = f"{found.cost(each):.2g}" if each.realizations else ""
    return (each.name, *numbers, cost, each.remark)


def as_csv(found: Screening) -> str:
    """Return the table as comma-separated values: a row for each choice and number."""
    rows: list[Sequence[object]] = [
        ("choice", "instead", "number", "unit", "change", "lower", "upper", "tolerance", "cost", "verdict")
    ]
    for each in found.rows:
        choice, cost = (each.choice.name, each.choice.instead), found.cost(each)
        ending = (cost if math.isfinite(cost) else "", each.remark)
        if not each.effects:
            rows.append((*choice, *[""] * 6, *ending))
        for effect in each.effects:
            interval = effect.difference.interval
            rows.append((*choice, effect.words, effect.unit, *interval[:3], effect.tolerance, *ending))
    return findings.as_csv(rows)


def as_dataset(found: Screening) -> xr.Dataset:
    """Return every run-out by choice and realization, what each choice changes, and its verdict."""
    rows = found.rows
    everything = [found.own, *(each.realizations for each in rows)]
    variables = {
        "final_runout": variable(
            ("variant", "realization"),
            [_runouts(each, found) for each in everything],
            "m",
            "final run-out of the front that slide.front names; 0 without a slide, NaN without a result",
        ),
        "core_time": variable(
            "variant",
            [each.seconds if each else math.nan for each in everything],
            "s",
            "core time of the time steps of a realization, estimated from their number",
        ),
        "verdict": texts("choice", [str(each.verdict) for each in rows], "what to do with the choice"),
        "remark": texts("choice", [each.remark for each in rows], "verdict, and what it lacks"),
        "changes": texts("choice", ["\n".join(each.choice.changes) for each in rows], "changes of the scene"),
        "same_fields": variable(
            "choice", [not each.choice.redraws for each in rows], "1", "1 where pairs have the same ground", "i1"
        ),
    }
    for number, effect in enumerate(next((each.effects for each in rows if each.effects), ())):
        variables |= _of_effect(number, effect, rows)
    names = [each.name for each in rows]
    coordinates = {
        "variant": texts("variant", ["the scene itself", *names], "the scene, and what takes a choice's place"),
        "choice": texts("choice", names, "what is modelled -> what takes its place"),
        "realization": variable("realization", range(len(found.own.runouts)), "1", "number of the random field", "i4"),
    }
    return xr.Dataset(
        variables,
        coordinates,
        findings.about(found.scene, "Which modelling choices matter", found.advice) | {"tolerances": found.tolerances},
    )


def _runouts(each: Realizations | None, found: Screening) -> object:
    return np.full(len(found.own.runouts), np.nan) if each is None else each.runouts


def _of_effect(number: int, effect: Effect, rows: list[Screened]) -> dict[str, xr.Variable]:
    intervals = [each.effects[number].difference.interval[:3] if each.effects else [math.nan] * 3 for each in rows]
    unit, told = effect.unit, f"change of: {effect.words}"
    return {
        f"{effect.variable}_difference": variable("choice", [row[0] for row in intervals], unit, told),
        f"{effect.variable}_difference_ci": variable(
            ("choice", "bound"), [row[1:3] for row in intervals], unit, f"confidence interval of the {told}"
        ),
        f"{effect.variable}_tolerance": variable((), effect.tolerance, unit, f"what does not matter of the {told}"),
    }


def _draw(found: Screening, path: Path) -> None:
    """Load what draws when there is something to draw."""
    from campaign.screening.chart import draw

    draw(found, path)
