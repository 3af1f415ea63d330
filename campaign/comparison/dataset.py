"""`comparison.nc`: every pair and every difference, an xarray dataset after CF-1.11."""

import math
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import Any

import numpy as np
import xarray as xr

from campaign.comparison.measures import Measure
from campaign.comparison.scenarios import Comparison
from campaign.results.variables import Variables, texts, variable
from campaign.statistics.intervals import unknown
from campaign.statistics.paired import Difference
from campaign.statistics.receptors import REACHED
from campaign.storage.formats import program_version

DIMENSIONS = {
    "distance": ("m", "distance from the initial toe"),
    "quantile": ("1", "probability of a shorter run-out"),
}
"""Unit and name of the numbers along which there are several of a measure."""

IS_LEAST = "{}_is_least"

DIFFERENCE: dict[str, tuple[str, Callable[[Difference], Any]]] = {
    "{}": ("{}", lambda found: found.other),
    IS_LEAST: ("1 where slides that were cut short would make {} larger, else 0", lambda found: found.other_is_least),
    "{}_difference": ("{}, minus that of the first scenario", lambda found: found.interval.estimate),
    "{}_difference_ci": ("confidence interval of the difference of {}", lambda found: found.interval[1:3]),
    "{}_paired_error": ("standard error of the difference of {} from pairs", lambda found: found.paired_error),
    "{}_unpaired_error": (
        "standard error that the difference of {} would have for independent samples",
        lambda found: found.unpaired_error,
    ),
}
"""Variables of a measure: name, meaning, and what they are of a difference."""


def as_dataset(given: Comparison, found: Sequence[Measure], doubts: Sequence[str]) -> xr.Dataset:
    """Return pairs by scenario and realization, and each number with its difference from that of the first scenario.

    The difference and its errors are NaN for the first scenario.
    """
    variables = _of_pairs(given)
    for name in dict.fromkeys(measure.variable for measure in found):
        variables |= _of_measure([measure for measure in found if measure.variable == name])
    return xr.Dataset(variables, _coordinates(given, found), _attributes(given, doubts))


def _of_pairs(given: Comparison) -> Variables:
    each = range(len(given.names))
    dims = ("scenario", "realization")
    variables = {
        "final_runout": variable(
            dims, [given.runouts(k) for k in each], "m", f"final run-out, front of the {given.front}; 0 without a slide"
        ),
        "sliding_volume": variable(
            dims, [given.volumes(k) for k in each], "m3/m", "sliding volume per metre run; 0 without a slide"
        ),
        "slid": variable(dims, [given.has_slid(k) for k in each], "1", "1 where the realization slid, else 0", "i1"),
    }
    if given.receptors:
        for what, words in REACHED.items():
            reaches = [np.stack([given.reaches(k, what, name) for name in given.receptors], axis=1) for k in each]
            meaning = f"1 where {words.partition('that ')[2].replace('it', 'the receptor')}, else 0"
            variables[what] = variable((*dims, "receptor"), reaches, "1", meaning, "i1")
    return variables


def _of_measure(rows: list[Measure]) -> Variables:
    first = rows[0]
    dims = ("scenario", first.dim) if first.dim else ("scenario",)
    what = f"{first.variable.replace('_', ' ')} by {first.dim}" if first.dim else first.words
    variables = {}
    for name, (meaning, read) in DIFFERENCE.items():
        values = np.array([[read(each) for each in (_reference(row), *row.differences)] for row in rows])
        ordered = values.swapaxes(0, 1) if first.dim else values[0]
        along = (*dims, "bound") if ordered.ndim > len(dims) else dims
        kind = ("1", "i1") if name == IS_LEAST else (first.unit, "f8")
        variables[name.format(first.variable)] = variable(along, ordered, kind[0], meaning.format(what), kind[1])
    return variables


def _reference(measure: Measure) -> Difference:
    """Return the number of the first scenario, which has no difference from itself."""
    number, *_, is_least, _ = measure.differences[0]
    return Difference(number, number, unknown(math.nan, 0), math.nan, math.nan, is_least, is_least)


def _coordinates(given: Comparison, found: Sequence[Measure]) -> Variables:
    coordinates = {
        "scenario": texts("scenario", given.names, "directory of the campaign"),
        "realization": variable("realization", given.ids, "1", "realization", "i4"),
    }
    for dim, (unit, words) in DIMENSIONS.items():
        if places := list(dict.fromkeys(measure.at for measure in found if measure.dim == dim)):
            coordinates[dim] = variable(dim, places, unit, words)
    if given.receptors:
        coordinates["receptor"] = texts("receptor", given.receptors, "name of the receptor")
    return coordinates


def _attributes(given: Comparison, doubts: Sequence[str]) -> dict[str, str | float]:
    others = range(1, len(given.names))
    changes = [(given.names[k], change) for k in others for change in given.changes(k)]
    return {
        "Conventions": "CF-1.11",
        "title": f"Comparison of {', '.join(given.names)}",
        "source": f"runout-campaign {program_version()}",
        "history": f"{datetime.now(UTC).isoformat(timespec='seconds')} compared by campaign compare",
        "confidence": given.confidence,
        "front": given.front,
        "seeds": " ".join(str(each.scene.campaign.seed) for each in given.scenarios),
        "scene_sha256": " ".join(each.scene.digest() for each in given.scenarios),
        "changes": "\n".join(f"{name}: {each.key} = {each.other} instead of {each.first}" for name, each in changes),
        "comment": " ".join(doubts),
    }
