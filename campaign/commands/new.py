"""`campaign new`: a commented scene to start from."""

import argparse
from pathlib import Path

from campaign.exit_codes import ExitCode
from campaign.terminal import say

HELP = "a commented scene file to start from"

TEMPLATE = "ma2023"

HEADER = """\
# {name}: how far will this slope run, and how sure are we?
#
# Replace the values by those of your slope and look at it before you run it; the second command draws a picture.
#
#     campaign validate {file}
#     campaign draw {file}
#     mpirun -n 4 campaign run {file} --out results
#
# Every dimensional value carries its unit. "paper" is Ma, Rezania and Mousavi Nezhad, "Large deformation modeling of
# landslides using stochastic MPM with interdependent variables", whose slope this is until you change it, and "ours"
# what it does not say. A slope of several faces is given by its points instead of [geometry.slope]:
#
#     [geometry]
#     surface = [["0 m", "19 m"], ["20 m", "19 m"], ["35 m", "4 m"], ["75 m", "4 m"]]   # x and elevation above the base
#     toe = "35 m"               # from which run-out is measured; if left out, the foot of the slope of all faces

title = {title}
"""

OF_ANY_SLOPE = {
    r"front_area = .*": '# front_area = "2.2 m^2"        # slid ground ahead of the front; if left out, height^2 / 100',
    r"# The paper gives no other length(?:.*\n#)*.*": "# The flats above and below it, and the ground under its toe.",
    r'(crest = "20 m" +)# ours: .*': r"\1# ours: as far behind it as slides may take ground, or farther",
    r'(foundation = "4 m" +)# ours: .*': r"\1# ours: as deep as slip surfaces may go, or down to rock",
    r"filling = .*": 'filling = "cut"                # particles at the surface have the area that they have below it',
    r"# The one free parameter(?:.*\n#)*.*": """\
# No input moves the run-out more, and none is measured less: replace it by slip_to_residual = "0.3 m", the slip after
# which a ring shear test has lost 95 % of the drop from peak to residual strength (0.1 to 0.5 m in clay). This rate is
# calibrated to one published run-out and is a slip of 34 m.""",
}
"""Lines of the built-in scene that speak of that slope alone, by regular expressions, and what a new scene has there.

What front suits a slope of 15 m in the paper is a fraction of a particle in a larger one.
"""

LAYERS_AND_RECEPTORS = """

# Layers below [soil], from above to below; whatever one leaves out is as in [soil].
#
#     [[layer]]
#     name = "soft clay"
#     top = "6 m"               # elevation above the base, or points from wall to wall as in surface; or depth = "3 m"
#     unit_weight = "17 kN/m^3"
#     cohesion = {mean = "15 kPa"}

# Water in the ground; strengths are effective then.
#
#     [water]
#     table = [["0 m", "15 m"], ["20 m", "12 m"], ["35 m", "4 m"], ["75 m", "4 m"]]   # x and elevation, wall to wall
#     level = "6 m"             # of water that stands over the toe; left out, there is none

# Values measured in borings, at depths below the surface; fields go through them.
#
#     [[boring]]
#     name = "B1"
#     x = "28 m"
#     cohesion = [["1 m", "18 kPa"], ["3 m", "25 kPa"]]

# Places asked about, such as a road or the walls of a house: whether the slide reaches them, and what arrives.
#
#     [[receptor]]
#     name = "road"
#     x = ["46 m", "50 m"]      # or one x; counted from the wall behind the crest, as in surface
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("file", metavar="FILE", type=Path, help="for instance my-slope.toml; must not exist")


def carry_out(options: argparse.Namespace) -> ExitCode:
    """Write the scene and say what to do with it.

    Raises
    ------
    RefusalError
        When the file exists, cannot be written, or would not be read as a scene.
    """
    from campaign.errors import RefusalError

    file: Path = options.file
    if file.suffix != ".toml":
        raise RefusalError(f'A scene is a TOML file, and "{file}" does not end in .toml; give {file.name}.toml.')
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(new_scene(file))
    except FileExistsError:
        raise RefusalError(f"{file} exists and is left as it is; give another name.") from None
    except (OSError, ValueError) as error:
        raise RefusalError(f"{file} cannot be written ({error}); give another place.") from error
    say(f"{file}: the slope of {TEMPLATE}, to be changed. Then: campaign validate {file}")
    return ExitCode.DONE


def new_scene(file: Path) -> str:
    """Return the text of a built-in scene with a header for a new user."""
    import json
    import re

    from campaign.scene.document import read_document

    body = read_document(TEMPLATE).text.partition("\ntitle = ")[2].partition("\n")[2]
    for of_template, text in OF_ANY_SLOPE.items():
        body = re.sub(f"(?m)^{of_template}$", text, body)
    title = json.dumps(file.stem, ensure_ascii=False)
    return HEADER.format(name=file.stem, file=file.name, title=title) + body.rstrip("\n") + LAYERS_AND_RECEPTORS
