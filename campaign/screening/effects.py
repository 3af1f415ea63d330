"""What a choice changes, from the realizations that the scene and the changed one both have."""

import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.record import SLID, Status
from campaign.running.study import Outcome, directory_of
from campaign.scene import Scene
from campaign.scene.cost import particle_count, speed
from campaign.scene.wanted import wanted_accuracy
from campaign.screening.verdict import Effect
from campaign.statistics.intervals import Interval, Sample
from campaign.statistics.paired import (
    discordance_interval,
    mean_difference,
    proportion_difference,
    std_difference,
)
from campaign.statistics.tally import Tally
from campaign.storage.record_store import RecordStore

POINTS = 0.05
"""Change of a probability that does not matter."""


class Realizations(NamedTuple):
    """What became of realizations 0, 1, ... of a scene.

    Attributes
    ----------
    runouts : array (n,)
        In m; 0 without a slide, NaN without a result. Where the wall ahead was in the way it is a lower bound.
    has_slid : bool array (n,)
    is_spoiled : bool array (n,)
        Whether it has no result, or reached either wall.
    reaches : bool array (receptor, n)
        Whether the front reached it.
    seconds : float
        Core time of the time steps of one in s, as estimated from their number: other work on the machine has no part
        in it, nor has the random field, whose share is large in coarse cells.
    """

    runouts: Sample
    has_slid: NDArray[np.bool_]
    is_spoiled: NDArray[np.bool_]
    reaches: NDArray[np.bool_]
    seconds: float

    @property
    def mean(self) -> float:
        """Mean run-out in m, 0 without a slide."""
        return float(np.nanmean(self.runouts))

    @property
    def counts(self) -> NDArray[np.bool_]:
        """Which of them have a run-out, (n,)."""
        return np.isfinite(self.runouts)


def realizations_of(outcome: Outcome, tally: Tally, home: Path, count: int) -> Realizations:
    """Return what became of the first realizations of a variant that a study has run in `home`."""
    summaries, scene = [tally.summaries[k] for k in range(count)], outcome.scene
    runouts = np.array([each.runout(tally.front) for each in summaries])
    has_slid = np.array([each.status in SLID for each in summaries])
    at_wall = np.array([each.status is Status.reached_wall for each in summaries])
    steps, reaches = np.zeros(count), np.zeros((count, len(scene.receptor)), dtype=np.bool_)
    for columns in RecordStore(directory_of(home, outcome.changes), scene.digest()).columns(count):
        steps[columns.realizations] = columns.values["steps"]
        at_wall[columns.realizations] |= columns.values.get("reached_wall_behind", 0) == 1
        if scene.receptor:
            reaches[columns.realizations] = columns.values["front_reaches"] == 1.0
    counts = np.isfinite(runouts)
    taken = float(np.mean(steps[counts])) if counts.any() else math.nan
    seconds = taken * particle_count(scene) / speed(scene)
    return Realizations(runouts, has_slid, at_wall | ~counts, reaches.T, seconds)


def spoiled(own: Realizations, other: Realizations, confidence: float) -> Interval:
    """Return how much more probable a wall or a failure is without a choice."""
    return proportion_difference(own.is_spoiled, other.is_spoiled, confidence).interval


def effects_of(scene: Scene, own: Realizations, other: Realizations) -> list[Effect]:
    """Return what a choice changes in each number of the answer, from pairs that both have a run-out.

    Intervals are those of pairs, Student's t, the jackknife's and Tango's. They hold whatever pairs share; where that
    is nothing they are as wide as those of independent samples. A slide that was cut short counts as far as it came, as
    in a campaign's own numbers: compared is what campaigns would tell.
    """
    both, metres, confidence = own.counts & other.counts, wanted_accuracy(scene, own.mean), scene.campaign.confidence
    before, after = own.runouts[both], other.runouts[both]
    mean, std = mean_difference(before, after, confidence), std_difference(before, after, confidence)
    return [
        Effect("runout_mean", "mean run-out, 0 without a slide", "m", mean, metres, partial(_scaled, mean.interval)),
        Effect("runout_std", "standard deviation of run-out", "m", std, metres, partial(_scaled, std.interval)),
        *_probabilities(scene, own, other, both),
    ]


def _probabilities(scene: Scene, own: Realizations, other: Realizations, both: NDArray[np.bool_]) -> Iterator[Effect]:
    named = {"slide_probability": ("P(slide)", own.has_slid, other.has_slid)} | {
        f"front_reach_probability_{number}": (f"P(front reaches {receptor.name})", *reached)
        for number, (receptor, *reached) in enumerate(zip(scene.receptor, own.reaches, other.reaches, strict=True))
    }
    for variable, (words, before, after) in named.items():
        before, after = before[both], after[both]
        found = proportion_difference(before, after, scene.campaign.confidence)
        counts = int(np.count_nonzero(after & ~before)), int(np.count_nonzero(before & ~after)), len(before)
        yield Effect(variable, words, "1", found, POINTS, partial(_of_counts, *counts, scene.campaign.confidence))


def _scaled(interval: Interval, number: int) -> Interval:
    """Return the interval of a mean or a standard deviation from another number of realizations."""
    reach = interval.half_width * math.sqrt(interval.n / number)
    return Interval(interval.estimate, interval.estimate - reach, interval.estimate + reach, number)


def _of_counts(gained: int, lost: int, n: int, confidence: float, number: int) -> Interval:
    """Return the interval of a proportion from another number of realizations, of which as large a share changes."""
    if n == 0:
        return discordance_interval(0, 0, 0, confidence)
    return discordance_interval(round(gained * number / n), round(lost * number / n), number, confidence)
