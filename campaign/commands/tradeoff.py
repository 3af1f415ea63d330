"""`campaign tradeoff`: speed against accuracy."""

import argparse
from typing import TYPE_CHECKING

from campaign.commands.on_ranks import add_study, carry_out_study, prepare
from campaign.exit_codes import ExitCode

if TYPE_CHECKING:
    from campaign.running.means import Lead

HELP = "speed against accuracy: chart, table, recommended setting"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_study(parser, "tradeoff", realizations=12)


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Compare the settings of the scene on all ranks.

    Raises
    ------
    CampaignError
        When the scene is refused and no launcher waits for this process.
    """

    def load() -> "Lead":
        from campaign.tradeoff.compare import lead

        return lead(60 * options.budget, prepare)

    return carry_out_study(options, load)
