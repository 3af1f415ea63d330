"""Softening that does not depend on the cells: strength follows a non-local plastic strain.

Where strength falls with plastic strain the ground tears along bands as thin as the cells allow, one or two cells, and
the finer they are the less slip uses strength up. A rate in proportion to the cell mends that inside a band, but takes
softening away from ground that yields over many cells. Here the plastic strain that weakens a particle is an average

    d kappa(x) = int K(x - y) d eps_p(y) V(y) dy / int K(x - y) V(y) dy,    K = exp(-r^2 / 2 sigma^2)

over its neighbourhood (Bazant and Lin 1988, IJNME 26:1805; Galavi and Schweiger 2010, Int. J. Geomech. 10:30, without
their over-nonlocal term). The *internal length* ``l = sqrt(2 pi) sigma`` belongs to the soil. A slip ``u`` across a
band much thinner than ``l``, however thin, is ``eps_p = u delta(n) / sqrt(3)``, and weakens its middle by

    kappa = u / (sqrt(3) sqrt(2 pi) sigma) = u / (sqrt(3) l)

as if it were spread over a band of thickness ``l``. Where plastic strain is uniform ``kappa = eps_p``. So the same rate
is right in bands and in ground that deforms as a whole. Bands stay as thin as the cells (Jirasek and Rolshoven 2003,
Int. J. Eng. Sci. 41:1553), but force and dissipation no longer depend on how thin. Increments are averaged and
``kappa`` is carried by the particle, so ground that slides away remembers where it was weakened.

On the grid: particles are pooled in cells (``cells``), sums of volume and of volume times increment are
smoothed alike (``internal_length`` says how much), and their quotient is read back.
"""

from solver._jit import inlined, kernel
from solver.cells import average, clear, pool, read


@inlined
def add_shifted(target, target_start, source, source_start, count, weight):
    """Add ``weight`` times ``count`` entries of ``source`` (nodes,) to ``target`` (nodes,), from a start in each."""
    for i in range(count):
        target[target_start + i] += weight * source[source_start + i]


@inlined
def smooth(sums, scratch, grid):
    """Convolve sums over cells with the filter along both axes, in place; beyond the grid there is nothing."""
    reach = grid.smoothing.size // 2
    columns = grid.columns
    scratch[:] = 0.0
    for j in range(grid.rows):
        for k in range(-reach, reach + 1):
            to, start = max(0, -k), max(0, k)
            add_shifted(
                scratch, j * columns + to, sums, j * columns + start, columns - to - start, grid.smoothing[k + reach]
            )
    sums[:] = 0.0
    for j in range(grid.rows):
        for k in range(max(-reach, -j), min(reach, grid.rows - 1 - j) + 1):
            add_shifted(sums, j * columns, scratch, (j + k) * columns, columns, grid.smoothing[k + reach])


@kernel
def average_plastic_strain(particles, grid, before):
    """Replace the increments of plastic strain since ``before`` (n,) by their average over the internal length."""
    clear(grid.cell_plastic_strain, grid)
    for p in range(particles.x.size):
        increment = particles.plastic_strain[p] - before[p]
        pool(grid.cell_plastic_strain, increment, particles.volume[p], particles.x[p], particles.y[p], grid)
    smooth(grid.cell_volume, grid.cell_scratch, grid)
    smooth(grid.cell_plastic_strain, grid.cell_scratch, grid)
    average(grid.cell_plastic_strain, 0.0, grid)
    for p in range(particles.x.size):
        particles.plastic_strain[p] = before[p] + read(grid.cell_plastic_strain, particles.x[p], particles.y[p], grid)
