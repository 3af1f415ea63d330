"""When a slide is over, and when a slope stands."""

from collections import deque
from enum import IntEnum
from math import sqrt

import numpy as np

from solver.constants import STANDARD_GRAVITY
from solver.slide import PAPER, SlideCriteria

REST_ENERGY = 1e-3  # of the largest kinetic energy
REST_UNBALANCED = 0.1  # of the weight: undamped ground at rest vibrates, which keeps 0.01 to 0.06 of it
PATIENCE = 5.0  # rest times, after which quiet ground is at rest whatever its forces
STILL = 0.4  # of the rest speed: root mean square of the speed of ground that only vibrates
CREEP = 0.02  # of the displacement that counts: more than this is growth
SOFTENED = 0.005  # of the drop from peak to residual strength: more than this to come may make the ground fail
WATCH = 1.5  # times sqrt(H / g), the time in which a slope without strength would be under way


class RestBy(IntEnum):
    """What held when the ground was found at rest."""

    NEVER = 0
    MOTION = 1  # kinetic energy and advance alone
    MOTION_AND_FORCE = 2
    STANDING = 3  # it never slid: see ``StandDetector``


class RestDetector:
    """Decide that a slide is over: it has moved, and its energy and its advance have stayed small for a while.

    The unbalanced force has to be small as well. Where vibration keeps it up, energy and advance decide alone after a
    longer while, and ``by`` says so.
    """

    def __init__(self, criteria: SlideCriteria = PAPER) -> None:
        self._criteria = criteria
        self._largest_energy = 0.0
        self._last = (0.0, 0.0)
        self._quiet_since = np.nan
        self.by = RestBy.NEVER

    def is_over(self, time: float, farthest: float, energy: float, unbalanced: float) -> bool:
        """Return whether the slide has come to rest.

        Parameters
        ----------
        time : float
            In s since release, growing from call to call.
        farthest : float
            Largest displacement of a particle in m.
        energy : float
            Kinetic energy in J/m.
        unbalanced : float
            Unbalanced force over the weight.
        """
        criteria = self._criteria
        self._largest_energy = max(self._largest_energy, energy)
        last_time, last_farthest = self._last
        self._last = (time, farthest)
        has_stopped = abs(farthest - last_farthest) < criteria.rest_speed * (time - last_time)
        if not (has_stopped and farthest > criteria.failed and energy < REST_ENERGY * self._largest_energy):
            self._quiet_since = np.nan
        elif np.isnan(self._quiet_since):
            self._quiet_since = time
        quiet = time - self._quiet_since + 1e-9
        if quiet >= criteria.rest_time and unbalanced < REST_UNBALANCED:
            self.by = RestBy.MOTION_AND_FORCE
        elif quiet >= PATIENCE * criteria.rest_time:
            self.by = RestBy.MOTION
        return self.by is not RestBy.NEVER


class StandDetector:
    """Decide that a slope stands: long enough for a slide to get under way, nothing has grown, and little will soften.

    Ground that is released without damping vibrates on for ever, so neither energy nor force need vanish; they only
    have to be small. While vibration reaches the strength at its peaks the ground yields a little each time and
    softens. Where that dies out, the rest is elastic and the slope stands (it has shaken down). Where it does not, the
    slope fails in the end, and for long nothing tells so but the strength that goes: displacement creeps by less than
    it swings. So what is to be lost is extrapolated. A share ``s`` (n,) of the drop from peak to residual strength was
    lost during the watch; where strength goes it will go on by

        (sum s^2 / sum s) (end_time - time) / watch

    until the end of the run, if the pace does not change; that of a slope that stands falls. Particles weigh as they
    soften, so it is the same for a band in a large slope and in a small one.

    Parameters
    ----------
    criteria : SlideCriteria
    height : float
        Of the slope in m.
    period : float
        Of the slowest elastic oscillation in s: yielding comes and goes with it.
    mass : float
        Of the ground in kg/m.
    end_time : float
        Of the run in s.
    loaded_at : float
        Time in s from which on gravity is whole; earlier nothing is judged.
    """

    def __init__(
        self,
        criteria: SlideCriteria,
        height: float,
        period: float,
        mass: float,
        end_time: float,
        loaded_at: float = 0.0,
    ) -> None:
        self._criteria = criteria
        self._watch = max(WATCH * sqrt(height / STANDARD_GRAVITY), period, criteria.rest_time)
        self._most_energy = 0.5 * mass * (STILL * criteria.rest_speed) ** 2
        self._end_time = end_time
        self._loaded_at = loaded_at
        self._seen: deque[tuple[float, float, float, float]] = deque()
        self._intact: deque[np.ndarray] = deque()

    def stands(self, time: float, farthest: float, energy: float, unbalanced: float, intact: np.ndarray) -> bool:
        """Return whether the slope is known to stand.

        Parameters
        ----------
        time, farthest, energy, unbalanced : float
            As of ``RestDetector.is_over``.
        intact : ndarray (n,)
            Share that is left of the drop from peak to residual strength of each particle.
        """
        if time < self._loaded_at:
            return False
        seen = self._seen
        seen.append((time, farthest, energy, unbalanced))
        self._intact.append(intact)
        while len(seen) > 1 and seen[1][0] <= time - self._watch + 1e-9:
            seen.popleft()
            self._intact.popleft()
        if len(seen) < 3 or seen[0][0] > time - self._watch + 1e-9:
            return False
        times, displacements, energies, forces = np.array(seen).T
        grown = float(np.ptp(displacements))
        watches_to_come = (self._end_time - time) / (time - times[0])
        return bool(
            displacements.max() <= self._criteria.displaced
            and grown <= CREEP * self._criteria.displaced
            and energies.max() <= self._most_energy
            and np.all(forces[1:] < REST_UNBALANCED)
            and watches_to_come * _lost_where_it_goes(self._intact[0] - intact) <= SOFTENED
        )


def _lost_where_it_goes(lost: np.ndarray) -> float:
    """Return the mean of shares lost (n,) in which each weighs by itself; 0 if nothing is lost."""
    total = float(lost.sum())
    return float(np.sum(lost**2)) / total if total > 0.0 else 0.0
