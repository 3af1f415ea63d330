"""The first look at a scene as text."""

from campaign.scene import Scene
from campaign.scene.boring_data import boring_words
from campaign.scene.cost import (
    core_seconds,
    dataset_bytes,
    pairs,
    particle_count,
    rank_bytes,
    realization_seconds,
    speed,
    step_count,
    time_step,
    with_more_of_an_input,
)
from campaign.scene.first_look import LONGEST_SLIDE, SHORTEST_SLIDE, TYPICAL_SLIDE, FirstLook
from campaign.scene.ground_water import water_words
from campaign.scene.layer_table import HEADINGS, layer_rows, told_by_layer, trend_words
from campaign.scene.limit_equilibrium import SlipCircle
from campaign.scene.outlook import may_slide, outlook
from campaign.scene.sections import Softening
from campaign.scene.softening import RING_SHEAR, is_brittle, is_progressive, softening_words
from campaign.simulation.field_size import FieldSize
from campaign.terminal import aligned, as_sentence, data_size, duration, paragraph

MARGIN = 20
"""Characters before the text, which hold its heading."""


def first_look_text(scene: Scene, look: FirstLook, size: FieldSize) -> str:
    """Return what is known of a scene before it is run, a paragraph for each matter."""
    layers = {"layers": _layers(scene)} if scene.layer else {}
    paragraphs = {
        "ground": _ground(look),
        **layers,
        "toe": _toe(scene, look),
        "strength": trend_words(scene),
        "water": water_words(scene),
        "borings": boring_words(scene),
        "factor of safety": _factors(look),
        "softening": _softenings(scene),
        "what to expect": outlook(look, is_brittle(scene, look.height), is_progressive(scene, look.height)),
        "time": _time(scene, look),
        "mesh": _mesh(scene),
        "random field": _field(size),
        "cost": _cost(scene),
        "memory": f"About {data_size(rank_bytes(scene) + size.least)} for each rank (process); the results take "
        f"{data_size(dataset_bytes(scene))}.",
    }
    lines = [
        paragraph(heading, text, MARGIN) if heading != "layers" else text
        for heading, text in paragraphs.items()
        if text
    ]
    return "\n".join([f"{scene.title}: a valid scene.", *lines])


def _ground(look: FirstLook) -> str:
    surface = look.surface
    return (
        f"{surface.width:.4g} m wide, {surface.top:.4g} m high above the base, {surface.area:,.4g} m2; the slope rises "
        f"{look.height:.4g} m above its toe."
    )


def _toe(scene: Scene, look: FirstLook) -> str:
    x, y = look.surface.toe
    if scene.geometry.toe is not None:
        how = "as given"
    elif scene.geometry.slope is not None:
        how = "the foot of the slope"
    else:
        how = "the foot of the slope, of all its faces; geometry.toe can say otherwise"
    return f"At x = {x:.4g} m, elevation {y:.4g} m: {how}."


def _factors(look: FirstLook) -> str:
    mean = f"{_factor(look.peak)} with the mean peak strength{_circle(look, look.peak)}"
    if look.residual is None:
        return f"{mean} (Bishop)."
    same = look.peak is not None and abs(look.peak.entry - look.residual.entry) < 0.02 * look.height
    where = ", nearly the same circle" if same else _circle(look, look.residual)
    return f"{mean}; {_factor(look.residual)} with the residual strength{where} (Bishop)."


def _factor(circle: SlipCircle | None) -> str:
    return "None" if circle is None else f"{circle.factor:.2f}" if circle.factor < 100 else f"{circle.factor:.3g}"


def _circle(look: FirstLook, circle: SlipCircle | None) -> str:
    if circle is None:
        return ""
    depth = circle.depth(look.surface)
    return f" on a circle from x = {circle.entry:.3g} m to {circle.exit:.3g} m, at most {depth:.2g} m deep"


def _layers(scene: Scene) -> str:
    """Return the table of the layers, from the surface down."""
    lines = aligned([HEADINGS._replace(name=""), *layer_rows(scene)])
    headings = ["  layers", *[""] * (len(lines) - 1)]
    return "\n".join(f"{heading.ljust(MARGIN)}{line}" for heading, line in zip(headings, lines, strict=True))


def _softenings(scene: Scene) -> str:
    """Say how strength falls, for layers by themselves where they differ."""
    return as_sentence(told_by_layer(scene, lambda layer: _softening(layer.soil.softening)))


def _softening(softening: Softening) -> str:
    if softening.law == "none":
        return "none: strength stays at its peak"
    words = softening_words(softening)
    return f"{softening.law}: {words}; {RING_SHEAR}"


def _time(scene: Scene, look: FirstLook) -> str:
    first, middle, last = (each * look.time_scale for each in (SHORTEST_SLIDE, TYPICAL_SLIDE, LONGEST_SLIDE))
    numerics = scene.numerics
    ramp = f" Gravity rises for {numerics.ramp_time:g} s before." if numerics.gravity == "ramp" else ""
    rest = f"come to rest after {first:.2g} to {last:.2g} s, half of them before {middle:.2g} s"
    end = f"The run ends at {numerics.end_time:g} s."
    if not may_slide(look):
        return f"{end}{ramp} Should the slope slide all the same: comparable slides {rest}."
    return f"Comparable slides {rest}.{ramp} {end}"


def _mesh(scene: Scene) -> str:
    particles, steps = particle_count(scene), step_count(scene)
    return (
        f"About {particles:,} particles in cells of {scene.numerics.cell:g} m, and {steps:,} steps of at most "
        f"{1e3 * time_step(scene):.2g} ms."
    )


def _field(size: FieldSize) -> str:
    rows, columns = size.shape
    memory = data_size(size.least)
    return f"{columns:,} x {rows:,} points, {size.resolution:g} m apart; drawing one takes {memory} or more."


def _cost(scene: Scene) -> str:
    if scene.campaign.accuracy is not None:
        return _cost_of_accuracy(scene)
    hours, seconds = core_seconds(scene) / 3600.0, realization_seconds(scene)
    return (
        f"About {duration(seconds) if seconds >= 9.5 else f'{seconds:.1g} s'} for a realization that moves until the "
        f"end, less for others; at most {f'{hours:.2g}' if hours < 99.5 else f'{hours:,.0f}'} core-hours for all "
        f"{scene.campaign.realizations:,}, "
        f"with {pairs(scene):,} repeated at half the cell and {with_more_of_an_input(scene):,} with one input changed, "
        f"at {speed(scene) / 1e6:.2g} million particle-steps a second."
    )


def _cost_of_accuracy(scene: Scene) -> str:
    """Say what the first runs cost; the others depend on these."""
    from campaign.accuracy.settings import models_of  # which take SciPy, as nothing else here does
    from campaign.accuracy.wording import plan

    return plan(models_of(scene), scene)
