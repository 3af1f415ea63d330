"""The arguments that name a scene and change it, and the scene they mean."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from campaign.scene import Scene


def add_scene(parser: argparse.ArgumentParser, metavar: str = "SCENE|DIR") -> None:
    """Add the arguments that name a scene and change it."""
    what = "a TOML file, or the name of a built-in scene"
    also = "; or the results directory of a campaign, for its scene" if "DIR" in metavar else ""
    parser.add_argument("scene", metavar=metavar, help=what + also)
    parser.add_argument("--realizations", metavar="N", type=int, help="at most this many")
    parser.add_argument(
        "--accuracy", metavar="SHARE|LENGTH", help='total error of the mean run-out, for instance "3 %%" or "0.3 m"'
    )
    parser.add_argument("--seed", metavar="S", type=int, help="seed of the random fields")
    parser.add_argument(
        "--set", metavar="KEY=VALUE", action="append", default=[], help='for instance soil.cohesion.mean="25 kPa"'
    )


def overrides(options: argparse.Namespace) -> list[str]:
    """Return the overrides in the order of their precedence."""
    given = {name: getattr(options, name) for name in ("realizations", "accuracy", "seed")}
    named = {f"campaign.{name}": value for name, value in given.items()}
    return [*options.set, *(f"{key}={value}" for key, value in named.items() if value is not None)]


def scene_directory(options: argparse.Namespace) -> Path | None:
    """Return the results directory that stands where a scene could, None if a scene does."""
    from campaign.scene import builtin_scenes

    path = Path(options.scene)
    return path if path.is_dir() and options.scene not in builtin_scenes() else None


def read_scene(options: argparse.Namespace) -> "Scene":
    """Read the scene that the options name, from its file or from a results directory, and change it as they say.

    Raises
    ------
    CampaignError
        With every mistake in it.
    """
    from campaign.scene import load_scene

    directory = scene_directory(options)
    if directory is None:
        return load_scene(options.scene, overrides(options))
    return _scene_of(directory, overrides(options))


def _scene_of(directory: Path, changes: list[str]) -> "Scene":
    from campaign.scene import kept_scene, scene_of
    from campaign.scene.document import in_force
    from campaign.storage import manifest

    about = manifest.read(directory)
    kept = kept_scene(about["scene"], about["overrides"], about["name"])
    return scene_of(kept.text, in_force([*kept.overrides, *changes]), kept.name) if changes else kept
