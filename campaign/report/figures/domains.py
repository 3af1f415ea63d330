"""The domains of particles after a slide: parallelograms, from how the neighbours on the lattice have moved apart.

The solver keeps no deformation gradient; it is estimated here as the one that maps the lattice about a particle onto
the neighbours of now best, by least squares, where those that were torn off hardly count.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from campaign.simulation.solver_model import Array

NEIGHBOURS: Final = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]

TORN: Final = 1.8
"""Distance over that on the lattice from which on a neighbour counts for less than half."""

LONGEST, SHORTEST = 1.8, 0.55
"""Stretches are kept between these: a shear band stretches domains without end, and single grains mix."""

GAP: Final = 1.4
"""Squares below the domains are so much larger, to close gaps where neighbours have moved apart."""

SEAM: Final = 1.06
"""Domains are drawn so much larger that no seams show between them."""


def corners(x: Array, y: Array, deformation: Array, side: float) -> Array:
    """Return the corners (n, 4, 2) in m of the domains about `x`, `y` (m), squares of a `side` (m) before the slide."""
    half = 0.5 * SEAM * side
    square = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
    return np.asarray(np.stack([x, y], axis=-1)[:, None, :] + square @ deformation.swapaxes(-1, -2))


def covering(x: Array, y: Array, deformation: Array, side: float) -> Array:
    """Return the corners (2 n, 4, 2) in m of squares that leave no gaps, and of the domains that lie upon them."""
    size = GAP * np.sqrt(np.linalg.det(deformation))
    squares = size[:, None, None] * undeformed(x.size)
    return np.concatenate([corners(x, y, squares, side), corners(x, y, deformation, side)])


def undeformed(n: int) -> Array:
    """Return the deformation gradients (n, 2, 2) of ground that has not moved."""
    return np.tile(np.eye(2), (n, 1, 1))


def deformation_gradients(at_first: tuple[Array, Array], now: tuple[Array, Array], ratio: Array, side: float) -> Array:
    """Return the deformation gradients (n, 2, 2) of particles.

    Parameters
    ----------
    at_first, now : tuple of arrays (n,)
        Places x, y in m, on the lattice and now.
    ratio : ndarray (n,)
        Area now over that on the lattice, as the solver has it.
    side : float
        Distance of particles on the lattice in m.
    """
    places = np.stack(now, axis=-1)
    has, neighbour = _neighbours(*at_first, side)
    before = side * np.array(NEIGHBOURS, dtype=float)
    after = places[neighbour] - places[:, None, :]
    distance = np.linalg.norm(after, axis=-1) / np.linalg.norm(before, axis=-1)
    weight = has / (1.0 + (distance / TORN) ** 6)
    moment = np.einsum("nk,ka,kb->nab", weight, before, before)
    mixed = np.einsum("nk,nka,kb->nab", weight, after, before)
    known = np.linalg.det(moment) > 1e-3 * side**4
    gradients = undeformed(len(places))
    gradients[known] = mixed[known] @ np.linalg.inv(moment[known])
    return _within_limits(gradients, np.clip(ratio, SHORTEST, LONGEST))


def _neighbours(x: Array, y: Array, side: float) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """Return which of the `NEIGHBOURS` each particle has on the lattice, and their numbers, each (n, 8)."""
    i, j = (np.floor(at / side).astype(np.intp) + 1 for at in (x, y))
    number = np.full((i.max() + 2, j.max() + 2), -1, dtype=np.intp)
    number[i, j] = np.arange(x.size)
    found = np.stack([number[i + di, j + dj] for di, dj in NEIGHBOURS], axis=-1)
    return found >= 0, np.maximum(found, 0)


def _within_limits(gradients: Array, ratio: Array) -> Array:
    """Limit the stretches, give the domains their area, and leave alone what would be turned inside out."""
    left, stretch, right = np.linalg.svd(gradients)
    shape = np.clip(stretch[:, 0] / np.maximum(stretch[:, 1], 1e-9), 1.0, LONGEST / SHORTEST)
    root = np.sqrt(ratio)[:, None]
    limited = root * np.stack([np.sqrt(shape), 1.0 / np.sqrt(shape)], axis=-1)
    domains = (left * limited[:, None, :]) @ right
    inside_out = np.linalg.det(gradients) <= 0.0
    domains[inside_out] = root[inside_out, :, None] * np.eye(2)
    return np.asarray(domains)
