"""`campaign scenes`: what is built in."""

import argparse

from campaign.exit_codes import ExitCode
from campaign.terminal import say

HELP = "list the built-in scenes"


def add_arguments(_parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command: there are none."""


def carry_out(_options: argparse.Namespace) -> ExitCode:
    """Print a line for each scene."""
    from campaign.scene import builtin_scenes

    for name, title in builtin_scenes().items():
        say(f"{name:20}{title}")
    return ExitCode.DONE
