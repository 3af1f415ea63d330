"""The size of a particle's domain: what a scene alone decides, without a kernel."""

from solver.grid import particle_spacing
from solver.method import Basis

HALF_LENGTH_IN_CELLS = {
    "linear": 1e-6,  # the hat function to 1e-6, without a case of its own
    "bspline": 0.5,
}


def half_length_in_cells(basis: Basis, particles_per_cell: int) -> float:
    """Return the half length of a particle's domain over the cell size.

    Parameters
    ----------
    basis : {"linear", "gimp", "bspline"}
    particles_per_cell : int
        A square number; uGIMP particles tile the cell, so ``l_p = h / (2 sqrt(particles_per_cell))``.
    """
    return HALF_LENGTH_IN_CELLS.get(basis, 0.5 * particle_spacing(1.0, particles_per_cell))
