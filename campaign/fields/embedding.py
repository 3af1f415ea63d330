"""How large the periodic grid of a circulant embedding is, without building it."""

from campaign.fields.correlation import Correlation

PERIODS = {
    "exponential": (3.5, 20.0),
    "squared-exponential": (9.5, 12.0),
    "turned": (9.5, 20.0),
    "matern-3/2": (9.5, 20.0),
    "matern-5/2": (9.5, 20.0),
    "spherical": (3.5, 5.5),
    "cosine-exponential": (3.5, 25.0),
}
"""Least and largest period over the reach of the correlation at which circulant embedding was exact, over grids of 15
to 120 cells and distances of 2 to 1000 cells. Along the axes the separable exponential needs no more than the grid."""


def circulant_bytes(
    correlation: Correlation, shape: tuple[int, int], spacing: tuple[float, float]
) -> tuple[float, float]:
    """Return bounds of the memory [bytes] of a circulant embedding, 64 bytes for each point of the periodic grid.

    Parameters
    ----------
    correlation : Correlation
    shape : tuple of int
        Rows and columns of the grid.
    spacing : tuple of float
        Distance of its rows, and of its columns [m].
    """
    kind = "turned" if correlation.kind == "separable-exponential" else correlation.kind
    periods = (0.0, 0.0) if correlation.is_separable and kind == "turned" else PERIODS[kind]
    reach_x, reach_y = correlation.reach
    rows, columns = shape

    def n_bytes(period: float) -> float:
        """Return the memory of a periodic grid that is so many times the reach long, and twice the grid or more."""
        return (
            64.0
            * max(2.0 * rows - 1.0, period * reach_y / spacing[0])
            * max(2.0 * columns - 1.0, period * reach_x / spacing[1])
        )

    return n_bytes(periods[0]), n_bytes(periods[1])
