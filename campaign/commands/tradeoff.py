"""`campaign tradeoff`: speed against accuracy."""

import argparse
from pathlib import Path

from campaign.commands.on_ranks import prepare, scene_reader
from campaign.commands.scene_options import add_scene
from campaign.exit_codes import ExitCode

HELP = "speed against accuracy: chart, table, recommended setting"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--out", metavar="DIR", type=Path, help="directory of the results (default: tradeoff-NAME)")
    parser.add_argument("--budget", metavar="MINUTES", type=float, default=10.0, help="core time it may take")
    parser.set_defaults(realizations=12)


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Compare the settings of the scene on all ranks.

    Raises
    ------
    CampaignError
        When the scene is refused and no launcher waits for this process.
    """
    read = scene_reader(options)
    from campaign.running.guard import ending_all_ranks
    from campaign.running.stop_request import listening

    with listening() as stop, ending_all_ranks():  # before anything else is imported, which may take long
        from campaign.running.mpi import on_ranks
        from campaign.tradeoff.compare import lead

        return on_ranks(
            read,
            lambda scene: options.out or Path(f"tradeoff-{scene.name}"),
            lead(60 * options.budget, prepare),
            stop=stop,
        )
