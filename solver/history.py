"""What is seen of a slide at the output times, and what remains of it."""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

import numpy as np

from solver import observables
from solver.balance import unbalanced_share
from solver.grid import Grid
from solver.model import Model
from solver.particles import Particles
from solver.rest import RestBy
from solver.walls import Walls


class MarchEnd(Enum):
    """How a march ended."""

    AT_REST = "at rest"
    STANDS = "stands"
    END_TIME = "end time"
    DIVERGED = "diverged"
    LEFT_DOMAIN = "left domain"


class Moment(NamedTuple):
    """What is seen of a slide at one time."""

    runout: float  # m, of the front-most particle
    runout_mass: float  # m, of the mass front
    front_position: float  # m, x of the front that the criteria choose; NaN while nothing slides
    max_displacement: float  # m
    kinetic_energy: float  # J/m, of the motion resolved by the grid
    unbalanced_force: float  # over the weight, see ``balance.unbalanced_share``


def moment(particles: Particles, reference: Particles, grid: Grid, model: Model, gravity: float) -> Moment:
    """Return what is seen of a slide now.

    Parameters
    ----------
    particles : Particles
    reference : Particles
        The ground from whose places displacement counts.
    grid : Grid
        With mass, momentum and force of the particles.
    model : Model
    gravity : float
        Downward, now, in m/s2.
    """
    criteria, toe_x = model.criteria, model.surface.toe_x
    tip = observables.front(particles, reference, model.surface, criteria)
    mass_front = observables.mass_front(particles, reference, model.surface, criteria)
    return Moment(
        runout=observables.advance(tip, toe_x),
        runout_mass=observables.advance(mass_front, toe_x),
        front_position=mass_front if criteria.front == "mass" else tip,
        max_displacement=float(observables.displacement(particles, reference).max()),
        kinetic_energy=observables.resolved_kinetic_energy(grid),
        unbalanced_force=unbalanced_share(grid, gravity),
    )


@dataclass
class MarchHistory:
    """Observables of one march at the output times; after rest the last values hold, after a failure NaN."""

    time: np.ndarray  # (t,) s since release
    runout: np.ndarray  # (t,) and the next five: see ``Moment``
    runout_mass: np.ndarray
    front_position: np.ndarray
    max_displacement: np.ndarray
    kinetic_energy: np.ndarray
    unbalanced_force: np.ndarray
    end: MarchEnd
    reason: str
    settle_time: float  # s, NaN if it did not come to rest
    rest_by: RestBy
    walls: Walls  # that the slide reached on its way
    energy_error: float  # see EnergyGuard.error
    steps: int
    particles: Particles  # at the end
    reference: Particles  # from whose places displacement counts at the end

    @property
    def has_failed(self) -> bool:
        """Whether the march broke off."""
        return self.end in (MarchEnd.DIVERGED, MarchEnd.LEFT_DOMAIN)
