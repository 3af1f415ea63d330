"""What a study leaves in its directory: its table as CSV, its dataset and its chart."""

from collections.abc import Callable
from pathlib import Path

import xarray as xr

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.results import dataset
from campaign.terminal import say


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
