"""The modelling choices of a scene, each with a simpler or another one to take its place.

A choice is there only where the scene has made it: ground that is isotropic already has no isotropy to be tried.
"""

import json
from collections.abc import Iterable, Iterator
from math import isclose, pi, sqrt
from typing import NamedTuple

import numpy as np

from campaign.fields.properties import BY_NAME, RESIDUALS, marginals, value_of
from campaign.running.study import Changes
from campaign.scene import Scene
from campaign.scene.boring_data import measured_in
from campaign.scene.ground_surface import surface_of
from campaign.scene.ground_water import water_of
from campaign.scene.layers import layer_scenes
from campaign.scene.more_ground import elevations, lines_across
from campaign.scene.units import PRESSURE, shown_in_unit
from campaign.scene.variant import in_all_layers, with_cell, with_stiffness
from campaign.simulation.scene_sampler import CELLS_PER_DISTANCE, correlation_of
from campaign.statistics.release import OTHER
from campaign.terminal import listing
from solver.water import NO_WATER

SOFTER = 4.0
"""By which Young's modulus is divided: steps become twice as long."""

MORE_THAN_ANY_TENSION = "1 GPa"
"""A cut-off beyond c cot(phi), which is none."""

PEAKS = ("friction_angle", "cohesion")


class Choice(NamedTuple):
    """A modelling choice to be tried.

    Attributes
    ----------
    name
        What the scene models.
    instead
        What would take its place; "" for several at once.
    changes
        What that changes in the scene.
    redraws
        Whether realizations have other random fields then, because the box or the correlation of the ground changes:
        pairs share no more than the seed, and intervals are as wide as those of independent samples.
    simplifies
        Whether less is modelled then. What is merely different is judged, and stays as it is.
    why_not
        Why it cannot be tried, "" if it can.
    """

    name: str
    instead: str
    changes: Changes
    redraws: bool = False
    simplifies: bool = True
    why_not: str = ""

    @property
    def exchange(self) -> str:
        """What is modelled, and what would take its place."""
        return f"{self.name} -> {self.instead}" if self.instead else self.name


def choices_of(scene: Scene) -> list[Choice]:
    """Return the choices that a scene has made, the soil before the ground and the ground before the numbers."""
    return [*_soil(scene), *_field(scene), *_ground(scene), *_numerics(scene)]


def _soil(scene: Scene) -> Iterator[Choice]:
    layers = layer_scenes(scene)
    measured = {datum.name for datum in measured_in(scene)}
    why_not = "left out: borings have values of it" if scene.boring else ""
    if scene.layer:
        of_layers = "left out: borings have values in them" if scene.boring else ""
        yield Choice("layers", "the soil of the surface", ("layer=[]",), why_not=of_layers)
    if scene.boring:
        yield Choice("borings", "none", ("boring=[]",), redraws=True)
    if water_of(scene) != NO_WATER:
        yield Choice("water", "none", ("water={}",))
    for row in (BY_NAME[name] for name in PEAKS):
        if any(value_of(layer, row.cov_key) for layer in layers):
            changes = _everywhere(scene, row.cov_key, "0")
            yield Choice(
                f"random {row.long_name}", "its mean", changes, why_not=why_not if row.name in measured else ""
            )
    drawn = [row.name for row in RESIDUALS if any(row.name in marginals(layer) for layer in layers)]
    if drawn:
        fixed = [change for name in drawn for change in _everywhere(scene, BY_NAME[name].cov_key, "0")]
        changes = (*fixed, *_pairs_without(scene, drawn))
        reason = why_not if measured & {*drawn} else ""
        yield Choice("random residual strength", "its mean", changes, why_not=reason)
    if any(soil.softening.law != "none" for soil in scene.soils):
        reason = why_not if measured & {row.name for row in RESIDUALS} else ""
        yield Choice("softening", "none", _everywhere(scene, "soil.softening.law", "none"), why_not=reason)
    if any(soil.dilation_angle > 0.0 for soil in scene.soils):
        yield Choice("dilation", "none", _everywhere(scene, "soil.dilation_angle", "0 deg"))
    if any(soil.tension_cutoff is not None for soil in scene.soils):
        yield Choice("cut-off of tension", "none", _everywhere(scene, "soil.tension_cutoff", MORE_THAN_ANY_TENSION))
    modulus = scene.soil.young_modulus
    instead = shown_in_unit(modulus / SOFTER, PRESSURE)
    yield Choice(f"modulus {shown_in_unit(modulus, PRESSURE)}", instead, with_stiffness(scene, 1 / SOFTER))


