"""The inputs of a scene that are changed one at a time, to see what the answer owes to each."""

from typing import NamedTuple

from campaign.fields.properties import PROPERTIES, value_of
from campaign.scene.comparison import kind_of
from campaign.scene.loading import kept_scene
from campaign.scene.scene import Scene
from campaign.scene.units import shown_in_unit

MORE = 0.1
"""Share by which an input is raised: 10 %, as small as a difference that a few pairs can tell."""

SOFTENING = "soil.softening."

INTERNAL_LENGTH = f"{SOFTENING}internal_length"


class Input(NamedTuple):
    """A positive number of a scene.

    Attributes
    ----------
    key : str
        Dotted.
    name : str
        For people.
    cov_key : str
        Key of the coefficient of variation that the scene gives it, "" without one.
    """

    key: str
    name: str
    cov_key: str = ""


INPUTS = (
    Input("soil.softening.rate", "softening rate"),
    Input("soil.softening.slip_to_residual", "slip to residual strength"),
    Input("soil.softening.reference_cell", "reference cell of softening"),
    Input(INTERNAL_LENGTH, "internal length of softening"),
    *(Input(row.mean_key, f"mean {row.long_name}", row.cov_key) for row in PROPERTIES),
    Input("soil.unit_weight", "unit weight"),
    Input("soil.young_modulus", "Young's modulus"),
)
"""Those of which a realization stays the same ground but for them: no lengths of the field, nothing of the mesh."""

BY_KEY = {row.key: row for row in INPUTS}


def inputs_of(scene: Scene) -> tuple[Input, ...]:
    """Return the inputs that a scene has and that count in it.

    Where the slip to residual strength is given, the internal length moves the rate and not what a slip weakens.
    """
    softening = scene.soil.softening
    unused = SOFTENING if softening.law == "none" else INTERNAL_LENGTH if softening.slip_to_residual else "-"
    return tuple(row for row in INPUTS if value_of(scene, row.key) and not row.key.startswith(unused))


def with_more(scene: Scene, changed: Input) -> Scene:
    """Return the scene with 10 % more of one input; random properties are raised everywhere alike.

    Raises
    ------
    RefusalError
        If that is no valid scene, for instance with a residual strength above the peak.
    """
    kind, value = kind_of(changed.key), raised(scene, changed)
    text = repr(value) if kind is None else f"{value!r} {kind.si_unit}"
    other = kept_scene(scene.text, [*scene.overrides, f"{changed.key}={text}"])
    return other.model_copy(update={"campaign": scene.campaign, "name": scene.name})


def raised(scene: Scene, changed: Input) -> float:
    """Return the raised value of an input in SI."""
    return (1 + MORE) * (value_of(scene, changed.key) or 0.0)


def shown(value: float, changed: Input) -> str:
    """Write a value of an input, given in SI, for people."""
    kind = kind_of(changed.key)
    return f"{value:.3g}" if kind is None else shown_in_unit(value, kind)
