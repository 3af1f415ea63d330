"""When a slide is over."""

import numpy as np

from solver.slide import PAPER, SlideCriteria

REST_ENERGY = 1e-3  # of the largest kinetic energy


class RestDetector:
    """Decide that a slide is over: it has moved, and its energy and its advance have stayed small for a while."""

    def __init__(self, criteria: SlideCriteria = PAPER) -> None:
        self._criteria = criteria
        self._largest_energy = 0.0
        self._last = (0.0, 0.0)
        self._quiet_since = np.nan

    def is_over(self, time: float, farthest: float, energy: float) -> bool:
        """Return whether the slide has come to rest.

        Parameters
        ----------
        time : float
            In s since release, growing from call to call.
        farthest : float
            Largest displacement of a particle in m.
        energy : float
            Kinetic energy in J/m.
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
        return bool(time - self._quiet_since >= criteria.rest_time - 1e-9)
