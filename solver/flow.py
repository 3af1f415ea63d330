"""The flow of moved ground through columns: its depth, its mean velocity, and what it would push with."""

from typing import NamedTuple

import numpy as np

from solver.particles import Particles


class Flow(NamedTuple):
    """Moved ground in each of k columns; zero where a column has none."""

    depth: np.ndarray  # (k,) m, vertical thickness
    velocity: np.ndarray  # (k,) m/s, momentum over mass: its mean over the depth
    momentum_flux: np.ndarray  # (k,) N/m, rho h v^2
    impact_pressure: np.ndarray  # (k,) Pa, rho v^2


def flow_through(
    particles: Particles, start: Particles, moved: np.ndarray, half_length: float, columns: np.ndarray
) -> Flow:
    """Return the flow of the moved ground through columns.

    As for the surface of a deposit, a particle is spread over ``x_p +- half_length``, with the area that it had before
    the slide: grains that part gain area, a flow not.

    Parameters
    ----------
    particles, start : Particles
        Now and before the slide.
    moved : ndarray (n,)
        The mask of the particles that count.
    half_length : float
        Half the distance of particles on their lattice in m.
    columns : ndarray (k, 2)
        Left and right edge of each in m.
    """
    left, right = columns.T
    share = shares_in_columns(particles.x[moved], half_length, columns)
    area = share @ start.volume[moved]
    mass = share @ particles.mass[moved]
    momentum = np.hypot(
        share @ (particles.mass[moved] * particles.velocity_x[moved]),
        share @ (particles.mass[moved] * particles.velocity_y[moved]),
    )
    velocity = _quotient(momentum, mass)
    return Flow(
        depth=area / (right - left),
        velocity=velocity,
        momentum_flux=mass / (right - left) * velocity**2,
        impact_pressure=_quotient(mass, area) * velocity**2,
    )


def shares_in_columns(x: np.ndarray, half_length: float, columns: np.ndarray) -> np.ndarray:
    """Return the share of ``x_p +- half_length`` (m) that lies in each of the ``columns`` (k, 2) in m, (k, n)."""
    left, right = columns[:, :1], columns[:, 1:]
    inside = np.minimum(x + half_length, right) - np.maximum(x - half_length, left)
    share: np.ndarray = np.maximum(inside, 0.0) / (2.0 * half_length)
    return share


def _quotient(dividend: np.ndarray, divisor: np.ndarray) -> np.ndarray:
    quotient: np.ndarray = np.divide(dividend, divisor, out=np.zeros_like(dividend), where=divisor > 0.0)
    return quotient
