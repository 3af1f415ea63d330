"""`campaign report`: the figures and the page again."""

import argparse
from pathlib import Path

from campaign.exit_codes import ExitCode
from campaign.terminal import say

HELP = "figures and a page from results.nc"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("directory", metavar="DIR", type=Path)


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Write the page and print where it is."""
    from campaign.report.page import write_report

    say(write_report(options.directory))
    return ExitCode.DONE
