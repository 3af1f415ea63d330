"""Materials of the ground, and the update of particles that each have their own.

A particle carries the number of its material. Where there is one material the number is not even read; where there are
several a block is cut where the number changes, so that each piece still runs through one law as a vectorised loop.
"""

from typing import Any, NamedTuple

import numpy as np

from solver._jit import chosen_by_type, inlined
from solver.constants import STANDARD_GRAVITY
from solver.elastic import p_wave_speed
from solver.laws.registry import Law
from solver.operations import update_material
from solver.particles import Particles, take_block
from solver.softening import remaining_shares, softened


class Material(NamedTuple):
    """What a kind of ground is made of, but for the strengths that its particles carry themselves."""

    density: float  # kg/m3
    poisson_ratio: float
    law: Law

    @property
    def unit_weight(self) -> float:
        """Weight of a volume in N/m3."""
        return self.density * STANDARD_GRAVITY

    @property
    def wave_speed(self) -> float:
        """P-wave speed in m/s."""
        return p_wave_speed(self.law.bulk_modulus, self.law.shear_modulus, self.density)


@inlined
def end_of_run(numbers, start):
    """Return where the run of equal ``numbers`` (n,) that begins at ``start`` ends."""
    stop = start + 1
    while stop < numbers.size and numbers[stop] == numbers[start]:
        stop += 1
    return stop


def update_by_number(number, particles, increment, laws, dt):
    """Update particles that all have the material of that number; see ``update_materials``."""
    return update_material(particles, increment, laws[number], dt)


@chosen_by_type(update_by_number)
def _law_of_number(number: Any, particles: Any, increment: Any, laws: Any, dt: Any) -> Any:
    """Types differ from law to law, so the tuple is unrolled: this law, or one of those behind it."""

    def last(number, particles, increment, laws, dt):
        return update_material(particles, increment, laws[0], dt)

    def first_or_later(number, particles, increment, laws, dt):
        if number == 0:
            return update_material(particles, increment, laws[0], dt)
        return update_by_number(number - 1, particles, increment, laws[1:], dt)

    return last if len(laws) == 1 else first_or_later


def update_materials(particles, increment, laws, dt):
    """Update stress, plastic strain and volume of a block of particles; return the work of the stresses in J/m.

    Parameters
    ----------
    particles : Particles (n,)
        Modified.
    increment : ndarray (4, n)
        Displacement gradients ``L dt``: xx, xy, yx, yy.
    laws : tuple of NamedTuple
        Parameters of the law of each material.
    dt : float
        In s.
    """
    work = 0.0
    start = 0
    while start < particles.x.size:
        stop = end_of_run(particles.material, start)
        piece = take_block(particles, start, stop)
        work += update_by_number(particles.material[start], piece, increment[:, start:stop], laws, dt)
        start = stop
    return work


@chosen_by_type(update_materials)
def _one_or_several(particles: Any, increment: Any, laws: Any, dt: Any) -> Any:
    def one(particles, increment, laws, dt):
        return update_material(particles, increment, laws[0], dt)

    return one if len(laws) == 1 else update_materials


def mobilised_strength(particles: Particles, materials: tuple[Material, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return what softening has left of cohesion (Pa) and friction angle (rad), each (n,)."""
    share = np.empty_like(particles.plastic_strain)
    for number, material in enumerate(materials):
        is_here = particles.material == number
        share[is_here] = remaining_shares(particles.plastic_strain[is_here], material.law.softening)
    return (
        softened(particles.cohesion, particles.cohesion_residual, share),
        softened(particles.friction_angle, particles.friction_angle_residual, share),
    )
