"""`campaign run`: run a campaign, or continue it."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.commands.on_ranks import prepare, scene_reader
from campaign.commands.scene_options import add_scene, scene_directory
from campaign.exit_codes import ExitCode

if TYPE_CHECKING:
    from campaign.scene import Scene

HELP = "run a campaign, or continue it"

RETRIED = "crashed, timeout, or both with a comma between"
"""What may end otherwise the next time."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_scene(parser)
    parser.add_argument(
        "--out", metavar="DIR", type=Path, help="results directory (default: DIR if that is given, or campaign-NAME)"
    )
    parser.add_argument(
        "--retry", metavar="STATUS", type=_statuses, default=(), help=f"run those again that ended so: {RETRIED}"
    )
    parser.add_argument("--allow-drift", action="store_true", help="continue what another version of the solver began")


def _statuses(text: str) -> tuple[str, ...]:
    names = tuple(text.split(","))
    if not {"crashed", "timeout"}.issuperset(names):
        raise argparse.ArgumentTypeError(f"{text!r} is not {RETRIED}")
    return names


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Run the campaign on all ranks.

    Raises
    ------
    CampaignError
        When the scene is refused and no launcher waits for this process.
    """
    return _run_on_ranks(options, scene_reader(options))


def _run_on_ranks(options: argparse.Namespace, read: "Callable[[], Scene]") -> ExitCode:
    from campaign.running.guard import ending_all_ranks
    from campaign.running.stop_request import listening

    with listening() as stop, ending_all_ranks():  # before anything else is imported, which may take long
        from campaign.record import Status
        from campaign.running.campaign_directory import Earlier
        from campaign.running.mpi import run_on_ranks

        return run_on_ranks(
            read,
            options.out or scene_directory(options),
            prepare,
            _write_report,
            Earlier(options.allow_drift, frozenset(Status[name] for name in options.retry)),
            stop,
        )


def _write_report(directory: Path, simulate: bool) -> Path:
    """Load what draws when there is something to draw, and on no rank that draws nothing."""
    from campaign.report.page import write_report

    return write_report(directory, simulate)
