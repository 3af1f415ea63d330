"""The inputs of a scene that are changed one at a time, to see what the answer owes to each."""

from typing import NamedTuple

from campaign.errors import RefusalError, SceneError
from campaign.fields.properties import PROPERTIES, RESIDUALS, value_of
from campaign.scene.comparison import kind_of
from campaign.scene.layer_soil import gives
from campaign.scene.layers import layer_names, layer_scenes
from campaign.scene.loading import load_scene
from campaign.scene.scene import Scene
from campaign.scene.units import shown_in_unit

MORE = 0.1
"""Share by which an input is raised: 10 %, as small as a difference that a few pairs can tell."""

SOFTENING = "soil.softening."

INTERNAL_LENGTH = f"{SOFTENING}internal_length"

OF_RESIDUALS = tuple(row.mean_key for row in RESIDUALS)
"""What the keys begin with that nothing reads where nothing softens."""


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
    layer : int
        Number of the layer whose own it is, 0 for [soil] and for what all have in common. Keys count layers as `--set`
        does: "layer.1" is the first below [soil].
    follower : str
        Name of a key beside it that is raised alike where there is one.
    """

    key: str
    name: str
    cov_key: str = ""
    layer: int = 0
    follower: str = ""

    @property
    def soil_key(self) -> str:
        """Its key where the soil of the layer is that of the whole scene."""
        return _of_soil(self.key)

    def value(self, scene: Scene) -> float | None:
        """Return its value in a scene, in SI; None if the scene does not have it."""
        return value_of(layer_scenes(scene)[self.layer], self.soil_key)

    def cov(self, scene: Scene) -> float | None:
        """Return its coefficient of variation in a scene; None if it is the same everywhere."""
        return value_of(layer_scenes(scene)[self.layer], _of_soil(self.cov_key)) if self.cov_key else None


def _of_soil(key: str) -> str:
    return f"soil.{key.split('.', 2)[2]}" if key.startswith("layer.") else key


INPUTS = (
    Input("soil.softening.rate", "softening rate"),
    Input("soil.softening.slip_to_residual", "slip to residual strength"),
    Input("soil.softening.reference_cell", "reference cell of softening"),
    Input(INTERNAL_LENGTH, "internal length of softening"),
    *(Input(row.mean_key, f"mean {row.long_name}", row.cov_key) for row in PROPERTIES),
    *(Input(row.share_key, f"{row.long_name} over the peak") for row in RESIDUALS),
    *(Input(row.gradient_key, f"growth of the {row.long_name} with depth") for row in PROPERTIES),
    Input("soil.unit_weight", "unit weight", follower="saturated_unit_weight"),
    Input("soil.k0", "K0"),
    Input("soil.tension_cutoff", "cut-off of tension"),
    Input("water.r_u", "pore pressure ratio r_u"),
    Input("soil.young_modulus", "Young's modulus"),
)
"""Those of which a realization stays the same ground but for them: no lengths of the field, nothing of the mesh."""

BY_KEY = {row.key: row for row in INPUTS}


def inputs_of(scene: Scene) -> tuple[Input, ...]:
    """Return the inputs that a scene has and that count in it: those of [soil], and what layers have of their own.

    With more of an input of [soil] layers that leave it out have more of it, too. Where the slip to residual strength
    is given, the internal length moves the rate and not what a slip weakens.
    """
    scenes, names = layer_scenes(scene), layer_names(scene)
    found = []
    for row in INPUTS:
        taking = [each for each in range(len(names)) if not each or not gives(scene.layer[each - 1], row.key)]
        if counting := [names[each] for each in taking if _counts(scenes[each], row)]:
            found.append(row if len(counting) == len(names) else _named(row, counting))
    for number, layer in enumerate(scene.layer, start=1):
        own = (row for row in INPUTS if gives(layer, row.key) and _counts(scenes[number], row))
        found += [_of_layer(_named(row, [layer.name]), number) for row in own]
    return tuple(found)


def _named(row: Input, layers: list[str]) -> Input:
    return row._replace(name=f"{row.name} ({', '.join(layers)})")


def _of_layer(row: Input, number: int) -> Input:
    key, cov_key = (each and f"layer.{number}.{each.partition('.')[2]}" for each in (row.key, row.cov_key))
    return row._replace(key=key, cov_key=cov_key, layer=number)


def _counts(scene: Scene, row: Input) -> bool:
    softening = scene.soil.softening
    if softening.law == "none" and row.key.startswith((SOFTENING, *OF_RESIDUALS)):
        return False
    return bool(value_of(scene, row.key)) and not (softening.slip_to_residual and row.key == INTERNAL_LENGTH)


def by_key(scene: Scene) -> dict[str, Input]:
    """Return the inputs that a scene may have, by key."""
    return BY_KEY | {row.key: row for row in inputs_of(scene)}


def with_more(scene: Scene, changed: Input) -> Scene:
    """Return the scene with 10 % more of one input; random properties are raised everywhere alike.

    Raises
    ------
    RefusalError
        If that is no valid scene, for instance with a residual strength above the peak.
    """
    beside = changed._replace(key=f"{changed.key.rpartition('.')[0]}.{changed.follower}")
    rows = [changed, beside] if changed.follower and beside.value(scene) else [changed]
    try:
        other = load_scene(scene, [f"{row.key}={_raised_text(scene, row)}" for row in rows])
    except SceneError as error:
        raise RefusalError(str(error)) from error
    return other.model_copy(update={"campaign": scene.campaign})


def _raised_text(scene: Scene, row: Input) -> str:
    kind, value = kind_of(row.soil_key), raised(scene, row)
    return repr(value) if kind is None else f"{value!r} {kind.si_unit}"


def raised(scene: Scene, changed: Input) -> float:
    """Return the raised value of an input in SI."""
    return (1 + MORE) * (changed.value(scene) or 0.0)


def shown(value: float, changed: Input) -> str:
    """Write a value of an input, given in SI, for people."""
    kind = kind_of(changed.soil_key)
    return f"{value:.3g}" if kind is None else shown_in_unit(value, kind)
