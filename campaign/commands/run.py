"""`campaign run`: run a campaign, or continue it."""

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.commands.scene_options import add_scene, read_scene, scene_directory
from campaign.exit_codes import ExitCode
from campaign.running.launcher import SIZES

if TYPE_CHECKING:
    from campaign.scene import Scene
    from campaign.simulation.ground import Ground

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
    if was_launched():  # other ranks wait for this one in MPI, and only rank 0 may read the scene
        return _run_on_ranks(options, None)
    return _run_on_ranks(options, _scene_that_can_run(options))


def was_launched() -> bool:
    """Whether this process is one of several, or was started by mpirun or srun."""
    return any(name in os.environ for name in SIZES)


def _scene_that_can_run(options: argparse.Namespace) -> "Scene":
    from campaign.commands.affordable import refuse_unaffordable

    scene = read_scene(options)
    refuse_unaffordable(scene)
    return scene


def _run_on_ranks(options: argparse.Namespace, scene: "Scene | None") -> ExitCode:
    from campaign.running.guard import ending_all_ranks
    from campaign.running.stop_request import listening

    with listening() as stop, ending_all_ranks():  # before anything else is imported, which may take long
        from campaign.record import Status
        from campaign.running.campaign_directory import Earlier
        from campaign.running.mpi import run_on_ranks

        return run_on_ranks(
            lambda: scene or _scene_that_can_run(options),
            options.out or scene_directory(options),
            _prepare,
            _write_report,
            Earlier(options.allow_drift, frozenset(Status[name] for name in options.retry)),
            stop,
        )


def _prepare(scene: "Scene", directory: Path) -> "Ground":
    """Load the solver when it is needed, and not before a mistake in the scene is told."""
    from campaign.simulation.ground import prepare_to_run

    return prepare_to_run(scene, directory)


def _write_report(directory: Path, simulate: bool) -> Path:
    """Load what draws when there is something to draw, and on no rank that draws nothing."""
    from campaign.report.page import write_report

    return write_report(directory, simulate)
