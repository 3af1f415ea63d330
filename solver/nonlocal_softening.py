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

import numpy as np

from solver._jit import allocating
from solver.constants import LANE_COUNT
from solver.lanes import load, store


@allocating
def smooth(sums, weights):
    """Convolve sums over cells with the filter along both axes, in place; beyond the grid there is nothing.

    Parameters
    ----------
    sums : ndarray (rows, columns)
    weights : ndarray (2k + 1,)
        Of the filter, symmetric.
    """
    rows, columns = sums.shape
    reach = weights.size // 2
    margin = np.zeros(columns + 2 * reach)
    along = np.empty_like(sums)
    for row in range(rows):
        for column in range(columns):
            margin[reach + column] = sums[row, column]
        for column in range(0, columns, LANE_COUNT):
            total = weights[0] * load(margin, column)
            for k in range(1, weights.size):
                total = total + weights[k] * load(margin, column + k)
            store(along, row * columns + column, total)
    for row in range(rows):
        low, high = max(row - reach, 0), min(row + reach, rows - 1)
        for column in range(0, columns, LANE_COUNT):
            total = weights[low - row + reach] * load(along, low * columns + column)
            for other in range(low + 1, high + 1):
                total = total + weights[other - row + reach] * load(along, other * columns + column)
            store(sums, row * columns + column, total)
