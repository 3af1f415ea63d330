"""What borings and soundings tell of the strength of the ground: values at places, each in the layer where it lies."""

from collections.abc import Iterator
from math import log
from typing import NamedTuple

import numpy as np

from campaign.fields.marginals import Lognormal
from campaign.fields.properties import BY_NAME
from campaign.scene.ground_surface import surface_of
from campaign.scene.layers import interfaces_of, layer_at, layer_names, layer_scenes, tops_of
from campaign.scene.scene import Scene

LIKELY = 3.5
"""Standard deviations within which data are not remarked on."""


class Measured(NamedTuple):
    """A value of a property that a boring gives.

    Attributes
    ----------
    key : str
        Where it stands, "boring.0.cohesion".
    name : str
        Of the property.
    x, y : float
        Its place in m.
    value : float
        In SI.
    noise : float
        Coefficient of variation of the measurement.
    layer : int
        Number of the layer in which it lies.
    """

    key: str
    name: str
    x: float
    y: float
    value: float
    noise: float
    layer: int


def measured_in(scene: Scene) -> list[Measured]:
    """Return the data of all borings of a scene, without those of residual strength in layers that do not soften."""
    surface, interfaces, found = surface_of(scene.geometry), interfaces_of(scene), []
    layers = layer_scenes(scene)
    for number, boring in enumerate(scene.boring):
        x = np.array([boring.x])
        top = float(surface.height_at(x)[0])
        for name in BY_NAME:
            for place, value in getattr(boring, name):
                y = place if boring.by == "elevation" else top - place
                layer = int(layer_at(interfaces, x, np.array([y]))[0])
                if BY_NAME[name].is_read(layers[layer]):
                    key, noise = f"boring.{number}.{name}", boring.noise or 0.0
                    found.append(Measured(key, name, boring.x, y, value, noise, layer))
    return found


def trend_at(scene: Scene, datum: Measured) -> float:
    """Return by what the mean of a property has grown at the place of a datum."""
    trend = BY_NAME[datum.name].trend(layer_scenes(scene)[datum.layer], tops_of(scene)[datum.layer])
    return 1.0 if trend is None else float(trend(np.array([datum.x]), np.array([datum.y]))[0])


def standard_value(scene: Scene, datum: Measured, law: Lognormal) -> float:
    """Return a datum as a value of the standard Gaussian field behind its property.

    A measurement is the true value times an error, lognormal with a mean of 1.
    """
    error = Lognormal(1.0, datum.noise)
    return (log(datum.value / trend_at(scene, datum)) - error.log_mean - law.log_mean) / law.sigma


def distribution_at(scene: Scene, datum: Measured) -> Lognormal | None:
    """Return the distribution of a property, without trend, where a datum lies; None where it is not random."""
    law = BY_NAME[datum.name].distribution(layer_scenes(scene)[datum.layer])
    return law if law is not None and law.cov else None


def impossible_data(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield key and complaint of data that cannot be."""
    surface, seen = surface_of(scene.geometry), set()
    for number, boring in enumerate(scene.boring):
        if not 0.0 <= boring.x <= surface.width:
            yield f"boring.{number}.x", f"the ground goes from 0 m to {surface.width:g} m; move it, or leave it out"
        elif not any(getattr(boring, name) for name in BY_NAME):
            names = ", ".join(BY_NAME)
            yield f"boring.{number}.x", f"nothing was measured there; give a value of one of {names}, or leave it out"
    for datum in measured_in(scene):
        row, place = BY_NAME[datum.name], (datum.name, datum.x, datum.y)
        if not 0.0 <= datum.x <= surface.width:
            continue
        if complaint := _outside(float(surface.height_at(np.array([datum.x]))[0]), datum.y):
            yield datum.key, complaint
        elif place in seen:
            yield (
                datum.key,
                f"it has two values at x = {datum.x:g} m, elevation {datum.y:g} m; leave out one of the two",
            )
        elif distribution_at(scene, datum) is None:
            where = f" in {layer_names(scene)[datum.layer]}" if scene.layer else ""
            is_share = row.share_of_peak(layer_scenes(scene)[datum.layer]) is not None
            why = "is a share of the peak" if is_share else "is not random"
            instead = "values of the peak in their place" if is_share else row.cov_key
            yield datum.key, f"the {row.long_name} {why}{where}; give {instead}, or leave the data out"
        elif trend_at(scene, datum) <= 0.0:
            yield datum.key, f"the mean is 0 at elevation {datum.y:g} m; give a mean above 0, or leave that value out"
        seen.add(place)


def _outside(top: float, y: float) -> str | None:
    if y > top:
        return f"{y - top:.4g} m above the surface there is no ground; give the depth below it, or an elevation by name"
    if y < 0.0:
        return f"{-y:.4g} m below the fixed base there is no ground; the ground is {top:.4g} m deep there"
    return None


def unlikely_data(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield key and complaint of data that mean and variation make very unlikely, the farthest of each boring."""
    farthest: dict[str, float] = {}
    for datum in measured_in(scene):
        law = distribution_at(scene, datum)
        if law is not None:
            z = standard_value(scene, datum, law)
            farthest[datum.key] = max(farthest.get(datum.key, 0.0), z, -z)
    for key, z in farthest.items():
        if z > LIKELY:
            name = BY_NAME[key.rpartition(".")[2]].long_name
            text = f"a value lies {z:.2g} standard deviations from the mean {name}"
            yield key, f"{text}; check its unit, and mean and coefficient of variation of the soil"


def boring_words(scene: Scene) -> str | None:
    """Say what borings give; None without them."""
    if not scene.boring:
        return None
    data = measured_in(scene)
    counts = {name: sum(datum.name == name for datum in data) for name in BY_NAME}
    told = ", ".join(f"{count} of {BY_NAME[name].long_name}" for name, count in counts.items() if count)
    return (
        f"{len(scene.boring)}, with {told}. Every field honours them, and the run with mean strengths has the means "
        "given them; the factor of safety is without them."
    )
