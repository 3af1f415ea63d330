"""A simplified scene as a file: without what may be dropped, and with what that rests on."""

from pathlib import Path
from textwrap import fill

from campaign.errors import RefusalError
from campaign.files import write_atomically
from campaign.scene.variant import variant_of
from campaign.scene.writing import toml_of
from campaign.screening.screening import Screening
from campaign.terminal import counted, say

HEADER = "# Simplified by campaign screen"

WIDTH = 110
"""Characters of a line of the header."""

OF_THE_STUDY = frozenset({"campaign.realizations"})
"""Keys that the study sets for itself."""


def refuse_to_overwrite(file: Path) -> None:
    """Make sure that a simplified scene can be written and takes no other file's place.

    Raises
    ------
    RefusalError
        If not; nothing has been computed then.
    """
    if file.suffix != ".toml":
        raise RefusalError(f'A scene is a TOML file, and "{file}" does not end in .toml; give {file.name}.toml.')
    if not file.parent.is_dir():
        raise RefusalError(f"{file.parent} is no directory; give another place for the simplified scene.")
    if file.exists() and not file.read_bytes().startswith(HEADER.encode()):
        raise RefusalError(f"{file} exists and is left as it is; give another name for the simplified scene.")


def write_simplified(found: Screening, file: Path) -> None:
    """Write the simplified scene, or say why there is none.

    Raises
    ------
    RefusalError
        When it cannot be written.
    """
    text = simplified_scene(found)
    if text is None:
        say(f"{file} is not written: no simpler scene was run and found to be within the tolerances.")
        return
    try:
        write_atomically(file, text.encode())
    except OSError as error:
        raise RefusalError(f"{file} cannot be written ({error}); give another place.") from error
    say(f"Simplified scene: {file}")


def simplified_scene(found: Screening) -> str | None:
    """Return the text of the simplified scene, None if there is none."""
    simplified = found.simplified
    if simplified is None:
        return None
    changes = simplified.screened.choice.changes
    n = counted(len(found.own.runouts), "realization")
    about = f"{HEADER} from {found.scene.name}, with what does not change {n} by more than {found.tolerances}."
    told = [
        fill(f"{about} {found.of_all}", WIDTH, subsequent_indent="# "),
        "# Changed, and judged all at once:",
        *(f"#     {change}" for change in changes),
    ]
    return "\n".join([*told, "", toml_of(variant_of(found.scene, changes), OF_THE_STUDY)])