def _everywhere(scene: Scene, key: str, value: str) -> tuple[str, ...]:
    """Return the changes of a key to a value in [soil], if it has such a section, and in layers with their own."""
    changes = in_all_layers(scene, key, lambda _soil: value)
    has_section = getattr(scene.soil, key.split(".")[1]) is not None
    return changes if has_section else changes[1:]


def _pairs_without(scene: Scene, names: Iterable[str]) -> list[str]:
    """Return the changes that leave no cross-correlation of some properties with others, but for the first pair."""
    pairs = [(one, other) for one, partners in scene.field.pairs for other, rho in partners if rho]
    return [f"field.pairs.{one}.{other}=0" for one, other in pairs if {one, other} & {*names}]


def _field(scene: Scene) -> Iterator[Choice]:
    field = scene.field
    if field.cross_correlations():
        changes = ("field.cross_correlation=0", *_pairs_without(scene, BY_NAME))
        yield Choice("cross-correlation", "none", changes)
    if not isclose(field.horizontal, field.vertical):
        length = sqrt(field.horizontal * field.vertical)
        changes = tuple(_isotropic(scene, _metres(length)))
        yield Choice("two correlation lengths", f"one, {length:.3g} m", changes, redraws=True)
    if field.angle % pi:
        yield Choice("rotated correlation", "not rotated", ("field.angle=0 deg",), redraws=True)


def _isotropic(scene: Scene, length: str) -> Iterator[str]:
    """Yield one length for both, on a grid as fine as that of the scene."""
    yield from (f"field.horizontal={length}", f"field.vertical={length}")
    if scene.field.resolution is None:
        distances = correlation_of(scene.field)
        yield f"field.resolution={_metres(min(distances.horizontal, distances.vertical) / CELLS_PER_DISTANCE)}"


def _ground(scene: Scene) -> Iterator[Choice]:
    slope = scene.geometry.slope
    if slope is None:
        yield from _profile(scene)
        return
    # Receptors and lines are given by their x, which a shorter crest would move with the toe.
    why_not = "left out: it would move the receptors" if scene.receptor else _why_kept(lines_across(scene))
    bored = "left out: borings may lie in it" if scene.boring else ""
    lowered = bored or _why_kept(elevations(scene))
    for part, reason in (("foundation", lowered), ("crest", why_not or bored), ("plain", bored)):
        length = getattr(slope, part)
        half = _metres(length / 2)
        changes = (f"geometry.slope.{part}={half}",)
        yield Choice(f"{part} of {_metres(length)}", half, changes, redraws=True, why_not=reason)


def _profile(scene: Scene) -> Iterator[Choice]:
    """Yield the same of a ground that is given by points, but for its crest, from which all x are measured."""
    surface, bored = surface_of(scene.geometry), "left out: borings may lie in it" if scene.boring else ""
    toe_x, depth = surface.toe_x, float(surface.y.min())
    if depth:
        why_not = bored or _why_kept(elevations(scene))
        lower = (_points(surface.x, surface.y - depth / 2),)
        yield Choice(f"foundation of {_metres(depth)}", _metres(depth / 2), lower, redraws=True, why_not=why_not)
    half = (surface.width - toe_x) / 2
    inside = surface.x < toe_x + half
    x = np.append(surface.x[inside], toe_x + half)
    y = np.append(surface.y[inside], surface.height_at(x[-1:]))
    shorter = (_points(x, y), f"geometry.toe={_metres(toe_x)}")
    yield Choice(f"plain of {_metres(2 * half)}", _metres(half), shorter, redraws=True, why_not=bored)


def _why_kept(drawn: list[str]) -> str:
    """Say why ground is left as it is, from whose base or left wall other things are measured; "" without any."""
    return f"left out: it would move the ground past {listing(drawn)}" if drawn else ""


def _points(x: Iterable[float], y: Iterable[float]) -> str:
    return f"geometry.surface={json.dumps([[_metres(one) for one in point] for point in zip(x, y, strict=True)])}"


def _numerics(scene: Scene) -> Iterator[Choice]:
    gravity, cell = scene.numerics.gravity, scene.numerics.cell
    other = OTHER[gravity]
    yield Choice(f'gravity "{gravity}"', f'"{other}"', (f"numerics.gravity={other}",), simplifies=other == "release")
    yield Choice(f"cells of {_metres(cell)}", _metres(2 * cell), (with_cell(scene, 2.0),))


def _metres(length: float) -> str:
    return f"{length:.6g} m"
