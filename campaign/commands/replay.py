"""`campaign replay`: one realization again."""

import argparse
from pathlib import Path

from campaign.exit_codes import ExitCode
from campaign.terminal import say

HELP = "one realization again, with full particle output"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("directory", metavar="DIR", type=Path)
    parser.add_argument("realization", metavar="K", type=int, help="its id; -1 is the deterministic run")


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Simulate the realization and print where its particles are."""
    from campaign.storage import manifest

    manifest.read(options.directory)  # a directory without a campaign is refused before the solver is compiled
    from campaign.results.replay import replay

    say(replay(options.directory, options.realization))
    return ExitCode.DONE
