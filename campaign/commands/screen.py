"""`campaign screen`: which modelling choices a scene needs."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.commands.on_ranks import add_study, carry_out_study, prepare
from campaign.exit_codes import ExitCode

if TYPE_CHECKING:
    from campaign.running.means import Lead

HELP = "which modelling choices this scene needs, and which it may drop"

ENOUGH = 80
"""Realizations: of fewer than 73 pairs a probability that never changes is not known to 5 points at 95 %."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_study(parser, "screen", ENOUGH)
    parser.add_argument(
        "--simplified", metavar="FILE", type=Path, help="write the scene without all that it may drop, as a TOML file"
    )


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Screen the choices of the scene on all ranks.

    Raises
    ------
    CampaignError
        When the scene is refused and no launcher waits for this process.
    """

    def load() -> "Lead":
        from campaign.screening.screen import lead

        return lead(60 * options.budget, prepare, options.simplified)

    return carry_out_study(options, load)
