"""The material points as a structure of arrays."""

from typing import NamedTuple

import numpy as np


class Particles(NamedTuple):
    """State of ``n`` particles, one contiguous array a component; per metre run out of plane."""

    x: np.ndarray  # (n,) m, from the left wall
    y: np.ndarray  # (n,) m, from the base
    velocity_x: np.ndarray  # (n,) m/s
    velocity_y: np.ndarray  # (n,) m/s
    mass: np.ndarray  # (n,) kg/m
    volume: np.ndarray  # (n,) m2
    stress_xx: np.ndarray  # (n,) Pa, Cauchy, effective, tension positive
    stress_yy: np.ndarray  # (n,) Pa
    stress_zz: np.ndarray  # (n,) Pa
    stress_xy: np.ndarray  # (n,) Pa
    plastic_strain: np.ndarray  # (n,) accumulated equivalent deviatoric plastic strain
    cohesion: np.ndarray  # (n,) Pa, peak
    friction_angle: np.ndarray  # (n,) rad, peak
    cohesion_residual: np.ndarray  # (n,) Pa
    friction_angle_residual: np.ndarray  # (n,) rad
    pore_area: np.ndarray  # (n,) m2, the part of the area on which pore water carries the weight above; it stays
    pore_pressure: np.ndarray  # (n,) Pa, compression positive, beyond that of standing water; stresses are effective
    material: np.ndarray  # (n,) number of the particle's material, from 0


UNYIELDING = 1e15  # Pa: a cohesion that no stress reaches, so that the law is elastic


def allocate_particles(x: np.ndarray, y: np.ndarray, volume: float, density: float) -> Particles:
    """Return elastic particles of the material 0, at rest and free of stress.

    Parameters
    ----------
    x, y : ndarray (n,)
        Positions in m.
    volume : float
        Area of each particle in m2.
    density : float
        kg/m3.
    """
    n = x.size
    zeros = {name: np.zeros(n) for name in Particles._fields}
    return Particles(**zeros)._replace(
        x=np.array(x, dtype=float),
        y=np.array(y, dtype=float),
        mass=np.full(n, volume * density),
        volume=np.full(n, volume),
        cohesion=np.full(n, UNYIELDING),
        material=np.zeros(n, np.uint8),
    )


def assign_material(particles: Particles, where: np.ndarray, number: int, density: float) -> None:
    """Make the particles of the mask ``where`` (n,) of another material, in place; ``density`` in kg/m3."""
    particles.material[where] = number
    particles.mass[where] = particles.volume[where] * density


def copy_particles(particles: Particles) -> Particles:
    """Return an independent copy."""
    return Particles(*(array.copy() for array in particles))
