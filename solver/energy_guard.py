"""What the transfers between particles and grid do to the energy of a slide."""

import numpy as np

from solver import observables
from solver.operations import GRAVITY_WORK, INTERNAL_WORK
from solver.particles import Particles

MOST_ENERGY_ERROR = 0.02  # of the work of gravity: beyond it the scheme, not the ground, drives or stops the slide
MOST_CREATED_EARLY = 0.05  # the same while the slide goes on: soft ground vibrates before gravity has done much work
MOST_LOST_TO_PIC = 0.005  # the same, for a blend with PIC: a slide that loses so much is a sixth shorter


class EnergyGuard:
    """The energy balance of a march, and the complaint about a scheme that breaks it.

    Parameters
    ----------
    start, particles : Particles
        The ground at release and now; it sees how ``particles`` change.
    ledger : ndarray (2,)
        Work of the stresses and of gravity so far in J/m; it sees how they grow.
    flip_fraction : float
        1 FLIP, 0 PIC.
    displaced : float
        Displacement in m from which on the ground counts as moving; ground at rest is not judged.
    """

    def __init__(
        self, start: Particles, particles: Particles, ledger: np.ndarray, flip_fraction: float, displaced: float
    ) -> None:
        self._start, self._particles, self._ledger = start, particles, ledger
        self._has_pic = flip_fraction != 1.0
        self._displaced = displaced

    def error(self) -> float:
        """Return (kinetic energy gained + work of the stresses - work of gravity) over the energy put in.

        What is put in is the work of gravity and the kinetic energy of the start. The work of the stresses is what they
        store plus what plastic flow dissipates, so the error is what the transfers between particles and grid create
        (> 0) or destroy (< 0).
        """
        internal = self._ledger[INTERNAL_WORK]
        released = self._ledger[GRAVITY_WORK]
        brought = observables.kinetic_energy(self._start)
        imbalance = observables.kinetic_energy(self._particles) - brought + internal - released
        put_in = abs(released) + brought
        return float(imbalance / put_in) if put_in > 0.0 else 0.0

    def is_created(self, most: float = MOST_ENERGY_ERROR) -> bool:
        """Whether a slope that moves has gained more energy than gravity gave, the mark of an unstable step.

        It shows best at the start, before gravity has done much work: later, plastic flow eats what was created.
        """
        return self._has_moved and not self.error() <= most

    def is_lost(self) -> bool:
        """Whether a slope that moved has lost energy to the scheme, the mark of numerical damping."""
        return self._has_moved and not self.error() >= -(MOST_LOST_TO_PIC if self._has_pic else MOST_ENERGY_ERROR)

    def complaint(self) -> str:
        """Return what the scheme did to the energy, and the remedy."""
        error = self.error()
        verb = "destroyed" if error < 0.0 else "created"
        remedy = "set numerics.flip to 1" if self._has_pic else "lower numerics.courant"
        return f"The scheme {verb} energy, {abs(error):.1%} of the work of gravity; {remedy}."

    @property
    def _has_moved(self) -> bool:
        return bool(observables.displacement(self._particles, self._start).max() > self._displaced)
