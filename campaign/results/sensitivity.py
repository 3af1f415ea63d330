"""What the run-out owes to the soil and to the inputs, as variables of the dataset and back."""

from collections.abc import Iterable
from typing import Any, Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.record import UNHINDERED, USABLE
from campaign.results.results import Results
from campaign.results.sensitivity_table import ESTIMATES, OTHERS
from campaign.results.variables import Variables, texts, variable
from campaign.statistics import sensitivity, sensitivity_map
from campaign.statistics.changed_inputs import InputEffects
from campaign.statistics.intervals import Interval
from campaign.statistics.ridge import Matrix
from campaign.statistics.sensitivity import Ranking
from campaign.statistics.sensitivity_map import SensitivityMap

Outcome = Literal["runout", "slide"]

FEWEST_OF_EACH = 10
"""Realizations that slid, and that did not, from which on sliding is regressed on the soil."""


def with_sensitivity(results: Results, effects: InputEffects | None) -> xr.Dataset:
    """Return the dataset with what can be said of the soil, and what more of each input changes."""
    return results.data.assign(_of_soil(results) | ({} if effects is None else _of_inputs(effects)))


def ranking_of(data: xr.Dataset, outcome: Outcome) -> Ranking | None:
    """Return the ranking of the properties by their effect on run-out or on sliding; None where there is none."""
    if f"{outcome}_explained" not in data:
        return None
    correlation, regression = (_intervals(data, f"{outcome}_{name}") for name in ("correlation", "regression"))
    return Ranking(correlation, regression, float(data[f"{outcome}_explained"]))


def map_of(data: xr.Dataset) -> SensitivityMap | None:
    """Return the sensitivity map; None where there is none."""
    if "sensitivity" not in data:
        return None
    change, error, clear = (data[name].values for name in ("sensitivity", "sensitivity_error", "sensitivity_clear"))
    everywhere = _intervals(data, "sensitivity_everywhere")
    return SensitivityMap(change, error, clear == 1, everywhere, float(data["sensitivity_explained"]))


def effects_of(results: Results) -> InputEffects | None:
    """Return what more of each input changes; None where that is not known."""
    data = results.data
    if "input_difference" not in data:
        return None
    keys, slides = tuple(data["input"].values.tolist()), tuple(data["input_pair"].values.tolist())
    return InputEffects(keys, slides, data["input_difference"].values, results.confidence)


def _of_soil(results: Results) -> Variables:
    data = results.data
    if "field_map" not in data:
        return {}
    field_map = data["field_map"].values.astype(np.float64)
    is_kept = np.isfinite(field_map).any(axis=(1, 2, 3))
    places, boxes = ([data[f"{each}_{axis}"].values for axis in "xy"] for each in ("particle", "box"))
    moving = sensitivity.moving_ground(places, boxes, data["influence_probability"].values)
    if not moving.any():
        return {}
    slides, usable = is_kept & results.has_slid, is_kept & results.has_status(USABLE)
    whole = is_kept & results.has_status(UNHINDERED)  # the others ran as far as the model lets them, in any soil
    runouts, found = results.runouts[whole], Variables()
    if is_enough(runouts, sensitivity.FEWEST):
        means = sensitivity.means_over(field_map[whole], moving)
        found |= _of_ranking("runout", sensitivity.ranking(means, runouts, results.confidence))
    if min(np.count_nonzero(slides), np.count_nonzero(usable & ~slides)) >= FEWEST_OF_EACH:
        means = sensitivity.means_over(field_map[usable], moving)
        outcome = slides[usable].astype(np.float64)
        found |= _of_ranking("slide", sensitivity.ranking(means, outcome, results.confidence))
    if is_enough(runouts, sensitivity_map.FEWEST):
        found |= _of_map(sensitivity_map.sensitivity_map(field_map[whole], runouts, results.confidence))
    return found


def is_enough(runouts: NDArray[np.float64], fewest: int) -> bool:
    """Whether there are so many run-outs, and not all of them equal."""
    return len(runouts) >= fewest and bool(np.ptp(runouts) > 0)


def _of_ranking(outcome: Outcome, found: Ranking) -> Variables:
    return (
        _estimates(f"{outcome}_correlation", found.correlation)
        | _estimates(f"{outcome}_regression", found.regression)
        | _other(f"{outcome}_explained", found.explained)
    )


def _of_map(found: SensitivityMap) -> Variables:
    return (
        _other("sensitivity", found.change)
        | _other("sensitivity_error", found.error)
        | _other("sensitivity_clear", found.is_clear)
        | _other("sensitivity_explained", found.explained)
        | _estimates("sensitivity_everywhere", found.everywhere)
    )


def _of_inputs(found: InputEffects) -> Variables:
    keys = texts("input", found.keys, "key of the input in the scene")
    return (
        {
            "input": keys,
            "input_pair": variable("input_pair", found.realizations, "1", "slide repeated with more of an input", "i4"),
        }
        | _other("input_difference", found.differences)
        | _estimates("input_effect", found.effects.values())
    )


def _estimates(name: str, intervals: Iterable[Interval]) -> Variables:
    row, numbers = ESTIMATES[name], np.array([*intervals])
    mean = variable(row.dims, numbers[:, 0], row.units, row.long_name)
    mean.attrs |= {"n": numbers[:, 3].astype("i4")}
    bounds = variable((*row.dims, "bound"), numbers[:, 1:3], row.units, f"confidence interval of {name}")
    return {name: mean, f"{name}_ci": bounds}


def _other(name: str, values: Matrix | NDArray[Any] | float) -> Variables:
    row = OTHERS[name]
    return {name: variable(row.dims, values, row.units, row.long_name, row.dtype)}


def _intervals(data: xr.Dataset, name: str) -> tuple[Interval, ...]:
    bounds, counts = data[f"{name}_ci"].values.tolist(), np.atleast_1d(data[name].attrs["n"]).tolist()
    rows = zip(data[name].values.tolist(), bounds, counts, strict=True)
    return tuple(Interval(estimate, lower, upper, n) for estimate, (lower, upper), n in rows)
