"""How much the run-out owes to each input, from a few slides repeated with one input changed.

A slide is the same ground in both runs, but for the input: the difference between its two run-outs is free of the
scatter between realizations, so that a few pairs tell it.
"""

import math
from typing import NamedTuple

import numpy as np

from campaign.record import UNHINDERED, Status
from campaign.statistics.intervals import Interval, Sample, mean_interval
from campaign.statistics.repetition import unhindered_runout
from campaign.statistics.ridge import Matrix
from campaign.statistics.tally import Tally


class InputEffects(NamedTuple):
    """What more of each input, one at a time, changes.

    Attributes
    ----------
    keys : tuple of str
        Of the inputs.
    realizations : tuple of int
        The slides that were repeated.
    differences : array (input, pair)
        Final run-out with more of the input minus that without in m: where the slope then stands, that is all of the
        run-out lost; NaN where the run failed or a wall was in the way.
    confidence : float
        Of the intervals.
    """

    keys: tuple[str, ...]
    realizations: tuple[int, ...]
    differences: Matrix
    confidence: float

    @property
    def effects(self) -> dict[str, Interval]:
        """Mean difference of each input in m, with Student's t interval."""
        return {
            key: mean_interval(row[np.isfinite(row)], self.confidence)
            for key, row in zip(self.keys, self.differences, strict=True)
        }

    def ranked(self) -> dict[str, Interval]:
        """Return the effects, the largest first and those of which nothing is known last."""
        return dict(sorted(self.effects.items(), key=lambda item: -abs(item[1].estimate) if item[1].n else math.inf))

    def known(self) -> dict[str, Interval]:
        """Return the effects of which something is known, the largest first."""
        return {key: effect for key, effect in self.ranked().items() if effect.n}

    def clear(self) -> dict[str, Interval]:
        """Return the effects that can be told from none, the largest first."""
        return {key: effect for key, effect in self.known().items() if effect.lower > 0.0 or effect.upper < 0.0}


def first_slides(tally: Tally, count: int) -> tuple[int, ...]:
    """Return the first slides of a whole campaign, without those that the wall ahead was in the way of."""
    slides = (k for k in range(tally.prefix) if tally.summaries[k].status in UNHINDERED)
    return tuple(k for k, _ in zip(slides, range(count), strict=False))


def differences(slides: tuple[int, ...], tally: Tally, changed: Tally) -> Sample:
    """Return what the change of an input made of the run-outs of some slides, (pair,) in m."""
    return np.array([_with(changed, k) - unhindered_runout(tally.summaries[k], tally.front) for k in slides])


def _with(changed: Tally, realization: int) -> float:
    summary = changed.summaries[realization]
    return 0.0 if summary.status is Status.no_slide else unhindered_runout(summary, changed.front)
