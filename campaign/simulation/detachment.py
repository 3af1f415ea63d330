"""Ground that has come apart from the slide: numerical fracture.

Particles feel each other through the nodes that both touch. Their domains do not stretch with the ground, so two that
have drifted ``h + 2 l_p`` apart may, and two that are ``2 (h + l_p)`` apart must, have no node in common. No stress
crosses such a gap, however strong the ground: what lies ahead of it flies on by itself, and its place says nothing
about the slide.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from solver.basis import allocate_stencil, evaluate_stencil
from solver.grid import Grid
from solver.observables import slope_body
from solver.particles import Particles
from solver.surface import Surface

TOUCH = 1e-6
"""The weight from which on a particle touches a node; the linear basis is a hat function up to that."""


def detached_volume(particles: Particles, start: Particles, surface: Surface, grid: Grid) -> float:
    """Return the volume (m3/m, before the slide) of the slope body ahead of its largest connected part.

    The ground below the toe does not connect, or debris would belong to the slide as soon as it has landed.

    Parameters
    ----------
    particles, start : Particles
        The ground now and before the slide.
    surface : solver.filling.Surface
        Before the slide.
    grid : solver.grid.Grid
        Whose nodes join the particles; not modified.
    """
    body = slope_body(start, surface) & (start.y > surface.toe[1])
    if not body.any():
        return 0.0
    x, volume = particles.x[body], start.volume[body]
    part = connected_parts(x, particles.y[body], grid)
    largest = np.argmax(np.bincount(part, volume))
    return float(volume[x > x[part == largest].max()].sum())


def connected_parts(x: NDArray[np.float64], y: NDArray[np.float64], grid: Grid) -> NDArray[np.int32]:
    """Return the number of the connected part to which each particle at `x`, `y` (m) belongs, (n,)."""
    stencil = allocate_stencil(x.size)
    evaluate_stencil(stencil, x, y, grid)
    offset = np.arange(3) + grid.columns * np.arange(3)[:, None]
    weight = stencil.sx * stencil.sy[:, None]
    row, column, particle = np.nonzero(weight > TOUCH)
    node = stencil.node[particle] + offset[row, column]
    ends = x.size + grid.mass.size
    bonds = coo_array((np.ones(node.size), (particle, x.size + node)), shape=(ends, ends))
    parts: NDArray[np.int32] = connected_components(bonds, directed=False)[1]
    return parts[: x.size]
