"""Whether a modelling choice may be dropped: one law, from intervals and tolerances."""

import math
from collections.abc import Callable, Sequence
from enum import StrEnum
from typing import NamedTuple

from campaign.statistics.intervals import Interval
from campaign.statistics.paired import Difference

MOST = 100_000
"""Realizations beyond which nobody would decide anything."""


class Verdict(StrEnum):
    """What to do with a choice."""

    KEEP = "keep"
    DROP = "may drop"
    OPEN = "not known yet"


class Effect(NamedTuple):
    """What a choice changes in one number of the answer.

    Attributes
    ----------
    variable : str
        Name of the number in the dataset.
    words : str
        For people.
    unit : str
        "1" for a probability.
    difference : Difference
        Of the changed scene from the scene itself, from pairs.
    tolerance : float
        Largest difference that does not matter, in the same unit.
    at : Callable
        The interval that so many realizations would give if the differences between pairs stayed as they are.
    """

    variable: str
    words: str
    unit: str
    difference: Difference
    tolerance: float
    at: Callable[[int], Interval]

    @property
    def share(self) -> float:
        """The size of the difference in tolerances."""
        return self._in_tolerances(self.difference.interval.estimate)

    @property
    def reach(self) -> float:
        """The largest size that its interval leaves possible, in tolerances."""
        return max(map(self._in_tolerances, self.difference.interval[1:3]))

    @property
    def told(self) -> str:
        """The difference with its interval: in m "+0.12 ± 0.05", in points "+3 (-2 to +9)"."""
        interval = self.difference.interval
        if self.unit == "m":
            return f"{_rounded(interval.estimate, 2):+.2f} ± {interval.half_width:.2f}"
        estimate, lower, upper = (_rounded(100 * value, 0) for value in interval[:3])
        return f"{estimate:+.0f} ({lower:+.0f} to {upper:+.0f})"

    def _in_tolerances(self, difference: float) -> float:
        return abs(difference) / self.tolerance if self.tolerance else math.inf if difference else 0.0


def _rounded(value: float, digits: int) -> float:
    """Round, to a zero without a minus."""
    return round(value, digits) + 0.0


def judge(intervals: Sequence[tuple[Interval, float]]) -> Verdict:
    """Judge a choice by the intervals of all that it changes, each with its tolerance.

    It may be dropped if all intervals lie within +- tolerance. It must be kept if any lies wholly outside. Else it is
    not known yet.

    Each choice is judged by itself, at the confidence of the scene. To drop wrongly, the interval of the very number
    that changes too much has to be wrong, however many others are asked (Berger 1982, Technometrics 24, 295-300): the
    probability is (1 - confidence) / 2 at most, 2.5 % at 95 %. To keep wrongly, any of m intervals has to be wrong,
    with a probability of m times as much at most; that costs time, and no truth. Of k choices that matter,
    k (1 - confidence) / 2 at most are dropped wrongly on average. Nothing corrects for that, because what is dropped is
    run once more, all of it together, and judged by this law again.
    """
    if any(interval.lower > tolerance or interval.upper < -tolerance for interval, tolerance in intervals):
        return Verdict.KEEP
    if intervals and all(
        -tolerance <= interval.lower <= interval.upper <= tolerance for interval, tolerance in intervals
    ):
        return Verdict.DROP
    return Verdict.OPEN


def verdict_of(effects: Sequence[Effect]) -> Verdict:
    """Judge a choice by what has been seen of it."""
    return judge([(effect.difference.interval, effect.tolerance) for effect in effects])


def deciding_number(effects: Sequence[Effect]) -> int | None:
    """Return how many realizations would decide on a choice, if their differences stayed as they are.

    None where it would take more than `MOST`, because a difference is hardly more or less than its tolerance.
    """

    def is_open(number: int) -> bool:
        return judge([(effect.at(number), effect.tolerance) for effect in effects]) is Verdict.OPEN

    few, many = 2, 2
    while is_open(many):
        few, many = many, 2 * many
        if many > MOST:
            return None
    while many - few > 1:
        middle = (few + many) // 2
        few, many = (middle, many) if is_open(middle) else (few, middle)
    return many
