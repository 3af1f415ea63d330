"""`campaign validate`: every mistake in a scene, and a first look at what its campaign will be."""

import argparse
from typing import TYPE_CHECKING, NamedTuple

from campaign.commands.scene_options import add_scene, read_scene
from campaign.exit_codes import ExitCode
from campaign.terminal import paragraph, say

if TYPE_CHECKING:
    from campaign.scene import Scene
    from campaign.scene.complaints import Complaint
    from campaign.scene.first_look import FirstLook

HELP = "find every mistake in a scene; toe, factor of safety, what to expect, a trial slide, cost and memory"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--quick", action="store_true", help="without the slide with mean strengths")


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Print the first look, the slide with mean strengths, and the warnings.

    Raises
    ------
    SceneError
        When the scene is not valid, or cannot be run on this machine.
    """
    from campaign.commands.affordable import refuse_unaffordable
    from campaign.commands.first_look_text import first_look_text
    from campaign.scene.complaints import sentences
    from campaign.scene.first_look import look_at
    from campaign.scene.foresight import expected_of_slides, warnings
    from campaign.simulation.field_size import field_size, perhaps_too_large
    from campaign.statistics.stopping import too_few

    scene = read_scene(options)
    refuse_unaffordable(scene)
    look, size = look_at(scene), field_size(scene)
    say(first_look_text(scene, look, size))
    worth_saying = warnings(scene, look)
    if complaint := perhaps_too_large(size):
        worth_saying.append(complaint)
    seen = None if options.quick else _trial(scene, look)
    worth_saying += expected_of_slides(scene, look) if seen is None else seen.complaints
    told = [*sentences(worth_saying, scene), seen.remarks if seen else "", too_few(scene.campaign)]
    for sentence in filter(None, told):
        say(f"Warning: {sentence}")
    return ExitCode.DONE


class Seen(NamedTuple):
    """What the slide with mean strengths has shown: complaints about the scene, and remarks, "" if there are none."""

    complaints: "list[Complaint]"
    remarks: str


def _trial(scene: "Scene", look: "FirstLook") -> Seen | None:
    """Run the slide with mean strengths and say what it did; None if it tells nothing of slides."""
    from campaign.commands.first_look_text import MARGIN
    from campaign.commands.trial_text import trial_text
    from campaign.simulation.trial import foreseen, remarks, trial

    made = trial(scene, look)
    say(paragraph("mean strengths", trial_text(scene, made), MARGIN))
    return Seen(foreseen(scene, look, made), remarks(made)) if made is not None and made.slides else None
