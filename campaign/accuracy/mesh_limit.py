"""The mean run-out of a slide in the limit of small cells, from runs on some meshes and of cheaper models.

With cells of size h the expected run-out is M(h). The finest mesh and the next one tell M(h) and the change
c = M(h) - M(2 h) by the last halving. The limit of small cells is M(h) + j c: at order p of convergence
j = 1 / (2^p - 1), 1 at first order and 1/3 at second; where smaller cells undo a part of the change, as they do on
random fields, j is below 0. Meshes that do not converge steadily do not tell j, so the total interval joins those of
all j from -1 to 1: first order or better, or the last change undone at most.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.accuracy.field_control import controlled
from campaign.accuracy.nested import NestedMean, nested_mean
from campaign.statistics.intervals import Interval, Sample
from campaign.statistics.ridge import Matrix

OUTERMOST = (-1.0, 1.0)
"""The j between which the limit of small cells lies."""


class Runs(NamedTuple):
    """What realizations 0, 1, ... of a model gave.

    Attributes
    ----------
    runout : array (n,)
        In m: 0 without a slide, NaN without a result.
    slid : array (n,)
        1 of a slide, else 0.
    field : array (n, m)
        Linear functions of the random field with mean 0, each scaled to about the same scatter.
    cut_short : int
        Number of slides whose run-out is a lower bound.
    """

    runout: Sample
    slid: Sample
    field: Matrix
    cut_short: int = 0


class Sampled(NamedTuple):
    """The realizations of a model that count: those that failed in none of them.

    Attributes
    ----------
    runout, slid : array (n,)
        As in `Runs`.
    even_runout, even_slid : array (n,)
        The same means with less scatter, where the random field foretells a part of it.
    """

    runout: Sample
    slid: Sample
    even_runout: Sample
    even_slid: Sample

    def about(self, ratio: float, chance: float) -> tuple[Sample, Sample]:
        """Return z = (R - r S) / P of the realizations, as they are and with less scatter."""
        return (self.runout - ratio * self.slid) / chance, (self.even_runout - ratio * self.even_slid) / chance


class MeshLimit(NamedTuple):
    """The mean run-out of a slide, with intervals.

    Attributes
    ----------
    counted : Interval
        In m on the finest mesh; sampling error alone.
    change : Interval
        In m by the last halving of the cell.
    total : Interval
        In m about `counted`, for sampling and mesh.
    """

    counted: Interval
    change: Interval
    total: Interval

    @property
    def mesh(self) -> float:
        """Size in m of the mesh error: that of the change by the last halving."""
        return abs(self.change.estimate)

    @property
    def error(self) -> float:
        """The larger distance in m from the estimate to a bound of the total interval."""
        return max(self.total.estimate - self.total.lower, self.total.upper - self.total.estimate)


class LimitMeans(NamedTuple):
    """The mean run-out of a slide on the finest mesh, at the two outermost limits, and its change by the last halving.

    How well the outermost ones are known decides how many realizations it takes.
    """

    finest: NestedMean
    outermost: tuple[NestedMean, NestedMean]
    change: NestedMean

    def at(self, confidence: float) -> MeshLimit:
        """Return the intervals."""
        counted, change = self.finest.interval(confidence), self.change.interval(confidence)
        bounds = [counted, *(mean.interval(confidence) for mean in self.outermost)]
        lower, upper = min(each.lower for each in bounds), max(each.upper for each in bounds)
        return MeshLimit(counted, change, counted._replace(lower=max(0.0, lower), upper=upper))


def without_failures(models: Sequence[Runs]) -> list[Runs]:
    """Return some nested models without the realizations that failed in any of them."""
    failed = np.zeros(max(len(runs.runout) for runs in models), dtype=np.bool_)
    for runs in models:
        failed[: len(runs.runout)] |= np.isnan(runs.runout)
    return [_left(runs, ~failed[: len(runs.runout)]) for runs in models]


def _left(runs: Runs, is_kept: NDArray[np.bool_]) -> Runs:
    return runs._replace(runout=runs.runout[is_kept], slid=runs.slid[is_kept], field=runs.field[is_kept])


def sampled(models: Sequence[Runs]) -> list[Sampled]:
    """Return what counts of some nested models."""
    return [
        Sampled(runs.runout, runs.slid, controlled(runs.runout, runs.field), controlled(runs.slid, runs.field))
        for runs in without_failures(models)
    ]


def limit_means(models: Sequence[Sampled], chain: Sequence[int]) -> LimitMeans | None:
    """Estimate the means with a chain of the models, the first of them at its head; None where nothing slides.

    The second of the models has cells twice as large as the first, whether or not the chain holds it.
    """
    below, finest, above = (_at(models, chain, j) for j in (OUTERMOST[0], 0.0, OUTERMOST[1]))
    if below is None or finest is None or above is None:
        return None
    return LimitMeans(finest.mean(), (below.mean(), above.mean()), above.minus(finest).mean())


@dataclass(frozen=True)
class _Limit:
    """The mean run-out of a slide at one of the limits, as a ratio of two means.

    With r the ratio of the mean run-out (zero without a slide) to the probability P of sliding, its error is that of
    the mean of z = (R - r S) / P, which is zero (delta method).
    """

    ratio: float
    columns: Sequence[Sample]  # z of each model of a chain
    even: Sample  # the same of the cheapest, with less scatter

    def minus(self, other: "_Limit") -> "_Limit":
        """Return by how much it is above another of the same chain."""
        first, *cheaper = self.columns
        even = self.even if cheaper else self.even - other.even
        return _Limit(self.ratio - other.ratio, [first - other.columns[0], *cheaper], even)

    def mean(self) -> NestedMean:
        found = nested_mean(self.columns, self.even)
        return found._replace(estimate=self.ratio + found.estimate)


def _at(models: Sequence[Sampled], chain: Sequence[int], j: float) -> _Limit | None:
    runout, slid = (
        fine + j * (fine - coarse[: len(fine)]) for fine, coarse in zip(models[0][:2], models[1][:2], strict=True)
    )
    linked = [Sampled(runout, slid, runout, slid), *(models[each] for each in chain[1:])]
    mean = nested_mean([each.runout for each in linked], linked[-1].even_runout).estimate
    chance = nested_mean([each.slid for each in linked], linked[-1].even_slid).estimate
    if not chance > 0.0:
        return None
    z = [each.about(mean / chance, chance) for each in linked]
    return _Limit(mean / chance, [own for own, _ in z], z[-1][1])
