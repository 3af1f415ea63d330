"""What the page says in tables: how the ground moves, and what comes to the places asked about."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.report.wording import bounds, number
from campaign.results.results import Results
from campaign.scene.ground_surface import surface_of
from campaign.scene.sections import Receptor
from campaign.statistics.intervals import Interval, Sample, quantile_interval
from campaign.statistics.receptors import (
    AHEAD,
    EFFECTS,
    QUANTILES,
    REACHED,
    ReceptorEstimate,
    receptor_estimates,
)
from campaign.statistics.wording import chances, estimated_chance
from campaign.terminal import counted

MOVEMENT = {
    "sliding_volume": "ground that moves by more than {displaced:g} m, per metre of width",
    "retrogression": "length lost behind the crest, moved by more than {failed:g} m",
    "influence_distance": "length behind the crest that moves by more than {displaced:g} m",
}
"""Scalars of a slide, and what they are called with the criteria of `slide`."""

BEHIND_CREST = ("retrogression", "influence_distance")

REST = "time from release to rest"

STILL_MOVING = 1e99
"""Time in s that stands for a rest after the end of the run, so that quantiles know of it."""

ARRIVALS = {
    "moved_ground_arrival": "arrival of any moved ground after the release",
    "front_arrival": "arrival of the front",
}
"""When something comes, and what that is called."""

RISE = "receptor_deposit"


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
    """A receptor: where it is, how probable it is that something comes, and what comes with the front and ahead of it.

    Attributes
    ----------
    slides : int
        In which the front comes, and of which the effects are.
    effects : list of Distribution
        From the arrival of the front on.
    pushed : str
        In which slides ground is pushed or thrown here ahead of the front, "" if in none.
    ahead : list of Distribution
        What that ground does.
    """

    name: str
    where: str
    chances: list[tuple[str, str, str]]
    slides: int
    effects: list[Distribution]
    pushed: str
    ahead: list[Distribution]


def movement(results: Results) -> list[Distribution]:
    """Return how the ground moves in the slides."""
    rows = [
        distribution(
            name.format_map(dict(results.scene.slide)) + _at_least(results, quantity),
            results.of_slides(quantity),
            results.data[quantity].units,
            results.confidence,
        )
        for quantity, name in MOVEMENT.items()
        if np.isfinite(results.of_slides(quantity)).any()
    ]
    return [*rows, _rest(results)] if results.outcomes.slides else rows


def _at_least(results: Results, quantity: str) -> str:
    """Say in how many slides there would be more of a quantity, "" if in none.

    Ground behind the front may still move at the end, and what moves behind the crest may reach the wall there.
    """
    values, moves = results.of_slides(quantity), np.isnan(results.of_slides("settle_time"))
    wall = surface_of(results.scene.geometry).crest_x if quantity in BEHIND_CREST else np.inf
    at_wall = values > wall - 0.5 * results.scene.numerics.cell
    causes = {
        "to the wall of the model": np.isfinite(values) & at_wall,
        "still moving at the end": np.isfinite(values) & moves & ~at_wall,
    }
    told = [f"in {counted(n, 'slide')} {why}" for why, which in causes.items() if (n := int(np.count_nonzero(which)))]
    return f" (at least: {' and '.join(told)})" if told else ""


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
        (each.quantity.removeprefix("probability that "), estimated_chance(each.interval), chances(each.interval))
        for each in reach
        if each.receptor == name
    ]
    data = results.data.sel(receptor=name)
    with_front, with_ahead = data["front_reaches"].values == 1.0, data["receptor_ahead_depth"].values > 0.0
    where = f"x = {near:g} m" if near == far else f"x = {near:g} to {far:g} m"
    effects = _distributions(data, ARRIVALS | EFFECTS, with_front, results.confidence)
    ahead = _distributions(data, AHEAD, with_ahead, results.confidence)
    alone = {RISE: f"{EFFECTS[RISE]} where the front does not come"}
    ahead += _distributions(data, alone, with_ahead & ~with_front, results.confidence)
    slides, pushed = int(np.count_nonzero(with_front)), _pushed(with_ahead, with_front)
    return Place(name, where, probabilities, slides, effects, pushed, ahead)


def _pushed(with_ahead: NDArray[np.bool_], with_front: NDArray[np.bool_]) -> str:
    """Say in which slides ground comes ahead of the front, "" if in none."""
    slides, alone = int(np.count_nonzero(with_ahead)), int(np.count_nonzero(with_ahead & ~with_front))
    if not slides:
        return ""
    told = f"In {counted(slides, 'slide')} with ground here that is pushed or thrown ahead of the front"
    return f"{told}, which in {alone:,} of them does not come" if alone else told


def _distributions(
    data: xr.Dataset, named: Mapping[str, str], where: NDArray[np.bool_], confidence: float
) -> list[Distribution]:
    """Return what some quantities are in some realizations; nothing without any."""
    if not where.any():
        return []
    return [distribution(name, data[each].values[where], data[each].units, confidence) for each, name in named.items()]
