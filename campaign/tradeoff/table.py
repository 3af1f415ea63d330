"""What `campaign tradeoff` leaves: a table on the terminal and as CSV, a dataset, and a chart."""

import csv
import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.results import dataset
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.terminal import counted, say
from campaign.tradeoff.trials import Tradeoff, Trial, compare

COLUMNS = ("setting", "cpu_seconds", "rms_difference_m", "mean_difference_m", "without_runout", "remark")

NAME = "tradeoff"


def write_tradeoff(scene: Scene, budget: float, directory: Path) -> Tradeoff:
    """Compare the settings of a scene within a budget of CPU time (s) and write what was found to `directory`.

    Raises
    ------
    RefusalError
        When the scene gives no run-out, or nothing can be written.
    """
    try:
        directory.mkdir(parents=True, exist_ok=True)
        found = compare(scene, scene.campaign.realizations, budget, directory, say)
        write_atomically(directory / f"{NAME}.csv", as_csv(found).encode())
        dataset.write(as_dataset(found), directory / f"{NAME}.nc")
        say(f"\n{table(found)}\n\n{found.advice}")
        _draw(found, directory / f"{NAME}.png")
    except OSError as error:
        raise RefusalError(f"{directory} cannot be written ({error}); give another --out, or make room.") from error
    return found


def rows(found: Tradeoff) -> list[tuple[str, ...]]:
    """Return the table, the cheapest setting first, as text under `COLUMNS`."""
    return [_row(trial, found) for trial in sorted(found.trials, key=lambda trial: (not trial.was_run, trial.seconds))]


def table(found: Tradeoff) -> str:
    """Return the table for a terminal."""
    titles = ("setting", "CPU s", "RMS m", "mean m", "no run-out", "")
    lines = [titles, *rows(found)]
    width, fields = max(len(line[0]) for line in lines), len(found.reference.runouts) - 1
    about = f"{counted(fields, 'realization')} and the run with mean strengths in each setting"
    told = [
        f"{name:{width}} {cpu:>8} {rms:>8} {mean:>8} {failed:>11}  {remark}".rstrip()
        for name, cpu, rms, mean, failed, remark in lines
    ]
    return "\n".join([about, *told])


def as_csv(found: Tradeoff) -> str:
    """Return the table as comma-separated values."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([COLUMNS, *rows(found)])
    return text.getvalue()


def as_dataset(found: Tradeoff) -> xr.Dataset:
    """Return every final run-out by setting and realization, the deterministic run as realization -1."""
    trials: Sequence[Trial] = found.trials
    ids = np.arange(BASELINE, len(found.reference.runouts) + BASELINE)
    runouts = np.stack([trial.runouts for trial in trials])
    seconds = np.array([trial.seconds for trial in trials])
    runout_about = {
        "units": "m",
        "long_name": "final run-out of the front that slide.front names; NaN where there is none",
    }
    overrides = "\n".join(found.scene.overrides)
    cpu_about = {"units": "s", "long_name": "median CPU time of a realization; the estimate where none was run"}
    return xr.Dataset(
        {
            "final_runout": (("setting", "realization"), runouts, runout_about),
            "cpu_time": ("setting", seconds, cpu_about),
            "remark": ("setting", np.array([trial.reason for trial in trials], dtype=object)),
        },
        {"setting": np.array([trial.setting for trial in trials], dtype=object), "realization": ids},
        {
            "reference": found.reference.setting,
            "advice": found.advice,
            "scene": found.scene.text,
            "scene_overrides": overrides,
        },
    )


def _row(trial: Trial, found: Tradeoff) -> tuple[str, ...]:
    reference = found.reference
    if not trial.was_run:
        return (trial.setting, f"{trial.seconds:.3g}", "", "", "", trial.reason)
    marks = [
        "reference" if trial is reference else "",
        "recommended" if trial is found.recommended else "",
        "nothing cheaper is as near" if trial in found.front else "",
        trial.reason,
    ]
    known = "" if trial.failures else f"{trial.rms(reference):.3f}"
    mean = "" if trial.failures else f"{trial.bias(reference):+.3f}"
    return (trial.setting, f"{trial.seconds:.3g}", known, mean, _failed(trial), ", ".join(filter(None, marks)))


def _failed(trial: Trial) -> str:
    """Say how many runs gave no run-out, because they failed, stood or met a wall; that with mean strengths is one."""
    return f"{trial.failures} of {counted(len(trial.runouts), 'run')}" if trial.failures else "0"


def _draw(found: Tradeoff, path: Path) -> None:
    from campaign.tradeoff.chart import draw

    draw(found, path)
    say(f"Chart: {path}")
