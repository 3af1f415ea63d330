"""What commands share that several ranks carry out together."""

import argparse
import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.commands.scene_options import add_scene, read_scene
from campaign.exit_codes import ExitCode
from campaign.running.launcher import SIZES

if TYPE_CHECKING:
    from campaign.running.means import Lead
    from campaign.scene import Scene
    from campaign.simulation.ground import Ground


def was_launched() -> bool:
    """Whether this process is one of several, or was started by mpirun or srun."""
    return any(name in os.environ for name in SIZES)


def scene_reader(options: argparse.Namespace) -> "Callable[[], Scene]":
    """Return what gives the scene to rank 0.

    A process alone reads it at once. Of several the others wait in MPI, and only rank 0 may read the scene, there.

    Raises
    ------
    CampaignError
        When the scene is refused and no launcher waits for this process.
    """
    if was_launched():
        return lambda: _scene_that_can_run(options)
    scene = _scene_that_can_run(options)
    return lambda: scene


def _scene_that_can_run(options: argparse.Namespace) -> "Scene":
    from campaign.commands.affordable import refuse_unaffordable

    scene = read_scene(options)
    refuse_unaffordable(scene)
    return scene


def prepare(scene: "Scene", directory: Path) -> "Ground":
    """Load the solver when it is needed, and not before a mistake in the scene is told."""
    from campaign.simulation.ground import prepare_to_run

    return prepare_to_run(scene, directory)


def add_study(parser: argparse.ArgumentParser, name: str, realizations: int) -> None:
    """Add the arguments of a study, which takes so many realizations if nobody says otherwise."""
    add_scene(parser)
    parser.add_argument("--out", metavar="DIR", type=Path, help=f"directory of the results (default: {name}-NAME)")
    parser.add_argument("--budget", metavar="MINUTES", type=float, default=10.0, help="core time it may take")
    parser.set_defaults(realizations=realizations)


def carry_out_study(options: argparse.Namespace, load: "Callable[[], Lead]") -> ExitCode:
    """Carry out a study on all ranks; `load` returns what leads it.

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

        return on_ranks(read, lambda scene: options.out or Path(f"{options.command}-{scene.name}"), load(), stop=stop)
