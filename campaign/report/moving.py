"""The ground that moves in a film: squares of particles, where they are in each frame, and in which colour."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.report.figures.domains import deformation_gradients
from campaign.report.figures.section import Section
from campaign.report.snapshots import Snapshot
from campaign.simulation.ground import Ground
from campaign.simulation.solver_model import Array

MOST = 2000
"""Moving areas of a film; more are joined to larger ones, or the page becomes large."""

SHARES: Final = np.array([0.0, 0.1, 0.2, 0.4, 0.7])
"""Of the height of the slope: displacements from which on ground has the next colour."""

LEVELS: Final = SHARES.size + 1
"""Colours of moving ground; the first is that of ground that does not move yet."""


class Moving(NamedTuple):
    """The areas that a film shows.

    Attributes
    ----------
    which : ndarray (m,)
        Numbers of the particles that stand for them.
    side : float
        Of an area before the slide, in m.
    aside : float
        How far the middle of an area lies from its particle before the slide, to the left and down, in m.
    covers : bool ndarray (n,)
        The particles that lie in one of them.
    """

    which: NDArray[np.intp]
    side: float
    aside: float
    covers: NDArray[np.bool_]


class Frame(NamedTuple):
    """Places (m,) in m, deformation gradients (m, 2, 2) and numbers of colours (m,) of the moving areas."""

    x: Array
    y: Array
    shape: Array
    level: NDArray[np.intp]


def moving_areas(ground: Ground, shots: list[Snapshot], section: Section) -> Moving:
    """Choose squares of one or more particles; each moves if the particle in or next to its middle does."""
    lattice, farthest = ground.lattice, np.max([shot.displacement for shot in shots], axis=0)
    moves = (farthest > ground.scene.slide.displaced) & (lattice.x < section.right)
    step = max(1, int(np.ceil(np.sqrt(np.count_nonzero(moves) / MOST))))
    i, j = (np.floor(at / section.side).astype(int) for at in (lattice.x, lattice.y))
    block = i // step * (j.max() + 1) + j // step
    which = np.flatnonzero(moves & (i % step == step // 2) & (j % step == step // 2))
    aside = (step // 2 + 0.5 - 0.5 * step) * section.side
    return Moving(which, step * section.side, aside, np.isin(block, block[which]))


def colour_limits(section: Section) -> Array:
    """Return the displacements in m, beyond that at which ground begins to move, from which on a colour is the next."""
    return SHARES * section.surface.height


def frame_of(ground: Ground, section: Section, moving: Moving, shot: Snapshot) -> Frame:
    """Return what the moving areas look like in a snapshot."""
    which, lattice = moving.which, ground.lattice
    x, y, far = shot.x[which], shot.y[which], shot.displacement[which] - ground.scene.slide.displaced
    ratio = shot.volume[which] / lattice.volume[which]
    shape = deformation_gradients((lattice.x[which], lattice.y[which]), (x, y), ratio, moving.side)
    middle = -moving.aside * shape.sum(axis=-1)
    return Frame(x + middle[:, 0], y + middle[:, 1], shape, np.searchsorted(colour_limits(section), far))
