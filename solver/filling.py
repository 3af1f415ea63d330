"""From a ground surface to particles.

The ground reaches to the wall of the grid, which is the next node beyond the end of the surface. Its particles stand in
the middle of the squares of a lattice. Of those that the surface cuts, either the whole square is a particle if its
centre is below, so that an inclined surface is a staircase and jumps by a particle as it moves; or the particles have
the area that is drawn, so that the ground weighs what it should (``squares``). They stand in the middle of their
squares all the same: at the centroids of what is cut they ring, and a brittle slope near its limit needs up to 8 % more
cohesion to stand, on cells of a ninth of its height.
"""

import numpy as np

from solver.grid import particle_spacing, whole_cells
from solver.model import Model
from solver.particles import Particles, allocate_particles, assign_material
from solver.squares import filled_squares
from solver.surface import Surface


def fill_ground(surface: Surface, cell_size: float, particles_per_cell: int, density: float) -> Particles:
    """Return whole squares whose centres lie strictly below the surface, sorted by cell.

    ``cell_size`` is in m and ``density`` in kg/m3; ``particles_per_cell`` is a square number.
    """
    spacing = particle_spacing(cell_size, particles_per_cell)
    columns, rows = _columns(surface, cell_size, spacing), int(np.ceil(surface.top / spacing))
    x = (np.arange(columns) + 0.5) * spacing
    y = (np.arange(rows) + 0.5) * spacing
    x, y = (lattice.ravel() for lattice in np.meshgrid(x, y))
    below = y < surface.height_at(x) - 1e-9
    x, y = x[below], y[below]
    order = _by_cell(x, y, cell_size)
    return allocate_particles(x[order], y[order], spacing**2, density)


def fill_to_surface(surface: Surface, cell_size: float, particles_per_cell: int, density: float) -> Particles:
    """Return particles with the area below the surface, sorted by cell; arguments are those of ``fill_ground``."""
    spacing = particle_spacing(cell_size, particles_per_cell)
    squares = filled_squares(surface, spacing, _columns(surface, cell_size, spacing))
    x, y = (squares.column + 0.5) * spacing, (squares.row + 0.5) * spacing
    order = _by_cell(x, y, cell_size)
    particles = allocate_particles(x[order], y[order], 1.0, density)
    return particles._replace(volume=squares.area[order], mass=density * squares.area[order])


def _columns(surface: Surface, cell_size: float, spacing: float) -> int:
    return whole_cells(surface.width, cell_size) * round(cell_size / spacing)


def _by_cell(x: np.ndarray, y: np.ndarray, cell_size: float) -> np.ndarray:
    order: np.ndarray = np.lexsort((x, y, x // cell_size, y // cell_size))
    return order


def ground_of(model: Model) -> Particles:
    """Return the particles of a model before anything moves, each of the material of its layer, moist or saturated."""
    fill = fill_to_surface if model.filling == "cut" else fill_ground
    ground = fill(model.surface, model.cell_size, model.particles_per_cell, model.materials[0].density)
    for number, top in enumerate(model.interfaces, start=1):
        assign_material(ground, ground.y < top.height_at(ground.x), number, model.materials[number].density)
    is_wet = ground.y < model.water.height_at(ground.x)
    densities = np.array([material.density_under_water for material in model.materials])
    ground.mass[is_wet] = (densities[ground.material] * ground.volume)[is_wet]
    return ground
