"""The mean run-out with all of its error that a campaign can measure: sampling and discretisation."""

import math

from campaign.statistics.discretisation import Discretisation
from campaign.statistics.intervals import Interval

FARTHEST = 2.0
"""How many times the change with half the cell smaller cells may change the run-out: 2 is first order."""

TOTAL = (
    "estimate: mean as counted with the cell; interval: from where the mean itself may lie to where the mean plus 2 c "
    "may lie, with c the mean change with half the cell, the limit of small cells at first order. It holds the limits "
    "at any order of convergence of one or more, and those where smaller cells undo a part of the change. Half-widths: "
    "a of the mean, sqrt(a^2 + 4 b^2) of the mean plus 2 c, where b is that of c. Without pairs of run-outs, the mean "
    "and its sampling error alone. Slides that the wall ahead or the end of the run has cut short count with the "
    "distance they came: where they are more than a few, the upper bound is infinite"
)


def total_interval(mean: Interval, found: Discretisation | None) -> Interval:
    """Return a run-out, the mean or a quantile, with one interval for sampling and mesh.

    With cells of size h the expected run-out is M(h). The counted mean estimates M(h) within a; the mean change c in a
    few realizations repeated with half the cell estimates M(h/2) - M(h) within b. The limit of small cells is
    M(0) = M(h) + k (M(h/2) - M(h)): at order p of convergence k = 2^p / (2^p - 1), from 2 at first order over 4/3 at
    second to 1 where half the cell is fine enough. Two meshes do not tell k. Still smaller cells may also undo a part
    of the change, as they do on random fields here (-0.9 m, then +0.2 m); then k is below 1.

    If k were known, the limit would lie within mean + k c +- sqrt(a^2 + (k b)^2), because a and b are independent but
    for the few realizations that both share. The total interval joins these for all k from 0 to 2. The root is convex
    in k, so that the outermost bounds are those of k = 0 or k = 2. Where c is far larger than its error, one bound of
    either end alone can fail the limit, at half the probability: at least 95 % become 97.5 %.

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
        In m, never below zero, about the estimate as counted. `mean` as it is where there are fewer than two pairs:
        sampling error alone.
    """
    if found is None or not has_mesh_error(found):
        return mean
    change = found.interval
    limit = mean.estimate + FARTHEST * change.estimate
    below, above = (
        math.hypot(arm, FARTHEST * change.half_width)
        for arm in (mean.estimate - mean.lower, mean.upper - mean.estimate)
    )
    lower, upper = min(mean.lower, limit - below), max(mean.upper, limit + above)
    return Interval(mean.estimate, 0.0 if lower < 0.0 else lower, upper, mean.n, mean.is_least)


def total_mean(mean: Interval, found: Discretisation | None, is_bounded: bool) -> Interval:
    """Return the mean run-out with its total interval; infinite above unless bounded, as where many were cut short.

    Whatever slides were cut short, the mean of what they came is no more than that of what they would have come, and so
    is the lower bound.
    """
    total = total_interval(mean, found)
    return total if is_bounded else total._replace(upper=math.inf, is_least=True)


def has_mesh_error(found: Discretisation | None) -> bool:
    """Whether there are enough pairs of run-outs to tell what the mesh does to their mean."""
    return found is not None and found.interval.is_known
