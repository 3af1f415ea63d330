"""`campaign status`: how a campaign stands."""

import argparse
from pathlib import Path

from campaign.exit_codes import ExitCode
from campaign.terminal import say

HELP = "how a campaign stands, while it runs or after"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("directory", metavar="DIR", type=Path)
    parser.add_argument("--watch", action="store_true", help="again and again, until it ends")
    parser.add_argument(
        "--check",
        action="store_true",
        help="end with the exit code of the campaign, 75 if it was killed or is at work",
    )


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Print the state of the campaign."""
    from campaign.running.standing import conclusion, status, watch

    if options.watch:
        watch(options.directory)
    else:
        say(status(options.directory))
    return conclusion(options.directory) if options.check else ExitCode.DONE
