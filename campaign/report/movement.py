"""How the ground moves in the slides, or where nothing slid, in tables."""

import numpy as np
from numpy.typing import NDArray

from campaign.report.distribution import Distribution, distribution
from campaign.report.wording import bounds, number
from campaign.results.results import Results
from campaign.scene.ground_surface import surface_of
from campaign.statistics.intervals import Interval, quantile_interval
from campaign.statistics.receptors import QUANTILES
from campaign.terminal import counted, listing

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


def movement(results: Results) -> list[Distribution]:
    """Return how the ground moves in the slides."""
    rows = [_moved(results, each) for each in MOVEMENT if np.isfinite(results.of_slides(each)).any()]
    return [*rows, _rest(results)] if results.outcomes.slides else rows


def _moved(results: Results, quantity: str) -> Distribution:
    """Return how much of the ground moves, and in how many slides there would be more of it."""
    values, causes = results.of_slides(quantity), _would_be_more(results, quantity)
    told = [f"in {counted(n, 'slide')} {why}" for why, which in causes.items() if (n := int(np.count_nonzero(which)))]
    name, unit = MOVEMENT[quantity].format_map(dict(results.scene.slide)), results.data[quantity].units
    row = distribution(name, values, unit, results.confidence, np.logical_or.reduce([*causes.values()]))
    return row._replace(remark=f"at least: {listing(told)}" if told else "")


def _would_be_more(results: Results, quantity: str) -> dict[str, NDArray[np.bool_]]:
    """Return in which slides there would be more of a quantity, by the reason; a slide is in one of them.

    The wall ahead that stops a slide keeps ground behind it from following, behind the one behind the crest there is no
    more that could move, and ground behind the front may still move at the end.
    """
    values, moves = results.of_slides(quantity), np.isnan(results.of_slides("settle_time"))
    wall = surface_of(results.scene.geometry).crest_x if quantity in BEHIND_CREST else np.inf
    at_wall = results.reached_behind | (values > wall - 0.5 * results.scene.numerics.cell)
    is_stopped, is_known = results.outcomes.is_hindered, np.isfinite(values)
    return {
        "as far back as the wall behind the crest": is_known & at_wall,
        "that the wall ahead stopped": is_known & is_stopped & ~at_wall,
        "still moving at the end": is_known & moves & ~at_wall & ~is_stopped,
    }


def _rest(results: Results) -> Distribution:
    """Return when slides come to rest; those that still move at the end do so later than all others."""
    stopped = results.outcomes.hindered
    times = np.nan_to_num(results.of_slides("settle_time"), nan=STILL_MOVING)
    columns: list[str] = []
    for share in QUANTILES:
        interval = quantile_interval(times, share, results.confidence)
        estimate, lower, upper = (value if value < STILL_MOVING / 1e6 else np.nan for value in interval[:3])
        is_later = np.isnan(estimate)
        columns += ["later than the end" if is_later else number(estimate, "s")]
        columns += ["" if is_later else bounds(Interval(estimate, lower, upper, interval.n), "s")]
    remark = f"in {counted(stopped, 'slide')} with the wall ahead in the way" if stopped else ""
    return Distribution(REST, *columns)._replace(remark=remark)


def stillness(results: Results) -> list[Distribution]:
    """Return how far the ground moved where nothing slid; nothing if all failed."""
    if not results.outcomes.usable:
        return []
    largest = results.data["max_displacement"].values[~results.has_failed, -1]
    return [distribution("largest movement of any ground", 1000.0 * largest, "mm", results.confidence)]
