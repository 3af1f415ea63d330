"""What `campaign compare` leaves: tables on the terminal, a dataset, and a figure."""

from collections.abc import Sequence
from pathlib import Path

import xarray as xr

from campaign.comparison.dataset import as_dataset
from campaign.comparison.doubts import doubts
from campaign.comparison.measures import measures
from campaign.comparison.scenarios import Comparison
from campaign.comparison.table import as_text
from campaign.errors import RefusalError
from campaign.report.figures import comparison as figure
from campaign.report.figures.style import in_style
from campaign.results import dataset
from campaign.storage.layout import MANIFEST
from campaign.terminal import say

NAME = "comparison"


def refuse_campaign(directory: Path) -> None:
    """Make sure that a directory is not a campaign's.

    Raises
    ------
    RefusalError
        When it is.
    """
    if (directory / MANIFEST).exists():
        raise RefusalError(f"{directory} holds a campaign, which a comparison must not mix with; give another --out.")


def refuse_another(given: Comparison, directory: Path) -> None:
    """Make sure that a directory holds no comparison but an earlier one of the same campaigns, which is replaced.

    Raises
    ------
    RefusalError
        When it holds another.
    """
    file = directory / f"{NAME}.nc"
    if not file.exists():
        return
    try:
        with xr.open_dataset(file) as earlier:
            compared = tuple(map(str, earlier["scenario"].values))
    except (OSError, ValueError, KeyError):
        compared = ()
    if compared != given.names:
        of = f"compares {' with '.join(compared)}" if compared else "is no comparison of this program's"
        raise RefusalError(f"{file} {of} and is left as it is; give another --out.")


def write_comparison(given: Comparison, distances: Sequence[float], directory: Path) -> None:
    """Print the differences of scenarios and write them to `directory`, over earlier ones of the same campaigns.

    Parameters
    ----------
    given : Comparison
    distances : sequence of float
        In m; the probability of a longer run-out is compared at each.
    directory : Path

    Raises
    ------
    RefusalError
        When nothing can be written, or another comparison would be lost.
    """
    refuse_another(given, directory)
    found, sentences = measures(given, distances), doubts(given)
    say(as_text(given, found, sentences))
    try:
        directory.mkdir(parents=True, exist_ok=True)
        dataset.write(as_dataset(given, found, sentences), directory / f"{NAME}.nc")
        with in_style():
            drawn = figure.comparison(given)
            about = {"Title": drawn.alt, "Description": drawn.caption}
            drawn.figure.savefig(directory / f"{NAME}.svg", metadata=about)
    except OSError as error:
        raise RefusalError(f"{directory} cannot be written ({error}); give another --out, or make room.") from error
    say(f"Dataset: {directory / f'{NAME}.nc'}\nFigure: {directory / f'{NAME}.svg'}")
