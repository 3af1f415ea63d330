"""Runs of ever more models and realizations until the mean run-out is known as well as somebody asked.

The pursuit decides in rounds. Each round looks at all realizations that the one before asked for and at nothing else,
so that neither the ranks nor an interruption change what is run or what comes out.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

from campaign.accuracy.allocation import allocation
from campaign.accuracy.mesh_limit import MeshLimit, Runs, Sampled, limit_means, sampled
from campaign.accuracy.nested import FEWEST
from campaign.scene.constraints import Tolerance
from campaign.statistics.intervals import student_quantile

PILOT_OF_FINEST, PILOT = 12, 32
"""Realizations of the finest mesh, and of all other models, from which their scatter and correlation are judged."""

PILOT_OF_QUARTER = 8
"""Those of the finest mesh where each costs some sixty times as much as with the scene's own cells."""

GROWTH = 3
"""Most by which a round multiplies the realizations of a model: what the one before says of scatter may be wrong."""

MESH_SHARE = 0.7
"""Of the tolerance: where the mesh takes more of it, a finer one is cheaper than more realizations."""

STEP = 1.2
"""By which a round multiplies realizations that should have sufficed and did not."""

LEAST_SAMPLING = 0.5
"""Of the mesh error: where that alone is more than the tolerance, sampling need not be known better than this."""


class Model(NamedTuple):
    """A way to run a realization, and what one costs in s."""

    name: str
    cost: float


class Wanted(NamedTuple):
    """What somebody asked for: how far the total interval may reach from the mean, and with how many realizations.

    Attributes
    ----------
    tolerance : Tolerance
    confidence : float
    most : int
        Realizations of any model.
    """

    tolerance: Tolerance
    confidence: float
    most: int


class Pursuit(NamedTuple):
    """What came of it.

    Attributes
    ----------
    models : tuple of Model
        The last ladder.
    runs : tuple of Runs
        What each has run.
    limit : MeshLimit or None
        The answer; None where nothing slides.
    is_reached : bool
    """

    models: tuple[Model, ...]
    runs: tuple[Runs, ...]
    limit: MeshLimit | None
    is_reached: bool

    @property
    def counts(self) -> tuple[int, ...]:
        """Realizations that each model has run."""
        return tuple(len(each.runout) for each in self.runs)

    @property
    def cut_short(self) -> tuple[int, ...]:
        """Slides among them whose run-out is a lower bound."""
        return tuple(each.cut_short for each in self.runs)


Ladder = tuple[Model, ...]
"""Models from the finest mesh over the next one, with cells twice as large, to the cheapest."""

Compute = Callable[[Mapping[Model, int]], Mapping[Model, Runs]]
"""Has each model run so many realizations, and returns what exactly these gave."""


def pursue(ladders: Sequence[Ladder], wanted: Wanted, compute: Compute) -> Pursuit:
    """Run until the total error of the mean run-out is what was wanted, or cannot become it.

    Parameters
    ----------
    ladders
        Each has a finer mesh than the one before, and all of its models.
    wanted, compute
        What, and by whom.
    """
    counts: dict[Model, int] = {}
    runs: Mapping[Model, Runs] = {}
    for ladder, is_last in ((each, each is ladders[-1]) for each in ladders):
        pilot = (PILOT_OF_QUARTER if counts else PILOT_OF_FINEST, *(PILOT for _ in ladder[1:]))
        wished = tuple(max(counts.get(model, 0), count) for model, count in zip(ladder, pilot, strict=True))
        found = None
        while wished != tuple(map(counts.get, ladder)):
            counts |= dict(zip(ladder, wished, strict=True))
            runs = compute(counts)
            found = _look(ladder, wished, sampled([runs[model] for model in ladder]), wanted)
            if found is None or found.is_reached or (found.is_ruled_by_mesh and not is_last):
                break
            wished = found.wished
        if found is None or found.is_reached or not found.is_ruled_by_mesh:
            break
    is_reached = found is not None and found.is_reached
    return Pursuit(ladder, tuple(runs[model] for model in ladder), found and found.limit, is_reached)


class _Look(NamedTuple):
    """What the realizations of a round say, and how many there should be in the next one: as many if that is all."""

    limit: MeshLimit
    tolerance: float
    wished: tuple[int, ...]
    cost: float  # s, of what they have not run yet

    @property
    def is_reached(self) -> bool:
        return self.limit.error <= self.tolerance

    @property
    def is_ruled_by_mesh(self) -> bool:
        return self.limit.mesh > MESH_SHARE * self.tolerance


def _look(ladder: Ladder, done: tuple[int, ...], samples: Sequence[Sampled], wanted: Wanted) -> _Look | None:
    """Choose the models whose realizations give what was wanted at the least cost; None without slides or results."""
    if min(len(each.runout) for each in samples) < FEWEST:
        return None
    others = range(1, len(ladder))
    chains = ((0, *chosen) for size in range(len(ladder)) for chosen in combinations(others, size))
    nested = (chain for chain in chains if _is_sorted([done[each] for each in chain]))
    looks = (_look_with(chain, ladder, done, samples, wanted) for chain in nested)
    return min(filter(None, looks), key=lambda look: look.cost, default=None)


def _is_sorted(counts: list[int]) -> bool:
    return counts == sorted(counts)


def _look_with(
    chain: tuple[int, ...], ladder: Ladder, done: tuple[int, ...], samples: Sequence[Sampled], wanted: Wanted
) -> _Look | None:
    means = limit_means(samples, chain)
    if means is None:
        return None
    limit = means.at(wanted.confidence)
    tolerance = wanted.tolerance.metres(limit.counted.estimate)
    room = max(tolerance - limit.mesh, LEAST_SAMPLING * limit.mesh)
    counts = list(done)
    for mean in means.outermost:
        variance = (room / student_quantile(wanted.confidence, mean.degrees)) ** 2
        least, cost = [len(samples[each].runout) for each in chain], [ladder[each].cost for each in chain]
        for each, with_result, count in zip(chain, least, allocation(mean.scatter, cost, variance, least), strict=True):
            counts[each] = max(counts[each], math.ceil(count * done[each] / with_result))
    if limit.error > tolerance > limit.mesh and counts == list(done):  # the plan is for averages, and this was no luck
        counts = [math.ceil(STEP * count) if each in chain else count for each, count in enumerate(counts)]
    counts[1] = max(counts[1], counts[0])
    wished = tuple(
        min(count, GROWTH * before, max(wanted.most, before)) for count, before in zip(counts, done, strict=True)
    )
    cost_left = math.fsum(
        (count - before) * model.cost for count, before, model in zip(counts, done, ladder, strict=True)
    )
    return _Look(limit, tolerance, wished, cost_left)
