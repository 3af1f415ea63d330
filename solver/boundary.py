"""Nodal conditions: the base is fixed, the sides are rollers, and so is every node beyond them."""

from solver._jit import inlined


@inlined
def constrain(vectors, grid):
    """Cancel the constrained components of a nodal vector field ``(nodes, 2)``, in place."""
    for i in range(vectors.shape[0]):
        vectors[i, 0] *= grid.free_x[i]
        vectors[i, 1] *= grid.free_y[i]
