"""How far slides run on the finest mesh, as a distribution, from few runs of it and many of cheaper models.

What a model has not run is foretold from the next cheaper one that has. A slide gets the run-out of the regression
between the two models, on the realizations that slide in both, and in addition what that regression leaves of a
realization drawn at random from those (imputation by stochastic regression; Little and Rubin 2019, chapter 4). If the
realization that is drawn stands in the one model and slides in the other, so does the one that is foretold. From model
to model that leads to as many run-outs on the finest mesh as the cheapest model has run, of which probabilities and
quantiles are counted.

The intervals are percentiles of the same with realizations drawn anew, as many as each model has run (bootstrap, Efron
1979). What is foretold is never known better than if it had been run: an interval reaches at least as far as that of so
many plain runs. For the mesh they are joined with those of the two outermost limits of small cells, as for the mean
(``mesh_limit``), to which each run on the finest mesh is taken by what it differs from the same one on the next mesh.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.accuracy.mesh_limit import OUTERMOST, Runs, without_failures
from campaign.seeds import Stream, generator
from campaign.statistics.intervals import Interval, Sample, quantile_interval
from campaign.statistics.outcomes import FEW
from campaign.statistics.proportions import exact_interval

REDRAWN, DRAWN = 400, 100
"""Times that realizations are drawn anew, whose percentiles scatter by a tenth of an interval then; and times that what
the regressions leave is drawn for the realizations as they are."""

FEWEST = 4
"""Slides in two models from which on the one is foretold from the other."""

Outcomes = NDArray[np.float64]
"""Run-outs in m, NaN of what stands."""


class Estimate(NamedTuple):
    """With its interval for sampling, and that for sampling and mesh."""

    sampling: Interval
    total: Interval

    def up_to(self, uppers: Iterable[float]) -> "Estimate":
        """Return it as at least so much, with other upper bounds."""
        return Estimate(*(each._replace(upper=upper, is_least=True) for each, upper in zip(self, uppers, strict=True)))


class Foretold:
    """The distribution of run-outs on the finest mesh.

    Parameters
    ----------
    models
        Nested, from the finest mesh over the next one to the cheapest.
    confidence
        Of all intervals.
    rng
        Draws realizations and what regressions leave.
    cut_short
        Share of the slides, at most, that may have come farther than they did; it widens intervals upwards.
    """

    def __init__(
        self, models: Sequence[Runs], confidence: float, rng: np.random.Generator, cut_short: float = 0.0
    ) -> None:
        self._cut_short = cut_short
        columns = [np.where(each.slid > 0.0, each.runout, np.nan) for each in models]
        next_one = columns[1][: len(columns[0])]
        change = np.where(np.isfinite(next_one), columns[0] - next_one, 0.0)
        finest = {j: np.maximum(0.0, columns[0] + j * change) for j in (0.0, *OUTERMOST)}
        self._confidence = confidence
        self._known = _foretold([_Draw.of(columns, rng, redraws=False) for _ in range(DRAWN)], finest)
        self._redrawn = _foretold([_Draw.of(columns, rng, redraws=True) for _ in range(REDRAWN)], finest)

    @property
    def n(self) -> int:
        """Number of realizations that are known or foretold."""
        return len(self._known[0.0][0])

    def exceedance(self, distance: float) -> Estimate:
        """Return the probability of a run-out beyond a distance in m, where what stands has none."""

        def plain(outcomes: Outcomes) -> Interval:
            beyond = np.count_nonzero(outcomes > distance, axis=1).mean()
            return exact_interval(round(beyond), self.n, self._confidence)

        found = self._estimate(lambda outcomes: np.mean(outcomes > distance, axis=1), plain)
        if self._cut_short:
            found = found.up_to(min(1.0, each.upper + self._cut_short) for each in found)
        return found

    def quantile(self, share: float) -> Estimate:
        """Return the run-out in m within which a share of the slides stops."""
        found = self._quantile(share)
        if self._cut_short:
            found = found.up_to(each.upper for each in self._quantile(min(1.0, share + self._cut_short)))
        return found

    def _quantile(self, share: float) -> Estimate:
        def plain(outcomes: Outcomes) -> Interval:
            slides = outcomes[0][np.isfinite(outcomes[0])]
            return quantile_interval(slides, share, self._confidence)

        return self._estimate(lambda outcomes: _quantiles(outcomes, share), plain)

    def _estimate(self, statistic: Callable[[Outcomes], Sample], plain: Callable[[Outcomes], Interval]) -> Estimate:
        intervals = {j: self._interval(j, statistic, plain) for j in self._known}
        sampling = intervals[0.0]
        bounds = np.array([each[1:3] for each in intervals.values()])
        return Estimate(sampling, sampling._replace(lower=float(bounds[:, 0].min()), upper=float(bounds[:, 1].max())))

    def _interval(
        self, j: float, statistic: Callable[[Outcomes], Sample], plain: Callable[[Outcomes], Interval]
    ) -> Interval:
        estimate = float(np.nanmean(statistic(self._known[j])))
        tail = 50 * (1 - self._confidence)
        lower, upper = np.nanpercentile(statistic(self._redrawn[j]), [tail, 100 - tail])
        least = plain(self._known[j])
        # The middle of so many plain runs is that of a whole number of them; their interval is laid about the estimate.
        below, above = estimate - (least.estimate - least.lower), estimate + (least.upper - least.estimate)
        # Where plain runs know no bound, as of a 95 % quantile of fewer than 72 slides, none is known: NaN stays.
        return Interval(estimate, float(np.minimum(lower, below)), float(np.maximum(upper, above)), self.n)


def foretold(runs: Sequence[Runs], confidence: float, seed: int) -> Foretold | None:
    """Return the distribution on the finest mesh; None where many slides were cut short, or too few pair two models.

    Cheaper models that were cut short too often, or have run no more than a finer one, have no part in it.

    Arguments are those of `Foretold`, with the seed of a campaign.
    """
    runs = [each for k, each in enumerate(runs) if k < 2 or _share_cut_short(each) <= FEW]
    runs = [*runs[:2], *(each for finer, each in pairwise(runs[1:]) if len(each.runout) > len(finer.runout))]
    models = without_failures(runs)
    slid = [each.slid > 0.0 for each in models]
    pairs = (np.count_nonzero(fine & coarse[: len(fine)]) for fine, coarse in pairwise(slid))
    cut_short = max(map(_share_cut_short, runs))
    if cut_short > FEW or not all(count >= FEWEST for count in pairs):
        return None
    return Foretold(models, confidence, generator(seed, Stream.BOOTSTRAP, 0), cut_short)


def _quantiles(outcomes: Outcomes, share: float) -> Sample:
    """Return a quantile of the slides of each draw, NaN of one without a slide."""
    has_slides = np.isfinite(outcomes).any(axis=1)
    found = np.full(len(outcomes), np.nan)
    found[has_slides] = np.nanquantile(outcomes[has_slides], share, axis=1)
    return found


def _share_cut_short(runs: Runs) -> float:
    return runs.cut_short / max(1.0, float(np.sum(runs.slid)))


class _Draw(NamedTuple):
    """One draw: what is foretold of all realizations on the mesh next to the finest, and what decides the last step.

    Attributes
    ----------
    chosen : int array (n,)
        Realizations that the finest mesh has run.
    cheaper : array (N,)
        Outcomes of realizations on the next mesh, these first.
    donors : float array (N,)
        Which of those that a realization resembles gives it what the regression leaves, from 0 to 1.
    """

    chosen: NDArray[np.intp]
    cheaper: Outcomes
    donors: Sample

    @classmethod
    def of(cls, columns: Sequence[Outcomes], rng: np.random.Generator, redraws: bool) -> "_Draw":
        bounds = [0, *(len(each) for each in columns)]
        ranges = [rng.integers(a, b, b - a) if redraws else np.arange(a, b) for a, b in pairwise(bounds)]
        chosen = np.concatenate(ranges)
        drawn = [each[chosen[: len(each)]] for each in columns]
        cheaper = drawn[-1]
        for own in reversed(drawn[1:-1]):
            cheaper = np.concatenate([own, _foretell(own, cheaper, rng.random(len(cheaper)))])
        return cls(chosen[: len(columns[0])], cheaper, rng.random(len(cheaper)))


def _foretold(draws: Sequence[_Draw], finest: Mapping[float, Outcomes]) -> dict[float, Outcomes]:
    """Return outcomes on the finest mesh at each limit, (draw, realization)."""

    def row(draw: _Draw, own: Outcomes) -> Outcomes:
        return np.concatenate([own, _foretell(own, draw.cheaper, draw.donors)])

    return {j: np.array([row(draw, own[draw.chosen]) for draw in draws]) for j, own in finest.items()}


def _foretell(own: Outcomes, cheaper: Outcomes, donors: Sample) -> Outcomes:
    """Return outcomes of the realizations that a model has not run and a cheaper one has."""
    n = len(own)
    there, asked = cheaper[:n], cheaper[n:]
    both = np.isfinite(own) & np.isfinite(there)
    slope, offset = _line(there[both], own[both])
    count = int(np.count_nonzero(both))
    left = (own - (offset + slope * there)) * math.sqrt(count / max(1, count - 2))
    found = asked.copy()  # as in the cheaper model where none of those that both have run resembles it
    for slides in (True, False):
        alike, targets = np.flatnonzero(np.isfinite(there) == slides), np.isfinite(asked) == slides
        if alike.size:
            drawn = alike[(donors[n:][targets] * alike.size).astype(np.intp)]
            found[targets] = offset + slope * asked[targets] + left[drawn] if slides else own[drawn]
    return np.asarray(np.maximum(0.0, found))


def _line(x: Sample, y: Sample) -> tuple[float, float]:
    """Return slope and offset of the regression of y on x, a slope of one where x is the same everywhere."""
    if x.size == 0:
        return 1.0, 0.0
    deviations = x - np.mean(x)
    squares = float(deviations @ deviations)
    slope = float(deviations @ y) / squares if squares > 0.0 else 1.0
    return slope, float(np.mean(y) - slope * np.mean(x))
