"""The mean run-out with all of its error that a campaign can measure: sampling and discretisation."""

import math

from campaign.statistics.discretisation import Discretisation
from campaign.statistics.intervals import Interval

TOTAL = (
    "centre: mean with the cell plus mean change c with half the cell; half-width: sqrt(a^2 + b^2) + |c|, where a and "
    "b are the half-widths of mean and c from sampling, and |c| stands for what still smaller cells change; without "
    "pairs of run-outs, the mean and its sampling error alone"
)


def total_interval(mean: Interval, found: Discretisation | None) -> Interval:
    """Return a run-out, the mean or a quantile, with one interval for sampling and mesh.

    With cells of size h the expected run-out is M(h). The counted mean estimates M(h) within a; the mean change c in a
    few realizations repeated with half the cell estimates M(h/2) - M(h) within b. So mean + c estimates M(h/2), and
    because a and b are independent, but for the few realizations that both share, within sqrt(a^2 + b^2).

    What is left is M(0) - M(h/2). At order p of convergence that is c / (2^p - 1): c itself at first order, so that the
    limit lies at mean + 2 c; a third of c at second. Two meshes do not tell the order, nor whether the approach is from
    one side, so |c| is added on either side. Measured with 4 pairs, 95 % intervals hold the limit in 96 % of the
    campaigns or more from order 1.5 on, and in 91 to 96 % at first order, where an error of c counts twice.

    Parameters
    ----------
    mean : Interval
        Counted with the scene's own cell, in m. A quantile is assumed to change with the mesh as the mean does; its
        arms, from the estimate to either bound, may differ.
    found : Discretisation or None
        What half the cell changes.

    Returns
    -------
    Interval
        In m, never below zero. `mean` as it is where there are fewer than two pairs: sampling error alone.
    """
    if found is None or not has_mesh_error(found):
        return mean
    change = found.interval
    centre = mean.estimate + change.estimate
    below, above = (
        math.hypot(arm, change.half_width) + abs(change.estimate)
        for arm in (mean.estimate - mean.lower, mean.upper - mean.estimate)
    )
    lower = centre - below
    return Interval(centre, 0.0 if lower < 0.0 else lower, centre + above, mean.n)


def has_mesh_error(found: Discretisation | None) -> bool:
    """Whether there are enough pairs of run-outs to tell what the mesh does to their mean."""
    return found is not None and found.interval.is_known
