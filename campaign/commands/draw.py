"""`campaign draw`: the section of a scene and the field of a realization, before anything is run."""

import argparse
from pathlib import Path

from campaign.commands.scene_options import add_scene, read_scene
from campaign.exit_codes import ExitCode
from campaign.terminal import say

HELP = "the section with toe, mesh, receptors and critical circle, and a realization's field"

FORMATS = (".png", ".svg")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_scene(parser)
    parser.add_argument("--realization", metavar="K", type=int, default=0, help="whose field (default: 0)")
    parser.add_argument("--out", metavar="FILE", type=Path, help="a .png or .svg (default: NAME-section.png)")


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Draw the scene and print where.

    Raises
    ------
    CampaignError
        When the scene is refused, there is no such realization, or nothing can be written there.
    """
    from campaign.commands.affordable import refuse_unaffordable
    from campaign.errors import RefusalError

    scene = read_scene(options)
    path = options.out or Path(f"{scene.name}-section.png")
    if path.suffix.lower() not in FORMATS:
        raise RefusalError(f"{path} does not say what it is to be; give a name that ends in {' or '.join(FORMATS)}.")
    if options.realization < 0:
        raise RefusalError(f"There is no field of a realization {options.realization}; give 0 or more.")
    refuse_unaffordable(scene)
    from campaign.report.figures.scene_section import save

    try:
        save(scene, options.realization, path)
    except OSError as error:
        raise RefusalError(f"{path} cannot be written ({error}); give another --out.") from error
    say(path)
    return ExitCode.DONE
