"""A first look at a slope before anything is run: where its toe is, how stable it is, and how fast it could slide."""

from collections.abc import Sequence
from math import erf, sqrt, tan
from typing import NamedTuple

import numpy as np

from campaign.fields.properties import BY_NAME
from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.ground_water import carried_share, saturated_unit_weight, water_of
from campaign.scene.layers import interfaces_of, layer_at, layer_scenes, tops_of
from campaign.scene.limit_equilibrium import SlipCircle, Strata, critical_circle, factor_on
from campaign.scene.sections import FrictionAngle
from campaign.scene.softening import share_left
from solver.constants import STANDARD_GRAVITY
from solver.surface import Surface

SHORTEST_SLIDE, TYPICAL_SLIDE, LONGEST_SLIDE = 3.0, 4.6, 10.0
"""Times from release to rest over `FirstLook.time_scale`: about 5, 50 and 90 % of 76 deterministic runs. Slopes were 22
to 60 degrees steep and 6 to 30 m high, above plains that fell by 0 to 8 degrees; factors of safety 0.4 to 1
with the mean strength and 0.1 to 0.9 with the residual one, which they reached after 0.01 to 5 heights of slip."""

DEPTH = 0.3
"""Of a slide, in heights of the slope."""

LEAST_FRICTION = 0.05
"""Of a slide that comes to rest at all."""

BELOW_TOE = 1e-3
"""Depth in heights at which the layer at the toe is looked up."""

NO_FRICTION = FrictionAngle.model_construct(mean=0.0, cov=0.0, residual=0.0)
"""Of soil with undrained strength alone."""


class FirstLook(NamedTuple):
    """What can be known of a slope within a tenth of a second.

    Attributes
    ----------
    surface : Surface
    height : float
        Of the slope, from its toe to its crest, in m.
    peak, residual : SlipCircle or None
        The critical circles for the mean peak strength and for the residual one; None where nothing drives a slide or
        nothing resists it, and where the soil does not soften.
    spread : float
        Standard deviation of the factor of safety if each realization had one strength everywhere.
    friction : float
        What brakes a slide on the ground ahead of the toe, over its weight; see `braking_friction`.
    """

    surface: Surface
    height: float
    peak: SlipCircle | None
    residual: SlipCircle | None
    spread: float
    friction: float

    @property
    def time_scale(self) -> float:
        """The time sqrt(H / (g mu)) in s in which friction mu brakes what has fallen by H, over the square root of 2.

        A block that falls by H and is then braked by mu g comes to rest after sqrt(2 H / (g mu)) or longer, since it
        has to stop on a way of H / mu.
        """
        return sqrt(self.height / (STANDARD_GRAVITY * self.friction))

    @property
    def slide_probability(self) -> float:
        """First-order probability of a factor of safety below 1; too near 1/2, since a slip surface averages."""
        if self.peak is None:
            return 0.0
        if not self.spread > 0.0:
            return float(self.peak.factor < 1.0)
        return 0.5 * (1.0 + erf((1.0 - self.peak.factor) / (sqrt(2.0) * self.spread)))


def look_at(scene: Scene) -> FirstLook:
    """Return a first look at the slope of a scene."""
    surface = surface_of(scene.geometry)
    peak, residual = critical_circles(scene)
    spread = 0.0 if peak is None else _spread(scene, surface, peak)
    return FirstLook(surface, surface.height, peak, residual, spread, braking_friction(scene, surface, surface.height))


def critical_circles(scene: Scene, added: float = 0.0) -> tuple[SlipCircle | None, SlipCircle | None]:
    """Return the critical circles of a scene for the mean peak strength and for the residual one.

    Elevations are above the base, which is as many m deeper as are `added` to the lowest layer.
    """
    surface, layers = raised(surface_of(scene.geometry), added), layer_scenes(scene)
    peak, residual = _circle(surface, strata_of(scene, [mean_peak(layer) for layer in layers], added)), None
    if any(_softens(layer) for layer in layers):
        strengths = [_residual(layer) if _softens(layer) else mean_peak(layer) for layer in layers]
        residual = _circle(surface, strata_of(scene, strengths, added))
    return peak, residual


def raised(line: Surface, by: float) -> Surface:
    """Return a line that many m higher."""
    return line._replace(y=line.y + by) if by else line


class Strength(NamedTuple):
    """Cohesion in Pa and friction angle in rad at the top of a layer, and by how much they grow below it, per m."""

    cohesion: float
    friction_angle: float
    cohesion_gradient: float = 0.0
    friction_gradient: float = 0.0

    def at(self, depth: float) -> tuple[float, float]:
        """Return cohesion and friction angle at a depth in m below the top."""
        return self.cohesion + self.cohesion_gradient * depth, self.friction_angle + self.friction_gradient * depth

    def times(self, of_cohesion: float, of_friction: float) -> "Strength":
        """Return so many times the cohesion, and so many times the friction angle."""
        factors = of_cohesion, of_friction, of_cohesion, of_friction
        return Strength(*(factor * value for factor, value in zip(factors, self, strict=True)))


