"""What a campaign says of the places that its scene names: how probable it is that a slide comes, and how it comes.

Probabilities are unconditional: a realization that does not slide has not reached the place. What comes is told of the
realizations whose front reaches it.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.record import LOWER_BOUND, SLID, Status
from campaign.statistics.intervals import Interval, Sample, quantile_interval, unknown
from campaign.statistics.proportions import exact_interval, failure_bounds

REACHED = {
    "front_reaches": "probability that the slide's front reaches it",
    "moved_ground_reaches": "probability that any moved ground reaches it",
}
"""What may reach a receptor, and what the probability of that is called."""

EFFECTS = {
    "receptor_max_depth": "largest flow depth",
    "receptor_max_velocity": "largest velocity",
    "receptor_momentum_flux": "largest momentum flux",
    "receptor_impact_pressure": "largest impact pressure",
    "receptor_deposit": "final rise of the ground",
}
"""What a slide does there once its front has come, and what that is called."""

RISE = "receptor_deposit"
"""The effect that is no largest value: ground that still moves may raise or lower it."""

AHEAD = {
    "receptor_ahead_depth": "largest depth",
    "receptor_ahead_velocity": "largest velocity",
    "receptor_ahead_momentum_flux": "largest momentum flux",
    "receptor_ahead_impact_pressure": "largest impact pressure",
}
"""What ground does there that is pushed or thrown ahead, before the front comes or where it does not."""

QUANTILES = {0.5: "median", 0.95: "95 % quantile"}


class ReceptorEstimate(NamedTuple):
    """One number about one receptor.

    Attributes
    ----------
    receptor, quantity : str
        Its name, and what the number is.
    unit : str
        "1" for a probability.
    interval : Interval
    open_bounds : tuple of float
        Of a probability: what it would be if none, or all, of the realizations that leave it open had reached the
        place, because they failed, could still come so far when the run ended or were stopped by a wall; NaN for
        other numbers.
    """

    receptor: str
    quantity: str
    unit: str
    interval: Interval
    open_bounds: tuple[float, float] = (math.nan, math.nan)


def receptor_estimates(data: xr.Dataset, confidence: float) -> list[ReceptorEstimate]:
    """Return what a campaign says of each receptor: two probabilities, then quantiles given that the front reaches it.

    Parameters
    ----------
    data : xarray.Dataset
        As `campaign.results.dataset` builds it; without receptors there is nothing to say.
    confidence : float
        Between 0 and 1.
    """
    if "receptor" not in data.sizes:
        return []
    names = map(str, data["receptor"].values)
    return [
        estimate
        for number, name in enumerate(names)
        for estimate in _of_one(name, data.isel(receptor=number), confidence)
    ]


def reach_probability(
    reaches: Sample, may_come: NDArray[np.bool_], confidence: float
) -> tuple[Interval, tuple[float, float]]:
    """Return the probability that something reaches a place, with its interval, and what the open realizations allow.

    Parameters
    ----------
    reaches : ndarray (n,)
        1 or 0 for each realization, NaN where it failed; these are left out.
    may_come : bool ndarray (n,)
        Whether it could still get there after the end, or had a wall not stopped it: where it did not, it counts as if
        it had for the upper bound alone.
    confidence : float
        Of the interval, which is that of Clopper and Pearson (1934), Biometrika 26, 404-413.
    """
    failed = int(np.count_nonzero(np.isnan(reaches)))
    reached, n = int(np.nansum(reaches)), len(reaches) - failed
    if n == 0:
        return unknown(math.nan, 0), (math.nan, math.nan)
    undecided = int(np.count_nonzero(may_come & (reaches == 0.0)))
    least, most = (exact_interval(count, n, confidence) for count in (reached, reached + undecided))
    found = least._replace(upper=most.upper, is_least=undecided > 0)
    return found, failure_bounds(reached, n - undecided, failed + undecided)


def _of_one(name: str, data: xr.Dataset, confidence: float) -> Iterator[ReceptorEstimate]:
    may_come = may_still_come(data)
    for variable, called in REACHED.items():
        interval, bounds = reach_probability(data[variable].values, may_come[variable], confidence)
        yield ReceptorEstimate(name, called, "1", interval, bounds)
    is_reached = data["front_reaches"].values == 1.0
    for variable, called in EFFECTS.items():
        values, cut = data[variable].values[is_reached], (still_moves(data) & (variable != RISE))[is_reached]
        for probability, quantile in QUANTILES.items():
            interval = quantile_interval(values, probability, confidence, cut)
            yield ReceptorEstimate(name, f"{quantile} of the {called}, where reached", data[variable].units, interval)


def may_still_come(data: xr.Dataset) -> dict[str, NDArray[np.bool_]]:
    """Return in which realizations that were cut short each of `REACHED` may come to the one receptor of `data`."""
    may_go_on = np.isin(data["status"].values, list(LOWER_BOUND))
    return {"front_reaches": may_go_on & ~_stays_short(data), "moved_ground_reaches": may_go_on}


def still_moves(data: xr.Dataset) -> NDArray[np.bool_]:
    """Whether any ground of a slide still moved when its run ended, so that what it does at a place is so far, (n,)."""
    return np.asarray(np.isin(data["status"].values, list(SLID)) & np.isnan(data["settle_time"].values))


def _stays_short(data: xr.Dataset) -> NDArray[np.bool_]:
    """Whether the place is farther from the front than this could have come after the end, (realization,).

    Nothing tells how far a slide would have come that a wall has stopped.
    """
    near = float(np.min(data["receptor_x_bounds"].values))
    comes_to = data["front_position"].values[:, -1] + data["farther_advance"].values
    return np.asarray((comes_to < near) & (data["status"].values != Status.reached_wall))
