"""Ground that has come apart from the slide.

Soil that is drawn out to twice its length has cracked. So particles are joined where their domains touch, each drawn
out to twice the spacing of the lattice: where their centres are no more than two spacings apart in either direction.
That is one cell where there are four particles in a cell. It grows with the cell, as particles show no crack that is
finer than they lie. Nodes are no measure of it: in cells of 2 m they join particles that are up to 3 m apart, and as
it happens up to 5 m, ``2 (h + l_p)``, beyond which no stress crosses a gap, however strong the ground (numerical
fracture). What lies ahead of a gap is debris that moves on by itself, and its place says nothing about the slide.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from solver.observables import slope_body
from solver.particles import Particles
from solver.surface import Surface

DRAWN_OUT = 2.0
"""How many times its length ground is drawn out that has cracked."""

ROUNDING = 1e-9
"""Share by which places on a lattice may be off."""


def detached_volume(particles: Particles, start: Particles, surface: Surface, spacing: float) -> float:
    """Return the volume (m3/m, before the slide) of the slope body ahead of its largest connected part.

    The ground below the toe does not connect, or debris would belong to the slide as soon as it has landed.

    Parameters
    ----------
    particles, start : Particles
        The ground now and before the slide.
    surface : solver.filling.Surface
        Before the slide.
    spacing : float
        Distance of particles on their lattice in m.
    """
    body = slope_body(start, surface) & (start.y > surface.toe[1])
    if not body.any():
        return 0.0
    x, volume = particles.x[body], start.volume[body]
    part = connected_parts(x, particles.y[body], DRAWN_OUT * spacing)
    largest = np.argmax(np.bincount(part, volume))
    return float(volume[x > x[part == largest].max()].sum())


def connected_parts(x: NDArray[np.float64], y: NDArray[np.float64], reach: float) -> NDArray[np.int32]:
    """Return the number of the connected part to which each particle at `x`, `y` (m) belongs, (n,).

    Two are joined that are no more than `reach` (m) apart in either direction.
    """
    pairs = cKDTree(np.column_stack([x, y])).query_pairs(reach * (1.0 + ROUNDING), p=np.inf, output_type="ndarray")
    bonds = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(x.size, x.size))
    parts: NDArray[np.int32] = connected_components(bonds, directed=False)[1]
    return parts
