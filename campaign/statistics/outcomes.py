"""What became of the first realizations: the numbers from which every estimate is made."""

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.record import FAILED, LOWER_BOUND, SLID, Front, RealizationSummary, Status
from campaign.statistics.intervals import Sample

FEW = 0.05
"""Share of the slides up to which those cut short hardly move a mean: twice as far, they would add as much to it."""


class Outcomes(NamedTuple):
    """What became of some realizations.

    Attributes
    ----------
    realizations : int
        All of them, whatever became of them.
    usable : int
        Those with a result.
    runouts : array (slides,)
        Run-outs of those that slid [m], in the order of their ids.
    is_hindered : bool array (slides,)
        Whether the wall ahead was in the way, so that the run-out is a lower bound.
    is_cut_short : bool array (slides,)
        Whether that is so, or the front may have come farther after its run ended: a lower bound as well.
    """

    realizations: int
    usable: int
    runouts: Sample
    is_hindered: NDArray[np.bool_]
    is_cut_short: NDArray[np.bool_]

    @property
    def slides(self) -> int:
        """Number of realizations that slid."""
        return len(self.runouts)

    @property
    def hindered(self) -> int:
        """Number of slides that the wall ahead was in the way of."""
        return int(np.count_nonzero(self.is_hindered))

    @property
    def unhindered(self) -> int:
        """Number of slides that the wall ahead was not in the way of."""
        return self.slides - self.hindered

    @property
    def cut_short(self) -> int:
        """Number of slides that would have come farther, nobody knows how far."""
        return int(np.count_nonzero(self.is_cut_short))

    @property
    def bound_the_mean(self) -> bool:
        """Whether so few were cut short that the mean has an upper bound worth its name."""
        return self.cut_short <= FEW * self.slides

    def beyond(self, distance: float) -> int:
        """Return how many ran farther than a distance [m]."""
        return int(np.count_nonzero(self.runouts > distance))

    def undecided(self, distance: float) -> int:
        """Return how many were cut short before a distance [m], and may have run farther."""
        return int(np.count_nonzero(self.is_cut_short & (self.runouts <= distance)))


class Account:
    """Outcomes of realizations 0, 1, 2, ..., kept up to date at the cost of one as each is added.

    Parameters
    ----------
    maximum
        Number of realizations that there may be.
    front
        Whose run-out counts.

    Attributes
    ----------
    failed : int
        Realizations without a result.
    """

    def __init__(self, maximum: int, front: Front) -> None:
        self.front = front
        self.failed = 0
        self._realizations = self._usable = self._slides = 0
        self._runouts = np.empty(maximum)
        self._is_hindered, self._is_cut_short = np.empty((2, maximum), dtype=np.bool_)

    def add(self, summary: RealizationSummary) -> None:
        """Take the next realization into the account."""
        self._realizations += 1
        self.failed += summary.status in FAILED
        runout = summary.runout(self.front)
        if not math.isfinite(runout):
            return
        self._usable += 1
        if summary.status in SLID:
            self._runouts[self._slides] = runout
            self._is_hindered[self._slides] = summary.status is Status.reached_wall
            self._is_cut_short[self._slides] = summary.status in LOWER_BOUND
            self._slides += 1

    def outcomes(self) -> Outcomes:
        """Return the outcomes so far; they stay what they are when more are added."""
        slid = slice(self._slides)
        of_slides = self._runouts[slid], self._is_hindered[slid], self._is_cut_short[slid]
        return Outcomes(self._realizations, self._usable, *of_slides)


def outcomes_of(summaries: Iterable[RealizationSummary], front: Front) -> Outcomes:
    """Return the outcomes of realizations in the order of their ids."""
    given = list(summaries)
    account = Account(len(given), front)
    for summary in given:
        account.add(summary)
    return account.outcomes()
