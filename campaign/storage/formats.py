"""The format of what a campaign keeps, and which program can read it.

One number covers a results directory with everything in it: manifest, records, packs and dataset.

| format | since | what is new |
|---|---|---|
| 0 | 0.1.0 | no number anywhere; a pack holds a group for each realization |
| 1 | 0.2.0 | every file says its format; records and packs begin with a checksum of their bytes; packs hold columns |
| 2 | 0.3.0 | the status `reached_wall`; the dataset tells statistics of all realizations from those of the slides |

A change that an older program would misread raises the number. A new quantity does not: a reader takes what a record
holds, and what it lacks is missing.
"""

from importlib.metadata import PackageNotFoundError, version

from campaign.errors import RefusalError

FORMAT = 2
"""What this program writes; it reads all formats up to this one."""

READER = "0.3.0"
"""The oldest version of the program that reads `FORMAT`."""


def check_format(number: int, reader: str, place: str) -> None:
    """Make sure that this program reads a format.

    Parameters
    ----------
    number
        The format that a file says it has; 0 where it says nothing.
    reader
        The oldest version that reads it, as the file says.
    place
        Names the file in the error.

    Raises
    ------
    RefusalError
        When the format is newer than `FORMAT`.
    """
    if number > FORMAT:
        raise RefusalError(
            f"{place} has format {number}, and this version ({program_version() or READER}) reads formats up to "
            f"{FORMAT}. Use runout-campaign {reader} or newer."
        )


def program_version() -> str:
    """Return the version of this program, "" if it is not installed."""
    try:
        return version("runout-campaign")
    except PackageNotFoundError:
        return ""
