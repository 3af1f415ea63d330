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

On the grid: particles are pooled in cells (``mean_dilation``), sums of volume and of volume times increment are
smoothed alike, and their quotient is read back. Three variances add up to ``sigma^2``. Pooling and reading have about
``2 (h^2 / 12 + l_p^2 / 3)`` (a particle's share of a cell is the convolution of two boxes, ``h`` and ``2 l_p`` wide).
A band is no ``delta``: across the grid it is 2.1 cells thick by itself, from the force that shears a ring of ground
(``tests/verification/test_softening_ring.py``: 2.11 cells with local softening, and 2.0 to 2.6 with this).
The smoothing supplies the rest. Cells too coarse for that, ``h > l / 2.4``, smooth nothing, and the rate is raised in
proportion to the thickness. There the law is local softening with its rate scaled by the cell; on finer cells it no
longer depends on them.

Without the band's own thickness in the sum coarse cells soften too little: along the base of a slide
``int kappa dn / max(kappa)`` was 1.53 m and 1.27 m for ``l = 1 m`` in cells of 0.5 m and 0.25 m, and run-out grew by
a quarter from cells of 1 m to 0.25 m. Only a band that keeps to one row of cells, as in a strip sheared along the grid,
is thinner than the sum allows for.
"""

import math

import numpy as np

from solver._jit import kernel, law
from solver.mean_dilation import pool, read

BAND_THICKNESS = 2.1  # cells, of a band of local plastic strain that crosses the grid
_MOST_TO_NEIGHBOURS = 0.25  # of one pass of the filter: it takes out the shortest wave and turns none over


def pooling_variance(half_length: float) -> float:
    """Return the variance, in cells squared, that pooling and reading have, for a half length in cells."""
    return 2.0 * (1.0 / 12.0 + half_length**2 / 3.0)


def least_thickness(half_length: float) -> float:
    """Return the thickness, in cells, over which a band weakens if nothing is smoothed: ``sqrt(2 pi)`` deviations."""
    return math.hypot(math.sqrt(2.0 * math.pi * pooling_variance(half_length)), BAND_THICKNESS)


def coarse_rate_factor(internal_length: float, cell_size: float, half_length: float) -> float:
    """Return what the rate is multiplied by because bands are thicker than the internal length: at least 1."""
    thickness = least_thickness(half_length) * cell_size
    return max(1.0, thickness / internal_length) if internal_length > 0.0 else 1.0


def smoothing_weights(internal_length: float, cell_size: float, half_length: float) -> np.ndarray:
    """Return the weights (2k + 1,) of the filter along one axis that makes up the variance ``l^2 / 2 pi``.

    They are the ``n``-fold convolution of ``(a, 1 - 2a, a)``, whose variance ``2 a n`` takes any value.

    Parameters
    ----------
    internal_length, cell_size : float
        In m; an internal length of 0 smooths nothing.
    half_length : float
        Of a particle's domain, in cells.
    """
    thickness = internal_length / cell_size
    variance = (thickness**2 - least_thickness(half_length) ** 2) / (2.0 * math.pi)
    passes = max(0, math.ceil(variance / (2.0 * _MOST_TO_NEIGHBOURS)))
    weights = np.ones(1)
    for _ in range(passes):
        share = variance / (2.0 * passes)
        weights = np.convolve(weights, [share, 1.0 - 2.0 * share, share])
    return weights


@law
def add_shifted(target, target_start, source, source_start, count, weight):
    """Add ``weight`` times ``count`` entries of ``source`` to ``target``."""
    for i in range(count):
        target[target_start + i] += weight * source[source_start + i]


@law
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
    grid.cell_volume[:] = 0.0
    grid.cell_plastic_strain[:] = 0.0
    for p in range(particles.x.size):
        volume = particles.volume[p]
        increment = particles.plastic_strain[p] - before[p]
        pool(grid.cell_volume, volume, particles.x[p], particles.y[p], grid)
        pool(grid.cell_plastic_strain, volume * increment, particles.x[p], particles.y[p], grid)
    smooth(grid.cell_volume, grid.cell_scratch, grid)
    smooth(grid.cell_plastic_strain, grid.cell_scratch, grid)
    for c in range(grid.cell_volume.size):
        volume = grid.cell_volume[c]
        grid.cell_plastic_strain[c] = grid.cell_plastic_strain[c] / volume if volume > 0.0 else 0.0
    for p in range(particles.x.size):
        particles.plastic_strain[p] = before[p] + read(grid.cell_plastic_strain, particles.x[p], particles.y[p], grid)
