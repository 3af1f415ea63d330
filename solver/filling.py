"""From a ground surface to particles."""

import numpy as np

from solver.grid import particle_spacing, whole_cells
from solver.model import Model
from solver.particles import Particles, allocate_particles, assign_material
from solver.surface import Surface


def fill_ground(surface: Surface, cell_size: float, particles_per_cell: int, density: float) -> Particles:
    """Return particles on a regular lattice whose centres lie strictly below the surface, sorted by cell.

    ``cell_size`` is in m and ``density`` in kg/m3; ``particles_per_cell`` is a square number.
    A particle stands for the lattice square around it, so an inclined surface is a staircase of half a spacing. The
    ground reaches to the wall of the grid, which is the next node beyond the end of the surface.
    """
    spacing = particle_spacing(cell_size, particles_per_cell)
    per_side = round(cell_size / spacing)
    columns = whole_cells(surface.width, cell_size) * per_side
    rows = int(np.ceil(surface.top / spacing))
    x = (np.arange(columns) + 0.5) * spacing
    y = (np.arange(rows) + 0.5) * spacing
    x, y = (lattice.ravel() for lattice in np.meshgrid(x, y))
    below = y < surface.height_at(x) - 1e-9
    x, y = x[below], y[below]
    order = np.lexsort((x // cell_size, y // cell_size))
    return allocate_particles(x[order], y[order], spacing**2, density)


def ground_of(model: Model) -> Particles:
    """Return the particles of a model on their lattice, each of the material of its layer, moist or saturated."""
    ground = fill_ground(model.surface, model.cell_size, model.particles_per_cell, model.materials[0].density)
    for number, top in enumerate(model.interfaces, start=1):
        assign_material(ground, ground.y < top.height_at(ground.x), number, model.materials[number].density)
    is_wet = ground.y < model.water.height_at(ground.x)
    densities = np.array([material.density_under_water for material in model.materials])
    ground.mass[is_wet] = (densities[ground.material] * ground.volume)[is_wet]
    return ground
