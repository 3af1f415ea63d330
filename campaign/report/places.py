"""What the page says in tables: how the ground moves, and what comes to the places asked about."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from campaign.report.wording import bounds, number
from campaign.results.results import Results
from campaign.scene.sections import Receptor
from campaign.statistics.intervals import Interval, Sample, quantile_interval
from campaign.statistics.receptors import (
    EFFECTS,
    QUANTILES,
    REACHED,
    ReceptorEstimate,
    receptor_estimates,
)
from campaign.statistics.wording import chance, chances
from campaign.terminal import counted

MOVEMENT = {
    "sliding_volume": "ground that slides, per metre of width",
    "retrogression": "length lost behind the crest",
}
"""Scalars of a slide, and what they are called."""

REST = "time from release to rest"

STILL_MOVING = 1e99
"""Time in s that stands for a rest after the end of the run, so that quantiles know of it."""

ARRIVAL = "arrival after the release"

PUSHED = ("receptor_max_depth", "receptor_max_velocity", "receptor_deposit")
"""What is told of ground that is pushed ahead of the front."""


class Distribution(NamedTuple):
    """A line of a table: a quantity with its median and its 95 % quantile, each with an interval."""

    name: str
    median: str
    median_interval: str
    far: str
    far_interval: str


class Reach(NamedTuple):
    """How probable it is that the front, and that any moved ground, reaches a receptor."""

    front: ReceptorEstimate
    moved: ReceptorEstimate

    @property
    def is_pushed_farther(self) -> bool:
        """Whether ground that is pushed or thrown ahead gets there more often than the front."""
        return self.moved.interval.estimate > self.front.interval.estimate


class Place(NamedTuple):
    """A receptor: where it is, how probable it is that something comes, and what comes, with and without a front."""

    name: str
    where: str
    chances: list[tuple[str, str, str]]
    slides: int
    effects: list[Distribution]
    pushed: str


def movement(results: Results) -> list[Distribution]:
    """Return how the ground moves in the slides."""
    rows = [
        distribution(name, results.of_slides(quantity), results.data[quantity].units, results.confidence)
        for quantity, name in MOVEMENT.items()
        if np.isfinite(results.of_slides(quantity)).any()
    ]
    return [*rows, _rest(results)] if results.outcomes.slides else rows


def _rest(results: Results) -> Distribution:
    """Return when slides come to rest; those that still move at the end do so later than all others."""
    times = np.nan_to_num(results.of_slides("settle_time"), nan=STILL_MOVING)
    columns: list[str] = []
    for share in QUANTILES:
        interval = quantile_interval(times, share, results.confidence)
        estimate, lower, upper = (value if value < STILL_MOVING / 1e6 else np.nan for value in interval[:3])
        is_later = np.isnan(estimate)
        columns += ["later than the end" if is_later else number(estimate, "s")]
        columns += ["" if is_later else bounds(Interval(estimate, lower, upper, interval.n), "s")]
    return Distribution(REST, *columns)


def stillness(results: Results) -> list[Distribution]:
    """Return how far the ground moved where nothing slid; nothing if all failed."""
    if not results.outcomes.usable:
        return []
    largest = results.data["max_displacement"].values[~results.has_failed, -1]
    return [distribution("largest movement of any ground", 1000.0 * largest, "mm", results.confidence)]


def reach_estimates(results: Results) -> list[Reach]:
    """Return for each receptor how probable it is that a slide gets there, if that is known."""
    known = [each for each in receptor_estimates(results.data, results.confidence) if each.interval.n]
    fronts, moved = ([each for each in known if each.quantity == called] for called in REACHED.values())
    return [Reach(*pair) for pair in zip(fronts, moved, strict=True)]


def places(results: Results) -> list[Place]:
    """Return what the campaign says of each receptor."""
    estimated = receptor_estimates(results.data, results.confidence)
    reach = [each for each in estimated if each.quantity in REACHED.values() and each.interval.n]
    return [_place(results, receptor, reach) for receptor in results.scene.receptor]


def distribution(name: str, values: Sample, unit: str, confidence: float) -> Distribution:
    """Return median and 95 % quantile of the finite ones of some values."""
    known = values[np.isfinite(values)]
    columns: list[str] = []
    for share in QUANTILES:
        interval = quantile_interval(known, share, confidence)
        columns += [number(interval.estimate, unit), bounds(interval, unit)]
    return Distribution(name, *columns)


def _place(results: Results, receptor: Receptor, reach: list[ReceptorEstimate]) -> Place:
    name, (near, far) = receptor.name, receptor.x
    probabilities = [
        (each.quantity.removeprefix("probability that "), chance(each.interval.estimate), chances(each.interval))
        for each in reach
        if each.receptor == name
    ]
    reached = results.data.sel(receptor=name)["front_reaches"].values == 1.0
    where = f"x = {near:g} m" if near == far else f"x = {near:g} to {far:g} m"
    effects = list(_effects(results, name, reached)) if reached.any() else []
    return Place(name, where, probabilities, int(np.count_nonzero(reached)), effects, _pushed(results, name))


def _pushed(results: Results, receptor: str) -> str:
    """Say what comes in slides whose front does not get there, "" if nothing does."""
    data = results.data.sel(receptor=receptor)
    without_front = (data["moved_ground_reaches"].values == 1.0) & (data["front_reaches"].values == 0.0)
    if not without_front.any():
        return ""
    depth, velocity, rise = (float(np.median(data[each].values[without_front])) for each in PUSHED)
    return (
        f"In {counted(int(np.count_nonzero(without_front)), 'slide')} ground gets here that is pushed or thrown ahead "
        f"of the front, and not the front: in half of them {number(depth, 'm')} deep or more and "
        f"{number(velocity, 'm/s')} fast, with a final rise of {number(rise, 'm')} or more."
    )


def _effects(results: Results, receptor: str, reached: np.ndarray) -> Iterator[Distribution]:
    data = results.data.sel(receptor=receptor)
    for variable, name in ({"front_arrival": ARRIVAL} | EFFECTS).items():
        yield distribution(name, data[variable].values[reached], data[variable].units, results.confidence)
