"""The choices that an answer rests on, in words."""

from math import degrees

from campaign.fields.properties import BY_NAME, PRESSURE
from campaign.scene import Scene
from campaign.scene.boring_data import boring_words
from campaign.scene.ground_water import water_words
from campaign.scene.layer_table import LASTING, NONE, LayerRow, layer_rows, told_by_layer, trend_words
from campaign.scene.sections import Numerics, RandomField
from campaign.scene.softening import known_rate, softening_rate, softening_words
from campaign.terminal import listing

LOCKING = {
    "none": "none: ground that yields without a change of volume is too strong by 10 to 35 %",
    "cell-average": "volume changes and pressures are averaged over each cell",
}
"""What is done against ground that yields too stiffly."""

METHODS = {
    "gimp": "generalized interpolation",
    "linear": "linear interpolation",
    "bspline": "quadratic splines",
    "musl": "stresses last, from momentum updated twice",
    "usl": "stresses last",
    "usf": "stresses first",
}
"""What names of bases and stress updates stand for."""


def modelling_choices(scene: Scene) -> dict[str, str]:
    """Return the choices that the answer rests on and that no interval contains, by name."""
    layers = {f"Layer: {row.name}": _layer(row) for row in layer_rows(scene)}
    of_some = {"Strength": trend_words(scene), "Water": water_words(scene), "Borings": boring_words(scene)}
    return (
        layers
        | {name: words for name, words in of_some.items() if words}
        | {
            "Soil law": told_by_layer(scene, _law),
            "How it begins": _beginning(scene.numerics),
            "Softening": told_by_layer(scene, _softening),
            "Against too stiff yielding": LOCKING[scene.numerics.locking],
            "Method": _method(scene.numerics),
            "Correlation": _correlation(scene),
            "Cross-correlation": _cross_correlation(scene.field),
        }
    )


def _law(scene: Scene) -> str:
    cutoff = scene.soil.tension_cutoff
    return scene.soil.law if cutoff is None else f"{scene.soil.law}, tension up to {PRESSURE.show(cutoff)}"


def _layer(row: LayerRow) -> str:
    undrained = f"undrained strength {row.cohesion}"
    drained = f"cohesion {row.cohesion}, friction angle {row.friction_angle}"
    peak = undrained if row.friction_angle == NONE else drained
    residual = row.residual if row.residual == LASTING else f"residual {row.residual}"
    return f"{row.thickness} thick, {row.unit_weight}; {peak}; {residual}"


def _beginning(numerics: Numerics) -> str:
    if numerics.gravity == "ramp":
        return f'gravity grows over {numerics.ramp_time:g} s while the ground yields (gravity = "ramp")'
    return 'the ground rests under gravity, and its strength is limited from time 0 on (gravity = "release")'


def _method(numerics: Numerics) -> str:
    basis, update = numerics.basis, numerics.stress_update
    return (
        f"material points, {numerics.particles_per_cell} in each cell of {numerics.cell:g} m; "
        f"{METHODS[basis]} ({basis}), {METHODS[update]} ({update}); "
        f"{100 * numerics.flip:g} % of the velocity is kept by the points (FLIP)"
    )


def _correlation(scene: Scene) -> str:
    field, own = scene.field, [layer.name for layer in scene.layer if layer.field == "own"]
    kind = field.length_kind.replace("-", " ")
    words = f"{field.correlation}, {kind} {field.horizontal:g} m along and {field.vertical:g} m across the bedding"
    if field.angle:
        words += f", {_dip(field.angle)}"
    return f"{words}; a field of its own in {listing(own)}" if own else words


def _dip(angle: float) -> str:
    """Say how beds lie; slopes fall to the right."""
    return f"which {'dips into' if angle > 0.0 else 'falls with'} the slope at {abs(degrees(angle)):.3g} degrees"


def _cross_correlation(field: RandomField) -> str:
    pairs = [
        f"{rho:g} between {BY_NAME[one].long_name} and {BY_NAME[other].long_name}"
        for (one, other), rho in field.cross_correlations().items()
    ]
    of = {"gaussian": "their normal fields, before these become lognormal", "lognormal": "the lognormal fields"}
    return f"{', '.join(pairs)} (of {of[field.cross_correlation_of]})" if pairs else "none"


def _softening(scene: Scene) -> str:
    softening, rate, known = scene.soil.softening, softening_rate(scene), known_rate(scene.soil.softening)
    if softening.law == "none" or known is None:
        return "none"
    words = f"{softening.law} with plastic strain: {softening_words(softening)}"
    if softening.internal_length is None or rate <= known:
        return words
    return (
        f"{words}; slip surfaces are thicker in cells of {scene.numerics.cell:g} m, where a rate of {rate:.3g} weakens "
        "them after the same slip"
    )
