"""From a ground surface to particles."""

import numpy as np

from solver.grid import whole_cells
from solver.particles import Particles, allocate_particles
from solver.surface import Surface


def fill_ground(surface: Surface, cell_size: float, particles_per_cell: int, density: float) -> Particles:
    """Return particles on a regular lattice whose centres lie strictly below the surface, sorted by cell.

    A particle stands for the lattice square around it, so an inclined surface is a staircase of half a spacing. The
    ground reaches to the wall of the grid, which is the next node beyond the end of the surface.
    """
    per_side = round(np.sqrt(particles_per_cell))
    spacing = cell_size / per_side
    columns = whole_cells(surface.width, cell_size) * per_side
    rows = int(np.ceil(surface.top / spacing))
    x = (np.arange(columns) + 0.5) * spacing
    y = (np.arange(rows) + 0.5) * spacing
    x, y = (lattice.ravel() for lattice in np.meshgrid(x, y))
    below = y < surface.height_at(x) - 1e-9
    x, y = x[below], y[below]
    order = np.lexsort((x // cell_size, y // cell_size))
    return allocate_particles(x[order], y[order], spacing**2, density)
