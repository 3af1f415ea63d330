"""What is compared: every number of a scenario, and how far it is from that of the first one."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from campaign.comparison.scenarios import Comparison
from campaign.statistics.paired import Difference, mean_difference, proportion_difference, quantile_difference
from campaign.statistics.receptors import QUANTILES, REACHED

REACH_PROBABILITY = dict(zip(REACHED, ("front_reach_probability", "moved_ground_reach_probability"), strict=True))
"""What may reach a receptor, and the variable that holds its probability."""


class Measure(NamedTuple):
    """A number that every scenario has.

    Attributes
    ----------
    variable : str
        Its name in the dataset.
    words : str
        What it is.
    unit : str
        "1" for a probability.
    dim : str
        The dimension along which there are several of it, "" for one.
    at : float or str
        Its place there: a distance in m, a probability, the name of a receptor.
    differences : list of Difference
        Of scenarios 1, 2, ... from the first.
    """

    variable: str
    words: str
    unit: str
    dim: str
    at: float | str
    differences: list[Difference]


def measures(given: Comparison, distances: Sequence[float]) -> list[Measure]:
    """Return all numbers that are compared.

    Parameters
    ----------
    given : Comparison
    distances : sequence of float
        In m; the probability of a longer run-out is compared at each.
    """
    of_slides = [
        *_runouts(given),
        *(_exceedance(given, distance) for distance in distances),
        *_reach(given),
        _against_first(
            given,
            ("sliding_volume_mean", "mean sliding volume, 0 without a slide", "m3/m"),
            lambda other: mean_difference(given.volumes(0), given.volumes(other), given.confidence),
        ),
    ]
    return [_slide_probability(given), *(_as_bounded(given, each) for each in of_slides)]


def _against_first(
    given: Comparison,
    about: tuple[str, str, str],
    difference: Callable[[int], Difference],
    dim: str = "",
    at: float | str = "",
) -> Measure:
    return Measure(*about, dim, at, [difference(other) for other in range(1, len(given.names))])


def _as_bounded(given: Comparison, measure: Measure) -> Measure:
    """Return a measure without the bounds that slides cut short leave open: they would have come farther."""
    most = 1.0 if measure.unit == "1" else math.inf

    def bounded(other: int, found: Difference) -> Difference:
        interval = found.interval
        if found.first < most and given.is_cut_short(0):
            interval = interval._replace(lower=-math.inf)
        if found.other < most and given.is_cut_short(other):
            interval = interval._replace(upper=math.inf)
        return found._replace(interval=interval)

    return measure._replace(differences=[bounded(*each) for each in enumerate(measure.differences, start=1)])


def _slide_probability(given: Comparison) -> Measure:
    return _against_first(
        given,
        ("slide_probability", "P(slide)", "1"),
        lambda other: proportion_difference(given.has_slid(0), given.has_slid(other), given.confidence),
    )


def _runouts(given: Comparison) -> Iterator[Measure]:
    sliding = np.all([given.has_slid(scenario) for scenario in range(len(given.names))], axis=0)
    yield _against_first(
        given,
        ("runout_mean", "mean run-out, 0 without a slide", "m"),
        lambda other: mean_difference(given.runouts(0), given.runouts(other), given.confidence),
    )
    yield _against_first(
        given,
        ("runout_mean_given_all_slide", "mean run-out where all slide", "m"),
        lambda other: mean_difference(given.runouts(0)[sliding], given.runouts(other)[sliding], given.confidence),
    )
    for share, name in QUANTILES.items():
        yield _against_first(
            given,
            ("runout_quantile", f"{name} of run-out", "m"),
            partial(_quantile_difference, given, share),
            "quantile",
            share,
        )


def _quantile_difference(given: Comparison, share: float, other: int) -> Difference:
    return quantile_difference(given.runouts(0), given.runouts(other), share, given.confidence)


def _exceedance(given: Comparison, distance: float) -> Measure:
    return _against_first(
        given,
        ("exceedance", f"P(run-out above {distance:g} m)", "1"),
        lambda other: proportion_difference(
            given.runouts(0) > distance, given.runouts(other) > distance, given.confidence
        ),
        "distance",
        distance,
    )


def _reach(given: Comparison) -> Iterator[Measure]:
    for receptor in given.receptors:
        for what, variable in REACH_PROBABILITY.items():
            reacher = "front" if what == "front_reaches" else "moved ground"
            yield _against_first(
                given,
                (variable, f"P({reacher} reaches {receptor})", "1"),
                partial(_reach_difference, given, what, receptor),
                "receptor",
                receptor,
            )


def _reach_difference(given: Comparison, what: str, receptor: str, other: int) -> Difference:
    first, there = (given.reaches(scenario, what, receptor) for scenario in (0, other))
    return proportion_difference(first, there, given.confidence)
