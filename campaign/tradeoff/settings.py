"""The settings of a scene among which speed and accuracy are to be weighed."""

from collections.abc import Sequence

from campaign.accuracy.settings import SOFTER
from campaign.running.study import OWN, Changes
from campaign.scene import Scene
from campaign.scene.variant import with_cell, with_stiffness
from solver.timestep import largest_courant

CHOICES: dict[str, Sequence[str | int | float]] = {
    "numerics.basis": ("gimp", "linear", "bspline"),
    "numerics.stress_update": ("musl", "usl", "usf"),
    "numerics.locking": ("none", "cell-average"),
    "numerics.courant": (0.3, 0.6, 0.9),
    "numerics.particles_per_cell": (4, 9, 16),
}


WORDS = {
    "numerics.cell": "cell {}",
    "numerics.basis": "{} basis",
    "numerics.stress_update": "{}",
    "numerics.locking": "locking {}",
    "numerics.courant": "Courant {}",
    "numerics.particles_per_cell": "{} particles a cell",
    "soil.young_modulus": "E {}",
}
"""How a change is told where there is little room."""


def in_short(changes: Changes) -> str:
    """Return changes in a few words, "cell 2 m, E 10 MPa"."""
    parts = (change.partition("=") for change in changes if not change.startswith("layer."))  # as told of the soil
    return ", ".join(WORDS[key].format(value) for key, _, value in parts) or OWN


def finer(scene: Scene) -> Changes:
    """Return half the cell."""
    return (with_cell(scene, 0.5),)


def settings(scene: Scene) -> list[Changes]:
    """Return what to try, one thing at a time and with what that needs, and the cheap model of an accuracy."""
    softer = with_stiffness(scene, 1 / SOFTER)
    single = (
        [f"{key}={value}", *needed(scene, key, value)]
        for key, values in CHOICES.items()
        for value in values
        if value != _own(scene, key)
    )
    return [softer, (with_cell(scene, 2.0),), (with_cell(scene, 2.0), *softer), *map(tuple, single)]


def needed(scene: Scene, key: str, value: str | int | float) -> list[str]:
    """Return what a basis or a stress update needs beside it: a stable Courant number, and no averages of wide domains.

    Those that are unstable at any Courant number need what is not there.
    """
    own = scene.numerics.model_dump() | {key.partition(".")[2]: value}
    if key not in ("numerics.basis", "numerics.stress_update"):
        return []
    largest = largest_courant(own["basis"], own["stress_update"])
    step = [f"numerics.courant={largest:g}"] if 0.0 < largest < scene.numerics.courant else []
    averaged = own["basis"] == "bspline" and scene.numerics.locking == "cell-average"
    return step + ["numerics.locking=none"] * averaged


def _own(scene: Scene, key: str) -> str | int | float:
    value: str | int | float = getattr(scene.numerics, key.partition(".")[2])
    return value
