"""What is compared: every number of a scenario, and how far it is from that of the first one."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.comparison.scenarios import Comparison
from campaign.statistics.intervals import Sample, quantile_interval
from campaign.statistics.paired import (
    Difference,
    bounded_proportion_difference,
    mean_difference,
    proportion_difference,
    quantile_difference,
)
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
    return [
        _slide_probability(given),
        *_runouts(given),
        *(_exceedance(given, distance) for distance in distances),
        *_reach(given),
        _against_first(
            given,
            ("sliding_volume_mean", "mean sliding volume, 0 without a slide", "m3/m"),
            lambda other: _bounded_mean(given, given.volumes, given.has_least_volumes, other),
        ),
    ]


def _against_first(
    given: Comparison,
    about: tuple[str, str, str],
    difference: Callable[[int], Difference],
    dim: str = "",
    at: float | str = "",
) -> Measure:
    return Measure(*about, dim, at, [difference(other) for other in range(1, len(given.names))])


def _bounded_mean(
    given: Comparison,
    values: Callable[[int], Sample],
    is_least: Callable[[int], bool],
    other: int,
    among: NDArray[np.bool_] | None = None,
) -> Difference:
    """Return a difference of means, without the bound that it loses where one of them is a lower bound."""
    first, there = (values(k) if among is None else values(k)[among] for k in (0, other))
    found = mean_difference(first, there, given.confidence)
    return _opened(found, is_least(0), is_least(other))._replace(
        first_is_least=is_least(0), other_is_least=is_least(other)
    )


def _opened(found: Difference, below: bool, above: bool) -> Difference:
    """Return a difference without the bounds that are not known."""
    interval = found.interval
    lower, upper = -math.inf if below else interval.lower, math.inf if above else interval.upper
    return found._replace(interval=interval._replace(lower=lower, upper=upper))


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
        lambda other: _bounded_mean(given, given.runouts, given.is_cut_short, other),
    )
    yield _against_first(
        given,
        ("runout_mean_given_all_slide", "mean run-out where all slide", "m"),
        lambda other: _bounded_mean(given, given.runouts, given.is_cut_short, other, sliding),
    )
    for share, name in QUANTILES.items():
        yield _against_first(
            given,
            ("runout_quantile", f"{name} of run-out, 0 without a slide", "m"),
            partial(_quantile_difference, given, share),
            "quantile",
            share,
        )


def _quantile_difference(given: Comparison, share: float, other: int) -> Difference:
    """Return a difference of quantiles, without a bound that slides cut short leave open."""
    each = [quantile_interval(given.runouts(k), share, given.confidence, given.cut_short(k)) for k in (0, other)]
    found = quantile_difference(given.runouts(0), given.runouts(other), share, given.confidence)
    is_open = [one.is_least or one.upper == math.inf for one in each]
    return _opened(found, *is_open)._replace(first_is_least=each[0].is_least, other_is_least=each[1].is_least)


def _exceedance(given: Comparison, distance: float) -> Measure:
    return _against_first(
        given,
        ("exceedance", f"P(run-out above {distance:g} m)", "1"),
        lambda other: bounded_proportion_difference(
            (given.runouts(0) > distance, given.runouts(other) > distance),
            (given.cut_short(0), given.cut_short(other)),
            given.confidence,
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
    reached, may_come = (
        (read(0, what, receptor), read(other, what, receptor)) for read in (given.reaches, given.may_reach)
    )
    return bounded_proportion_difference(reached, may_come, given.confidence)
