"""The random properties of the soil, a row each: everything that draws, reads, checks or shows them follows from it.

A new one is a row here and its keys in `campaign.scene.sections`, as soon as `solver.particles.Particles` has an array
for it. Scenes are checked by this table, so it needs NumPy alone.
"""

from collections.abc import Mapping
from math import degrees, inf, radians
from typing import Any, NamedTuple

import numpy as np

from campaign.fields.correlation import Array
from campaign.fields.marginals import Lognormal
from campaign.fields.trend import Trend
from solver.surface import Surface


class Unit(NamedTuple):
    """The SI unit of a property, and the one in which people read it."""

    si: str
    shown: str
    shown_per_si: float

    def show(self, value: float) -> str:
        """Write a value given in SI."""
        return f"{value * self.shown_per_si:g} {self.shown}"


PRESSURE = Unit("Pa", "kPa", 1e-3)
ANGLE = Unit("rad", "deg", degrees(1.0))


def value_of(scene: Any, key: str) -> float | None:
    """Return the value of a dotted key of a scene, in SI; None if it, or a section of it, is left out."""
    found: Any = scene
    for name in key.split("."):
        found = None if found is None else getattr(found, name)
    return None if found is None else float(found)


class SoilProperty(NamedTuple):
    """A property of the soil that a scene can make random.

    Parameters
    ----------
    name : str
        Of its field.
    mean_key, cov_key : str
        Keys of the scene that hold mean and coefficient of variation. Without the latter, or with 0, it is not random.
    gradient_key : str
        Key of the scene that holds by how much the mean grows per metre of depth.
    particle_array : str
        The array of `solver.particles.Particles` that its values at the particles become.
    long_name, symbol : str
        For people; the symbol is the paper's.
    unit : Unit
    limit : float
        Value in SI below which it must stay everywhere.
    floor_key : str
        Mean key of the property below which it is at no particle, "" without one.
    peak : str
        Name of the property to which it is the residual, "" for a peak.
    share_key : str
        Key of the scene that makes it a share of the peak at each place, "" for a peak.
    marginal : type
        Its distribution, made of mean and coefficient of variation.
    """

    name: str
    mean_key: str
    cov_key: str
    gradient_key: str
    particle_array: str
    long_name: str
    symbol: str
    unit: Unit
    limit: float = inf
    floor_key: str = ""
    peak: str = ""
    share_key: str = ""
    marginal: type[Lognormal] = Lognormal

    def share_of_peak(self, scene: Any) -> float | None:
        """Return which share of the local peak it is, 1 where nothing softens; None if it has values of its own."""
        if not self.peak:
            return None
        return value_of(scene, self.share_key) if self.is_read(scene) else 1.0

    def is_read(self, scene: Any) -> bool:
        """Whether anything depends on its keys; nothing does on those of a residual where nothing softens."""
        return not self.peak or scene.soil.softening.law != "none"

    def mean(self, scene: Any) -> float:
        """Return its mean in a scene at the top of the soil, in SI; 0 if the scene leaves the property out."""
        share = self.share_of_peak(scene)
        if share is not None:
            return share * BY_NAME[self.peak].mean(scene)
        return value_of(scene, self.mean_key) or 0.0

    def gradient(self, scene: Any) -> float:
        """Return by how much its mean grows below the top of the soil, in SI per m."""
        share = self.share_of_peak(scene)
        if share is not None:
            return share * BY_NAME[self.peak].gradient(scene)
        return value_of(scene, self.gradient_key) or 0.0

    def reference(self, scene: Any) -> float:
        """Return the mean in SI of the field that `trend` multiplies: that at the top, or 1 m below it if that is 0."""
        return self.mean(scene) or self.gradient(scene)

    def trend(self, scene: Any, top: Surface) -> Trend | None:
        """Return how the mean grows below the top of the soil, over `reference`; None if it does not by itself."""
        if self.share_of_peak(scene) is not None:
            return None
        gradient, reference = self.gradient(scene), self.reference(scene)
        return Trend(self.mean(scene) / reference, gradient / reference, top) if gradient else None

    def distribution(self, scene: Any) -> Lognormal | None:
        """Return its distribution in a scene without its trend, in SI, also without variation; None if it has none."""
        cov = value_of(scene, self.cov_key) if self.share_of_peak(scene) is None else None
        return None if cov is None else self.marginal(self.reference(scene), cov)

    @property
    def identifier(self) -> str:
        """Its long name as a name of an array in a file."""
        return self.long_name.replace(" ", "_")


PROPERTIES = (
    SoilProperty(
        name="cohesion",
        mean_key="soil.cohesion.mean",
        cov_key="soil.cohesion.cov",
        gradient_key="soil.cohesion.gradient",
        particle_array="cohesion",
        long_name="peak cohesion",
        symbol="c",
        unit=PRESSURE,
        floor_key="soil.cohesion.residual",
    ),
    SoilProperty(
        name="friction_angle",
        mean_key="soil.friction_angle.mean",
        cov_key="soil.friction_angle.cov",
        gradient_key="soil.friction_angle.gradient",
        particle_array="friction_angle",
        long_name="peak friction angle",
        symbol="phi",
        unit=ANGLE,
        limit=radians(90.0),
        floor_key="soil.friction_angle.residual",
    ),
    SoilProperty(
        name="cohesion_residual",
        mean_key="soil.cohesion.residual",
        cov_key="soil.cohesion.residual_cov",
        gradient_key="soil.cohesion.residual_gradient",
        particle_array="cohesion_residual",
        long_name="residual cohesion",
        symbol="c_r",
        unit=PRESSURE,
        peak="cohesion",
        share_key="soil.cohesion.residual_share",
    ),
    SoilProperty(
        name="friction_angle_residual",
        mean_key="soil.friction_angle.residual",
        cov_key="soil.friction_angle.residual_cov",
        gradient_key="soil.friction_angle.residual_gradient",
        particle_array="friction_angle_residual",
        long_name="residual friction angle",
        symbol="phi_r",
        unit=ANGLE,
        limit=radians(90.0),
        peak="friction_angle",
        share_key="soil.friction_angle.residual_share",
    ),
)
"""All of them. The place in this order decides which Gaussian field a property gets: a new row goes to the end."""

BY_NAME = {row.name: row for row in PROPERTIES}

RESIDUALS = tuple(row for row in PROPERTIES if row.peak)
"""What peaks soften to."""


def raised_to_floor(soil: Mapping[str, Array]) -> dict[str, Array]:
    """Return the properties of some places with none below its floor.

    Parameters
    ----------
    soil : mapping
        Values in SI of all properties by name, arrays of one shape; not modified.
    """
    by_key = {row.mean_key: soil[row.name] for row in PROPERTIES}
    return {
        row.name: np.maximum(soil[row.name], by_key[row.floor_key]) if row.floor_key else soil[row.name]
        for row in PROPERTIES
    }


def distributions(scene: Any) -> dict[str, Lognormal]:
    """Return the distribution of each property of a scene that has one by name, in the order of the table."""
    return {row.name: law for row in PROPERTIES if (law := row.distribution(scene)) is not None}


def marginals(scene: Any) -> dict[str, Lognormal]:
    """Return the distribution of each random property of a scene by name, in the order of the table."""
    return {name: law for name, law in distributions(scene).items() if law.cov}
