"""A first look at a slope before anything is run: where its toe is, how stable it is, and how fast it could slide."""

from math import erf, sqrt, tan
from typing import NamedTuple

import numpy as np

from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.limit_equilibrium import SlipCircle, critical_circle, factor_on
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
    peak, residual = critical_circles(scene, surface)
    spread = 0.0 if peak is None else _spread(scene, surface, peak)
    return FirstLook(surface, surface.height, peak, residual, spread, braking_friction(scene, surface, surface.height))


def critical_circles(scene: Scene, surface: Surface) -> tuple[SlipCircle | None, SlipCircle | None]:
    """Return the critical circles of a surface for the mean peak strength and for the residual one of a scene."""
    soil, friction_angle = scene.soil, scene.soil.friction_angle or NO_FRICTION
    peak = _circle(surface, soil.cohesion.mean, friction_angle.mean, soil.unit_weight)
    residual = None
    if soil.softening.law != "none":
        residual = _circle(surface, soil.cohesion.residual, friction_angle.residual, soil.unit_weight)
    return peak, residual


def braking_friction(scene: Scene, surface: Surface, height: float) -> float:
    """Return what brakes a slide ahead of the toe, over its weight: tan(phi) + c / (gamma d) - tan(beta), or 0.05.

    Strength c, phi is what softening has left after a slip of half the height; d is 0.3 heights, and beta the
    inclination of the ground over two heights ahead of the toe. Gentle fans of weak soil brake little.
    """
    soil, toe_x, toe_y = scene.soil, *surface.toe
    left = share_left(soil.softening, 0.5 * height, scene.numerics.locking == "none")
    friction_angle = soil.friction_angle or NO_FRICTION
    cohesion, angle = (each.residual + (each.mean - each.residual) * left for each in (soil.cohesion, friction_angle))
    end = min(toe_x + 2.0 * height, surface.width)
    descent = (toe_y - float(surface.height_at(np.array([end]))[0])) / (end - toe_x)
    return max(LEAST_FRICTION, tan(angle) + cohesion / (soil.unit_weight * DEPTH * height) - descent)


def _circle(surface: Surface, cohesion: float, friction_angle: float, unit_weight: float) -> SlipCircle | None:
    found = critical_circle(surface, cohesion, friction_angle, unit_weight)
    return found if np.isfinite(found.factor) else None


def _spread(scene: Scene, surface: Surface, circle: SlipCircle) -> float:
    """Return the standard deviation of the factor of safety on a circle, to first order in the random strengths.

    With the derivatives a and b along one standard deviation of cohesion and of friction angle it is
    sqrt(a^2 + b^2 + 2 rho a b).
    """
    soil = scene.soil
    cohesion, friction_angle = soil.cohesion, soil.friction_angle or NO_FRICTION

    def factor(cohesions: float, friction_angles: float) -> float:
        strength = cohesion.mean + cohesions * step_c, friction_angle.mean + friction_angles * step_phi
        return factor_on(circle, surface, *strength, soil.unit_weight)

    step_c, step_phi = 0.01 * cohesion.mean, 0.01 * friction_angle.mean
    a = 50.0 * cohesion.cov * (factor(1.0, 0.0) - factor(-1.0, 0.0))
    b = 50.0 * friction_angle.cov * (factor(0.0, 1.0) - factor(0.0, -1.0))
    return sqrt(a**2 + b**2 + 2.0 * scene.field.cross_correlation * a * b)
