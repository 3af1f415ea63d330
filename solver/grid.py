"""The background grid: square cells, nodes numbered row by row, walls on node lines."""

from typing import NamedTuple

import numpy as np

from solver.constants import LANE_COUNT
from solver.memory import aligned_zeros
from solver.water import NO_LAKE

PADDING = 2  # layers of nodes beyond a wall: GIMP weights reach one, a particle pressed into the wall a second
SCALARS = ("mass", "overburden", "cell_volume", "cell_dilation", "cell_pressure", "cell_plastic_strain")
VECTORS = ("momentum", "force", "acceleration", "velocity", "remapped")
NO_SMOOTHING = np.ones(1)
SMALLEST_MASS = 1e-12  # kg/m: below it a node carries nothing and 0/0 is avoided


class Grid(NamedTuple):
    """Nodes of a rectangular grid whose lower left wall corner is the origin of coordinates.

    Nodes are numbered row by row. Rows are padded to whole vectors (``lanes``, ``tiles``); nodes of the padding are
    never touched.
    """

    cell_size: float  # m
    half_length: float  # l_p / h, of the basis functions
    origin: float  # m, both coordinates of node 0
    columns: int  # of a row with its padding
    rows: int
    base_columns: int  # where the 3 x 3 nodes of a particle may begin
    width: float  # m, between the side walls
    height: float  # m, of the space particles may occupy
    free_x: np.ndarray  # (rows, columns) 1 where the node may move horizontally, 0 at the sides and the base
    free_y: np.ndarray  # (rows, columns) 1 where the node may move vertically, 0 at the base
    has_water: bool  # so that pore pressures are found
    lake: np.ndarray  # (4,) standing water, see ``standing_water``
    mass: np.ndarray  # (rows, columns) kg/m
    momentum: np.ndarray  # (rows, 2, columns) kg/s, of the particles as they are
    force: np.ndarray  # (rows, 2, columns) N/m, internal
    overburden: np.ndarray  # (rows, columns) Pa, weight of the ground above a node, where there is water
    acceleration: np.ndarray  # (rows, 2, columns) m/s2
    velocity: np.ndarray  # (rows, 2, columns) m/s, at the end of the step
    remapped: np.ndarray  # (rows, 2, columns) momentum (kg/s), then velocity (m/s), of the updated particles
    cell_volume: np.ndarray  # (rows, columns) m2; a cell has the number of its lower left node, see ``cells``
    cell_dilation: np.ndarray  # (rows, columns) mean increment of the volume strain
    cell_pressure: np.ndarray  # (rows, columns) Pa, mean of (s_xx + s_yy) / 2
    cell_plastic_strain: np.ndarray  # (rows, columns) averaged increment, see ``nonlocal_softening``
    smoothing: np.ndarray  # (2k + 1,) weights of the average over cells, along one axis


def whole_cells(length: float, cell_size: float) -> int:
    """Return how many cells cover ``length`` (m)."""
    return int(np.ceil(length / cell_size - 1e-9))


def particle_spacing(cell_size: float, particles_per_cell: int) -> float:
    """Return the distance in m between the particles of a lattice that fills square cells."""
    return float(cell_size / np.sqrt(particles_per_cell))


def allocate_grid(
    width: float,
    height: float,
    cell_size: float,
    half_length: float,
    smoothing: np.ndarray = NO_SMOOTHING,
    has_water: bool = False,
    lake: np.ndarray = NO_LAKE,
) -> Grid:
    """Return a grid for material between ``0 <= x <= width`` and ``0 <= y <= height``.

    Parameters
    ----------
    width, height : float
        Size of the space in m; rounded up to whole cells.
    cell_size : float
        Node spacing in m.
    half_length : float
        Half length of a particle's domain over the cell size (see ``basis``).
    smoothing : ndarray (2k + 1,)
        Weights of the average of plastic strain (see ``nonlocal_softening``).
    has_water : bool
        Whether particles have pore pressures.
    lake : ndarray (4,)
        Standing water (see ``standing_water``).
    """
    cells_x = whole_cells(width, cell_size)
    cells_y = whole_cells(height, cell_size)
    base_columns = cells_x + 1 + 2 * PADDING - 2
    columns = LANE_COUNT * (-(-base_columns // LANE_COUNT) + 1)
    rows = cells_y + 1 + 2 * PADDING
    i = np.arange(columns) - PADDING
    j = np.arange(rows) - PADDING
    above_base = np.broadcast_to((j > 0)[:, None], (rows, columns))
    between_sides = np.broadcast_to((i > 0) & (i < cells_x), (rows, columns))
    return Grid(
        cell_size=float(cell_size),
        half_length=float(half_length),
        origin=-PADDING * float(cell_size),
        columns=columns,
        rows=rows,
        base_columns=base_columns,
        width=cells_x * float(cell_size),
        height=cells_y * float(cell_size),
        free_x=(above_base & between_sides).astype(float),
        free_y=above_base.astype(float),
        has_water=has_water,
        lake=lake.copy(),
        smoothing=smoothing,
        **{name: aligned_zeros((rows, columns)) for name in SCALARS},
        **{name: aligned_zeros((rows, 2, columns)) for name in VECTORS},
    )
