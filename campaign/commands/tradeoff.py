"""`campaign tradeoff`: speed against accuracy."""

import argparse
from pathlib import Path

from campaign.commands.scene_options import add_scene, read_scene
from campaign.exit_codes import ExitCode

HELP = "speed against accuracy: chart, table, recommended setting"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--out", metavar="DIR", type=Path, help="directory of the results (default: tradeoff-NAME)")
    parser.add_argument("--budget", metavar="MINUTES", type=float, default=10.0, help="CPU time it may take")
    parser.set_defaults(realizations=3)


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Compare the settings of the scene."""
    from campaign.tradeoff.table import write_tradeoff

    scene = read_scene(options)
    write_tradeoff(scene, 60 * options.budget, options.out or Path(f"tradeoff-{scene.name}"))
    return ExitCode.DONE
