"""What `campaign tradeoff` leaves: a table on the terminal and as CSV, a dataset, and a chart."""

import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from campaign.results.variables import texts, variable
from campaign.running import findings
from campaign.statistics.wording import metres
from campaign.terminal import aligned, duration
from campaign.tradeoff.settings import in_short
from campaign.tradeoff.trials import Tradeoff, Trial

NUMBERS = {
    "core_time": {"units": "s", "long_name": "core time of a realization; the estimate where none was run"},
    "mean_shift": {
        "units": "m",
        "long_name": "shift of the mean run-out against the finest mesh, from realizations that slid in both",
    },
    "mean_shift_lower": {"units": "m", "long_name": "lower bound of mean_shift"},
    "mean_shift_upper": {"units": "m", "long_name": "upper bound of mean_shift"},
    "runout_std": {"units": "m", "long_name": "standard deviation of the final run-out between realizations"},
    "campaign_core_time": {
        "units": "s",
        "long_name": "core time of a campaign whose sampling error is the attribute sampling_error",
    },
    "total_error": {
        "units": "m",
        "long_name": "total error of the mean run-out of that campaign against the finest mesh, at most",
    },
}
"""What is told of a setting in numbers, and what it means."""

NAME = "tradeoff"


def write_tradeoff(found: Tradeoff, directory: Path) -> None:
    """Print what was found and write it to `directory`.

    Raises
    ------
    RefusalError
        When nothing can be written.
    """
    told = f"{table(found)}\n\n{found.advice}{_how(found)}"
    findings.leave(directory / NAME, as_csv(found), as_dataset(found), told, partial(_draw, found))


def in_order(found: Tradeoff) -> list[Trial]:
    """Return the settings, the cheapest campaign first, then those with nothing to compare."""
    return [each.trial for each in sorted(found.judged, key=lambda each: each.sampling_cost(found.sampling))] + [
        trial for trial in found.trials if not trial.is_sound
    ]


def table(found: Tradeoff) -> str:
    """Return the table for a terminal."""
    titles = ("setting", "core s", "shift of the mean", "std m", "campaign", "error m", "")
    about = (
        f"{len(found.reference.runouts)} realizations in each setting; campaigns until sampling adds "
        f"{found.sampling:.2f} m to the total error"
    )
    return "\n".join([about, *aligned([titles, *(_line(trial, found) for trial in in_order(found))])])


def _line(trial: Trial, found: Tradeoff) -> tuple[str, ...]:
    judged = found.of(trial)
    seconds = f"{trial.seconds:.2g}" if math.isfinite(trial.seconds) else ""
    if judged is None:
        return (in_short(trial.changes), seconds, "", "", "", "", trial.remark)
    cost = judged.sampling_cost(found.sampling)
    shift = "0" if trial is found.reference else f"{judged.shift.estimate:+.2f} m ({metres(judged.shift)})"
    return (
        in_short(trial.changes),
        seconds,
        shift,
        f"{trial.std:.2f}",
        duration(cost),
        f"{judged.error(cost):.2f}",
        _marks(trial, found),
    )


def _marks(trial: Trial, found: Tradeoff) -> str:
    marks = [
        "finest mesh" if trial is found.reference else "",
        "recommended" if found.recommended and trial is found.recommended.trial else "",
        "nothing cheaper is as near" if trial in [each.trial for each in found.front] else "",
    ]
    return ", ".join(filter(None, marks))


def _how(found: Tradeoff) -> str:
    """Say how the recommended setting is taken."""
    chosen = found.recommended
    if chosen is None or not chosen.trial.changes:
        return ""
    return "\nTake it with " + " ".join(f"--set '{change}'" for change in chosen.trial.changes)


def as_csv(found: Tradeoff) -> str:
    """Return the table as comma-separated values."""
    rows: list[Sequence[object]] = [
        ("setting", *(f"{name}_{about['units']}" for name, about in NUMBERS.items()), "remark")
    ]
    for trial in in_order(found):
        numbers = [number if math.isfinite(number) else "" for number in _numbers(trial, found).values()]
        rows.append((trial.name, *numbers, trial.remark or _marks(trial, found)))
    return findings.as_csv(rows)


def as_dataset(found: Tradeoff) -> xr.Dataset:
    """Return every final run-out by setting and realization, and what follows from them."""
    trials = list(found.trials)
    rows = [_numbers(trial, found) for trial in trials]
    chosen = found.recommended
    return xr.Dataset(
        {
            "final_runout": variable(
                ("setting", "realization"),
                [trial.runouts for trial in trials],
                "m",
                "final run-out of the front that slide.front names; NaN without a slide that nothing hindered",
            ),
            **{name: variable("setting", [row[name] for row in rows], **about) for name, about in NUMBERS.items()},
            "remark": texts("setting", [trial.remark for trial in trials], "why there is nothing to compare"),
        },
        {
            "setting": texts("setting", [trial.name for trial in trials], "changes of the scene"),
            "realization": xr.Variable(
                "realization",
                np.arange(len(found.reference.runouts)),
                {"long_name": "number of the random field"},
            ),
        },
        findings.about(found.scene, "Speed against accuracy", found.advice)
        | {
            "reference": found.reference.name,
            "recommended": chosen.trial.name if chosen else "",
            "sampling_error": found.sampling,
            "mesh_doubt": found.mesh_doubt,
        },
    )


def _numbers(trial: Trial, found: Tradeoff) -> dict[str, float]:
    """Return what is told of a setting in numbers, NaN where there is nothing to compare."""
    judged = found.of(trial)
    if judged is None:
        return dict.fromkeys(NUMBERS, math.nan) | {"core_time": trial.seconds}
    cost = judged.sampling_cost(found.sampling)
    told = trial.seconds, *judged.shift[:3], trial.std, cost, judged.error(cost)
    return dict(zip(NUMBERS, told, strict=True))


def _draw(found: Tradeoff, path: Path) -> None:
    """Load what draws when there is something to draw."""
    from campaign.tradeoff.chart import draw

    draw(found, path)
