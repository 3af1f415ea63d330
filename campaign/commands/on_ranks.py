"""What commands share that several ranks carry out together."""

import argparse
import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.commands.scene_options import read_scene
from campaign.running.launcher import SIZES

if TYPE_CHECKING:
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
