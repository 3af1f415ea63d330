"""From the text of a scene file to a valid scene."""

from collections.abc import Iterable
from pathlib import Path

from campaign.errors import RefusalError, SceneError
from campaign.scene.boring_data import impossible_data
from campaign.scene.check import mistakes
from campaign.scene.document import Document, document_of, location_of, read_document
from campaign.scene.scene import Scene
from campaign.scene.sections import SceneFile
from campaign.scene.wording import wrong_value

EXAMPLE = "ma2023"


def load_scene(source: str | Path | Scene, overrides: Iterable[str] = ()) -> Scene:
    """Read and validate a scene.

    Parameters
    ----------
    source
        A TOML file, the name of a built-in scene, or a scene that is to be changed.
    overrides
        "KEY=VALUE" with a dotted key; a value that is not TOML is taken as text, because shells strip quotes.

    Raises
    ------
    SceneError
        With every mistake at once.
    """
    if isinstance(source, Scene):
        return scene_of(source.text, [*source.overrides, *overrides], source.name)
    return _validated(read_document(source, overrides))


def scene_of(text: str, overrides: Iterable[str] = (), name: str = "scene") -> Scene:
    """Validate a scene from its TOML text.

    Raises
    ------
    SceneError
        With every mistake at once.
    """
    return _validated(document_of(text, overrides, f"{name}.toml"))


def kept_scene(text: str, overrides: Iterable[str], name: str = "scene") -> Scene:
    """Read a scene again from the text and the overrides that a campaign has kept.

    Raises
    ------
    RefusalError
        When this version does not accept it any more.
    """
    try:
        return scene_of(text, overrides, name)
    except SceneError as error:
        raise RefusalError(f"This version does not accept the scene of the campaign any more. {error}") from error


def _validated(document: Document) -> Scene:
    if messages := mistakes(document, SceneFile, read_document(EXAMPLE)):
        raise SceneError(messages)
    origin = {"name": document.name, "text": document.text, "overrides": document.overrides}
    scene = Scene.model_validate(document.tables | origin)
    if impossible := [wrong_value(location_of(key), text, document) for key, text in impossible_data(scene)]:
        raise SceneError(impossible)
    return scene