def mean_peak(scene: Scene) -> Strength:
    """Return the mean peak strength of a soil."""
    return _means(scene, "cohesion", "friction_angle")


def _residual(scene: Scene) -> Strength:
    return _means(scene, "cohesion_residual", "friction_angle_residual")


def _means(scene: Scene, *names: str) -> Strength:
    rows = [BY_NAME[name] for name in names]
    return Strength(*(row.mean(scene) for row in rows), *(row.gradient(scene) for row in rows))


def _softens(scene: Scene) -> bool:
    return scene.soil.softening.law != "none"


def strata_of(scene: Scene, strengths: Sequence[Strength], added: float = 0.0) -> Strata:
    """Return the layers of a scene, each with a strength, above so many m of `added` ground."""
    cohesions, friction_angles, of_cohesion, of_friction = zip(*strengths, strict=True)
    moist, saturated = zip(*((soil.unit_weight, saturated_unit_weight(soil)) for soil in scene.soils), strict=True)
    interfaces = tuple(raised(top, added) for top in interfaces_of(scene))
    water, tops = water_of(scene).raised(added), tuple(raised(top, added) for top in tops_of(scene))
    return Strata(cohesions, friction_angles, moist, interfaces, saturated, water, of_cohesion, of_friction, tops)


def braking_friction(scene: Scene, surface: Surface, height: float) -> float:
    """Return what brakes a slide ahead of the toe, over its weight.

    It is ``(1 - r) tan(phi) + c / (gamma d) - tan(beta)``, and 0.05 at least.
    Strength c, phi is what softening has left after a slip of half the height, of the layer at the toe, d below its
    top; r is the share of the weight that the pore pressure carries there, d is 0.3 heights, and beta the inclination
    of the ground over two heights ahead of the toe. Gentle fans of weak soil brake little.
    """
    toe_x, toe_y = surface.toe
    below_toe = np.array([toe_x]), np.array([toe_y - BELOW_TOE * height])
    at_toe = int(layer_at(interfaces_of(scene), *below_toe)[0])
    effective = 1.0 - float(carried_share(scene, *below_toe)[0])
    layer = layer_scenes(scene)[at_toe]
    left = share_left(layer.soil.softening, 0.5 * height, scene.numerics.locking == "none")
    depth = DEPTH * height
    peaks, residuals = mean_peak(layer).at(depth), _residual(layer).at(depth)
    cohesion, angle = (residual + (peak - residual) * left for peak, residual in zip(peaks, residuals, strict=True))
    end = min(toe_x + 2.0 * height, surface.width)
    descent = (toe_y - float(surface.height_at(np.array([end]))[0])) / (end - toe_x)
    return max(LEAST_FRICTION, effective * tan(angle) + cohesion / (layer.soil.unit_weight * depth) - descent)


def _circle(surface: Surface, strata: Strata) -> SlipCircle | None:
    found = critical_circle(surface, strata)
    return found if np.isfinite(found.factor) else None


def _spread(scene: Scene, surface: Surface, circle: SlipCircle) -> float:
    """Return the standard deviation of the factor of safety on a circle, to first order in the random strengths.

    With the derivatives a and b along one standard deviation of cohesion and of friction angle it is
    sqrt(a^2 + b^2 + 2 rho a b), in all layers of one field at once. Layers with fields of their own vary independently.
    """
    own = {number for number, layer in enumerate(scene.layer, start=1) if layer.field == "own"}
    of_all = {*range(len(scene.soils))} - own
    return sqrt(sum(_variance(scene, surface, circle, varied) for varied in (of_all, *({number} for number in own))))


def _variance(scene: Scene, surface: Surface, circle: SlipCircle, varied: set[int]) -> float:
    """Return what some layers that vary together add to the variance of the factor of safety."""
    layers = layer_scenes(scene)
    soils = [layer.soil for layer in layers]

    def factor(cohesions: float, friction_angles: float) -> float:
        """Return it for strengths that are so many hundredths of a standard deviation above their means."""
        strengths = [
            peak.times(
                1.0 + 0.01 * cohesions * soil.cohesion.cov,
                1.0 + 0.01 * friction_angles * (soil.friction_angle or NO_FRICTION).cov,
            )
            if number in varied
            else peak
            for number, (soil, peak) in enumerate(zip(soils, map(mean_peak, layers), strict=True))
        ]
        return factor_on(circle, surface, strata_of(scene, strengths))

    a = 50.0 * (factor(1.0, 0.0) - factor(-1.0, 0.0))
    b = 50.0 * (factor(0.0, 1.0) - factor(0.0, -1.0))
    return a**2 + b**2 + 2.0 * scene.field.cross_correlation * a * b
