"""Means over cells: particles pool a value in the cells that their domains overlap, and read the means back.

    value_c = sum_p w_cp V_p value_p / sum_p w_cp V_p,   read back as sum_c w_cp value_c

``w_cp`` is the share of the particle's domain that lies in cell ``c``, so a particle changes cells as gently as its
weights do. The arrays of cells are numbered like the nodes: a cell has the number of its lower left corner.
"""

from solver._jit import inlined


@inlined
def overlap(x, grid):
    """Return the first cell that a particle's domain touches along one axis, and the share that lies in the next."""
    xi = (x - grid.origin) / grid.cell_size
    first = int(xi - grid.half_length)
    beyond = xi + grid.half_length - (first + 1)
    return first, min(1.0, max(0.0, beyond / (2.0 * grid.half_length)))


@inlined
def clear(sums, grid):
    """Empty sums over cells ``(nodes,)`` and the volumes that they are weighted with, before particles are pooled."""
    sums[:] = 0.0
    grid.cell_volume[:] = 0.0


@inlined
def pool(sums, value, volume, x, y, grid):
    """Add ``w_cp V_p value_p`` of one particle to ``sums`` ``(nodes,)``, and ``w_cp V_p`` to the volumes of the cells.

    Parameters
    ----------
    sums : ndarray (nodes,)
        Modified, like ``grid.cell_volume``.
    value, volume : float
        Of the particle; its volume in m2.
    x, y : float
        Its place in m.
    grid : Grid
    """
    i, right = overlap(x, grid)
    j, upper = overlap(y, grid)
    cell = j * grid.columns + i
    _add(sums, volume * value, cell, right, upper, grid.columns)
    _add(grid.cell_volume, volume, cell, right, upper, grid.columns)


@inlined
def _add(sums, value, cell, right, upper, columns):
    """Add to ``sums`` (nodes,) a ``value``, shared among four cells of which ``cell`` is the lower left."""
    sums[cell] += (1.0 - right) * (1.0 - upper) * value
    sums[cell + 1] += right * (1.0 - upper) * value
    sums[cell + columns] += (1.0 - right) * upper * value
    sums[cell + columns + 1] += right * upper * value


@inlined
def average(sums, least, grid):
    """Turn sums over cells ``(nodes,)`` into means, in place; 0 where the volume is not above ``least`` (m2)."""
    for c in range(sums.size):
        volume = grid.cell_volume[c]
        sums[c] = sums[c] / volume if volume > least else 0.0


@inlined
def read(means, x, y, grid):
    """Return ``sum_c w_cp mean_c`` of ``means`` (nodes,) for a particle at ``x``, ``y`` (m)."""
    i, right = overlap(x, grid)
    j, upper = overlap(y, grid)
    cell = j * grid.columns + i
    below = (1.0 - right) * means[cell] + right * means[cell + 1]
    above = (1.0 - right) * means[cell + grid.columns] + right * means[cell + grid.columns + 1]
    return (1.0 - upper) * below + upper * above
