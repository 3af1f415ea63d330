"""How much farther a front may come that is not at rest when the run ends.

Ground that moves at a speed v over level ground comes to rest within ``v^2 / (2 g f)``, with ``f`` the least that
resists it over its weight: its residual strength. That bounds a front which nothing pushes any more, so it is asked
only of one that has lost half of its largest speed. Ground behind it that still moves may push it on, so the speed is
the larger one of the front's and the root mean square of the sliding ground's: a front that stands while its slope
goes on to retrogress, as in brittle ground, has a small distance left. All this is of the front of the mass. The tip is
a single particle, and another one may fly past it.
"""

from math import inf

import numpy as np

from solver import observables
from solver.constants import STANDARD_GRAVITY
from solver.history import MarchEnd, MarchHistory
from solver.particles import Particles
from solver.slide import SlideCriteria
from solver.surface import Surface

PAST_ITS_PEAK = 0.5
"""Share of its largest speed below which a front slows down for good."""


def stopping_distance(speed: float, friction: float) -> float:
    """Return the distance in m in which friction alone stops ground, ``v^2 / (2 g f)``; infinite without any.

    Parameters
    ----------
    speed : float
        In m/s.
    friction : float
        What resists over the weight.
    """
    return speed**2 / (2.0 * STANDARD_GRAVITY * friction) if friction > 0.0 else inf


def least_friction(particles: Particles, surface: Surface) -> float:
    """Return what resists particles at residual strength over their weight.

    That is the larger of (1 - r) tan(phi) and c / (gamma H), with r the share of the weight that pore pressure carries.
    Ground that flows is at most as thick as the slope is high, H, so its cohesion is at least so much of its weight.
    The smaller of both is left for the slope behind, which may still push. Areas are those before the slide, as grains
    that part gain area.
    """
    unit_weight = STANDARD_GRAVITY * particles.mass.sum() / particles.volume.sum()
    cohesion, angle = particles.cohesion_residual.mean(), particles.friction_angle_residual.mean()
    effective = 1.0 - np.mean(particles.pore_area / particles.volume)
    return float(max(effective * np.tan(angle), cohesion / (unit_weight * surface.relief)))


def farther_advance(history: MarchHistory, surface: Surface, criteria: SlideCriteria) -> float:
    """Return how much farther in m the front may come after the end: 0 at rest, NaN where nothing bounds it.

    Parameters
    ----------
    history : MarchHistory
    surface : Surface
    criteria : SlideCriteria
    """
    if history.end in (MarchEnd.AT_REST, MarchEnd.STANDS):
        return 0.0
    speeds = front_speeds(history.time, history.runout_mass, criteria)
    if criteria.front == "tip" or history.walls.right or not speeds[-1] < PAST_ITS_PEAK * speeds.max():
        return np.nan
    slid = observables.is_displaced(history.particles, history.reference, criteria)
    sliding = Particles(*(array[slid] for array in history.reference))
    speed = max(speeds[-1], float(np.sqrt(2.0 * history.kinetic_energy[-1] / sliding.mass.sum())))
    return stopping_distance(speed, least_friction(sliding, surface))


def front_speeds(time: np.ndarray, runout: np.ndarray, criteria: SlideCriteria) -> np.ndarray:
    """Return the speeds in m/s at which a front advanced in the while before each time, 0 for one that is drawn back.

    Parameters
    ----------
    time : ndarray (t,)
        In s, increasing from 0.
    runout : ndarray (t,)
        In m.
    criteria : SlideCriteria
        By which the while is a second on a slope that fails at 1 m; it is an output interval at least.
    """
    lapse = max(criteria.front_time, float(np.diff(time).max()))
    speeds: np.ndarray = np.maximum(runout - np.interp(time - lapse, time, runout), 0.0) / lapse
    return speeds
