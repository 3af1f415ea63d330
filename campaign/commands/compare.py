"""`campaign compare`: paired differences between campaigns with common seeds."""

import argparse
from pathlib import Path

from campaign.exit_codes import ExitCode

HELP = "paired differences between campaigns with common seeds"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("directories", metavar="DIR", type=Path, nargs="+", help="campaigns; all against the first")
    parser.add_argument(
        "--distance",
        metavar="LENGTH",
        action="append",
        default=[],
        help='compare the probability of a longer run-out, for instance "12 m" (repeatable)',
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        default=Path("comparison"),
        help="where to write (default: comparison); of what is there, a comparison of the same campaigns is replaced",
    )


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Print the differences and write dataset and figure.

    Raises
    ------
    CampaignError
        When there is nothing to compare, a distance cannot be read, or nothing can be written.
    """
    from campaign.comparison.scenarios import compare
    from campaign.report.comparison import refuse_campaign, write_comparison

    refuse_campaign(options.out)
    distances = [_distance(text) for text in options.distance]
    write_comparison(compare(options.directories), distances, options.out)
    return ExitCode.DONE


def _distance(text: str) -> float:
    """Read a distance in m.

    Raises
    ------
    RefusalError
        When it is none.
    """
    from campaign.errors import RefusalError
    from campaign.scene.units import LENGTH, si_value

    try:
        return si_value(text, LENGTH)
    except ValueError as error:
        raise RefusalError(f'--distance is "{text}", but {error}.') from error
