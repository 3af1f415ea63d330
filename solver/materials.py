"""Materials of the ground, and the update of particles that each have their own.

A particle carries the number of its material. Eight particles that are updated together may be of several: each law
that one of them has is evaluated for all, and each takes its own.
"""

from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from solver._jit import chosen_by_type, inlined
from solver.constants import STANDARD_GRAVITY
from solver.elastic import p_wave_speed
from solver.kinematics import rotate_stress, volume_ratio
from solver.lanes import anywhere, where
from solver.laws.registry import Law, update_stress
from solver.particles import Particles
from solver.softening import Strength, remaining_shares, softened


class Material(NamedTuple):
    """What a kind of ground is made of, but for the strengths that its particles carry themselves."""

    density: float  # kg/m3
    poisson_ratio: float
    law: Law
    saturated_density: float | None = None  # kg/m3, below the water table; None: the same
    k0: float | None = None  # horizontal over vertical effective stress at rest; None: of elastic ground

    @property
    def horizontal_share(self) -> float:
        """Horizontal over vertical effective stress of level ground at rest, ``nu / (1 - nu)`` if elastic."""
        return self.poisson_ratio / (1.0 - self.poisson_ratio) if self.k0 is None else self.k0

    @property
    def unit_weight(self) -> float:
        """Weight of a volume in N/m3, above the water table."""
        return self.density * STANDARD_GRAVITY

    @property
    def density_under_water(self) -> float:
        """Density in kg/m3 below the water table."""
        return self.density if self.saturated_density is None else self.saturated_density

    @property
    def saturated_unit_weight(self) -> float:
        """Weight of a volume in N/m3, below the water table."""
        return self.density_under_water * STANDARD_GRAVITY

    @property
    def wave_speed(self) -> float:
        """P-wave speed in m/s."""
        return p_wave_speed(self.law.bulk_modulus, self.law.shear_modulus, self.density)

    @property
    def shear_wave_speed(self) -> float:
        """S-wave speed in m/s."""
        return sqrt(self.law.shear_modulus / self.density)


class Deformed(NamedTuple):
    """Particles after an increment, and the work of their total stresses in it; lanes or floats."""

    stress_xx: float  # Pa, effective
    stress_yy: float
    stress_zz: float
    stress_xy: float
    plastic_strain: float
    volume: float  # m2
    work: float  # J/m


@inlined
def deformed(particles, increment, laws, dt):
    """Return what an increment makes of particles.

    Parameters
    ----------
    particles : Particles
        Of lanes or floats.
    increment : tuple of 4
        Displacement gradients ``L dt``: xx, xy, yx, yy.
    laws : tuple of NamedTuple
        Parameters of the law of each material.
    dt : float
        In s.
    """
    l_xx, l_xy, l_yx, l_yy = increment
    shear = 0.5 * (l_xy + l_yx)
    xx, yy, xy = rotate_stress(particles.stress_xx, particles.stress_yy, particles.stress_xy, 0.5 * (l_xy - l_yx))
    strength = Strength(
        particles.cohesion,
        particles.friction_angle,
        particles.cohesion_residual,
        particles.friction_angle_residual,
    )
    stress, strain = (xx, yy, particles.stress_zz, xy), (l_xx, l_yy, shear)
    new_xx, new_yy, new_zz, new_xy, plastic_strain = update_by_material(
        laws, 0, particles.material, stress, strain, particles.plastic_strain, strength, dt
    )
    volume = particles.volume * volume_ratio(l_xx, l_xy, l_yx, l_yy)
    mean_volume = 0.5 * (volume + particles.volume)
    work = mean_volume * (0.5 * ((xx + new_xx) * l_xx + (yy + new_yy) * l_yy) + (xy + new_xy) * shear)
    work = work - mean_volume * particles.pore_pressure * (l_xx + l_yy)
    return Deformed(new_xx, new_yy, new_zz, new_xy, plastic_strain, volume, work)


def update_by_material(laws, number, material, stress, strain, plastic_strain, strength, dt):
    """Return stress and plastic strain of particles by the law of their ``material``; the first law has ``number``."""
    raise NotImplementedError("A kernel's own.")


@chosen_by_type(update_by_material)
def _one_or_several(
    laws: Any, number: Any, material: Any, stress: Any, strain: Any, plastic_strain: Any, strength: Any, dt: Any
) -> Any:
    """Types differ from law to law, so the tuple is unrolled. The number of a single material is not even read."""

    def one(laws, number, material, stress, strain, plastic_strain, strength, dt):
        return update_stress(laws[0], stress, strain, plastic_strain, strength, dt)

    def first_and_others(laws, number, material, stress, strain, plastic_strain, strength, dt):
        others = update_by_material(laws[1:], number + 1, material, stress, strain, plastic_strain, strength, dt)
        is_first = material == float(number)
        if anywhere(is_first):
            first = update_stress(laws[0], stress, strain, plastic_strain, strength, dt)
            others = (
                where(is_first, first[0], others[0]),
                where(is_first, first[1], others[1]),
                where(is_first, first[2], others[2]),
                where(is_first, first[3], others[3]),
                where(is_first, first[4], others[4]),
            )
        return others

    return one if len(laws) == 1 else first_and_others


def intact_share(particles: Particles, materials: tuple[Material, ...]) -> np.ndarray:
    """Return the share that is left of the drop from peak to residual strength, (n,)."""
    share = np.empty_like(particles.plastic_strain)
    for number, material in enumerate(materials):
        is_here = particles.material == number
        share[is_here] = remaining_shares(particles.plastic_strain[is_here], material.law.softening)
    return share


def mobilised_strength(particles: Particles, materials: tuple[Material, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return what softening has left of cohesion (Pa) and friction angle (rad), each (n,)."""
    share = intact_share(particles, materials)
    return (
        softened(particles.cohesion, particles.cohesion_residual, share),
        softened(particles.friction_angle, particles.friction_angle_residual, share),
    )
