"""A first look at a slope before anything is run: where its toe is, how stable it is, and how fast it could slide."""

from math import erf, sqrt
from typing import NamedTuple

import numpy as np

from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.limit_equilibrium import SlipCircle, critical_circle, factor_on
from campaign.scene.sections import FrictionAngle
from solver.constants import STANDARD_GRAVITY
from solver.surface import Surface

SHORTEST_SLIDE, LONGEST_SLIDE = 5.0, 8.0
"""Times from release to rest over sqrt(H / g). Deterministic runs of `ma2023` and its variants (mean factors of safety
of 0.6 to 0.9, residual ones of 0.1 to 0.5, 30 to 60 degrees, 6 to 30 m high) took 5.0 to 8.3."""

NO_FRICTION = FrictionAngle.model_construct(mean=0.0, cov=0.0, residual=0.0)
"""Of soil with undrained strength alone."""


class FirstLook(NamedTuple):
    """What can be known of a slope within a tenth of a second.

    Attributes
    ----------
    surface : Surface
    height : float
        Of the highest ground upslope of the toe above the toe, in m.
    peak, residual : SlipCircle or None
        The critical circles for the mean peak strength and for the residual one; None where nothing drives a slide or
        nothing resists it, and where the soil does not soften.
    spread : float
        Standard deviation of the factor of safety if each realization had one strength everywhere.
    """

    surface: Surface
    height: float
    peak: SlipCircle | None
    residual: SlipCircle | None
    spread: float

    @property
    def time_scale(self) -> float:
        """The time sqrt(H / g) in s, to which those of slides are proportional."""
        return sqrt(self.height / STANDARD_GRAVITY)

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
    surface, soil = surface_of(scene.geometry), scene.soil
    friction_angle = soil.friction_angle or NO_FRICTION
    peak = _circle(surface, soil.cohesion.mean, friction_angle.mean, soil.unit_weight)
    residual = None
    if soil.softening.law != "none":
        residual = _circle(surface, soil.cohesion.residual, friction_angle.residual, soil.unit_weight)
    spread = 0.0 if peak is None else _spread(scene, surface, peak)
    return FirstLook(surface, height_above_toe(surface), peak, residual, spread)


def height_above_toe(surface: Surface) -> float:
    """Return how far in m the highest ground upslope of the toe lies above the toe."""
    toe_x, toe_y = surface.toe
    return float(np.max(surface.y[surface.x <= toe_x])) - toe_y


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
