"""How much cells smooth plastic strain so that bands weaken over the internal length ``l = sqrt(2 pi) sigma``.

Three variances add up to ``sigma^2`` (``nonlocal_softening``). Pooling particles in cells and reading the cells back
has about ``2 (h^2 / 12 + l_p^2 / 3)``: a particle's share of a cell is the convolution of two boxes, ``h`` and ``2
l_p`` wide. A band is no ``delta``: across the grid it is 2.1 cells thick by itself, from the force that shears a ring
of ground (``tests/verification/test_softening_ring.py``: 2.11 cells with local softening, and 2.0 to 2.6 with this).
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


def rate_on_cells(
    rate: float,
    cell_size: float,
    half_length: float,
    internal_length: float = 0.0,
    reference_cell: float | None = None,
) -> float:
    """Return the softening rate that cells of this size need, per unit plastic strain.

    Parameters
    ----------
    rate : float
        Where it is known: for bands over the internal length, or on cells of ``reference_cell``.
    cell_size : float
        In m.
    half_length : float
        Of a particle's domain, in cells.
    internal_length : float
        In m; with one the rate is raised only on cells too coarse for it. 0: softening is local.
    reference_cell : float, optional
        In m; local bands are as thin as the cells, so their rate goes with the cell. None: the rate is as it is.
    """
    local = rate if reference_cell is None else rate * cell_size / reference_cell
    return local * coarse_rate_factor(internal_length, cell_size, half_length)


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
