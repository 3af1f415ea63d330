"""What a study leaves in its directory: its table as CSV, its dataset and its chart."""

import csv
import io
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import xarray as xr

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.results import dataset
from campaign.scene import Scene
from campaign.terminal import say


def as_csv(rows: Iterable[Sequence[object]]) -> str:
    """Return rows as comma-separated values."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def about(scene: Scene, title: str, advice: str) -> dict[str, str | float]:
    """Return the attributes that every study's dataset has."""
    return {
        "Conventions": "CF-1.11",
        "title": f"{title}: {scene.title}",
        "advice": advice,
        "confidence": scene.campaign.confidence,
        "scene": scene.text,
        "scene_overrides": "\n".join(scene.overrides),
    }


def leave(stem: Path, table: str, data: xr.Dataset, told: str, draw: Callable[[Path], None]) -> None:
    """Write what a study has found and say it: a terminal may fail, the results must be safe.

    Parameters
    ----------
    stem
        Path of the files, without their suffix.
    table
        Comma-separated values.
    data
        What the table tells, and what it rests on.
    told
        For the terminal.
    draw
        Writes the chart as a PNG.

    Raises
    ------
    RefusalError
        When nothing can be written.
    """
    try:
        write_atomically(stem.with_suffix(".csv"), table.encode())
        dataset.write(data, stem.with_suffix(".nc"))
        say(f"\n{told}")
        chart = stem.with_suffix(".png")
        draw(chart)
    except OSError as error:
        raise RefusalError(f"{stem.parent} cannot be written ({error}); give another --out, or make room.") from error
    say(f"Chart: {chart}")
