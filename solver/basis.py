"""One-dimensional basis functions and their gradients: linear, uGIMP and quadratic B-spline as one family.

Convolving the linear hat function with a particle of half length ``l_p`` gives the uGIMP function of Bardenhagen and
Kober (2004, CMES 5:477, eq. 22-24). Its limits are the linear basis (``l_p -> 0``) and the quadratic B-spline
(``l_p = h/2``), so one branch-free formula serves all three. A particle at node coordinate ``xi = x/h`` touches the
three nodes from ``floor(xi - l_p)`` on. With ``d = xi - floor(xi - l_p)`` and ``t = max(0, d - (1 - l_p))``

    S_0 = 1 - d + t^2 / (4 l_p)      S_2 = t^2 / (4 l_p)      S_1 = 1 - S_0 - S_2
    S_0' = -1 + t / (2 l_p)          S_2' = t / (2 l_p)       S_1' = -S_0' - S_2'
"""

from typing import NamedTuple

import numpy as np

from solver._jit import inlined, kernel


class Stencil(NamedTuple):
    """Weights of particles on their 3 x 3 nodes, kept factorised by direction."""

    node: np.ndarray  # (n,) flat index of the lower left node
    sx: np.ndarray  # (3, n) weights along x
    sy: np.ndarray  # (3, n)
    gx: np.ndarray  # (3, n) weight gradients along x, 1/m
    gy: np.ndarray  # (3, n)


def allocate_stencil(n_particles: int) -> Stencil:
    """Return scratch space for the weights of ``n_particles``."""
    return Stencil(np.empty(n_particles, np.int64), *(np.empty((3, n_particles)) for _ in range(4)))


@inlined
def weight_and_gradient(distance, half_length, inverse_cell):
    """Return ``(S_0, S_1, S_2)`` and ``(S_0', S_1', S_2')`` at ``distance`` cells from the first of the three nodes."""
    t = max(0.0, distance - (1.0 - half_length))
    s2 = t * t / (4.0 * half_length)
    s0 = 1.0 - distance + s2
    g2 = t / (2.0 * half_length)
    g0 = g2 - 1.0
    return (s0, 1.0 - s0 - s2, s2), (g0 * inverse_cell, -(g0 + g2) * inverse_cell, g2 * inverse_cell)


@kernel
def evaluate_stencil(stencil, x, y, grid):
    """Fill ``stencil`` with the weights of the particles at ``x``, ``y`` (n,) in m, from the lower left wall corner."""
    inverse_cell = 1.0 / grid.cell_size
    for p in range(x.size):
        xi = (x[p] - grid.origin) * inverse_cell
        yi = (y[p] - grid.origin) * inverse_cell
        i = int(xi - grid.half_length)
        j = int(yi - grid.half_length)
        stencil.node[p] = j * grid.columns + i
        sx, gx = weight_and_gradient(xi - i, grid.half_length, inverse_cell)
        sy, gy = weight_and_gradient(yi - j, grid.half_length, inverse_cell)
        for k in range(3):
            stencil.sx[k, p], stencil.gx[k, p] = sx[k], gx[k]
            stencil.sy[k, p], stencil.gy[k, p] = sy[k], gy[k]
