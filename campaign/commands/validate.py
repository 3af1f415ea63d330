"""`campaign validate`: every mistake in a scene, and a first look at what its campaign will be."""

import argparse

from campaign.commands.scene_options import add_scene, read_scene
from campaign.exit_codes import ExitCode

HELP = "find every mistake in a scene; toe, factor of safety, what to expect, cost and memory"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_scene(parser)


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Print the first look and the warnings.

    Raises
    ------
    SceneError
        When the scene is not valid, or cannot be run on this machine.
    """
    from campaign.commands.affordable import refuse_unaffordable
    from campaign.commands.first_look_text import first_look_text
    from campaign.scene.complaints import sentences
    from campaign.scene.first_look import look_at
    from campaign.scene.foresight import warnings
    from campaign.simulation.field_size import field_size, perhaps_too_large

    scene = read_scene(options)
    refuse_unaffordable(scene)
    look, size = look_at(scene), field_size(scene)
    print(first_look_text(scene, look, size))
    worth_saying = warnings(scene, look)
    if complaint := perhaps_too_large(size):
        worth_saying.append(complaint)
    for sentence in sentences(worth_saying, scene):
        print(f"Warning: {sentence}")
    return ExitCode.DONE
