"""What a reader of a comparison has to know: when pairs have less in common than they seem to, and what is a bound."""

from collections.abc import Iterator, Sequence

import numpy as np

from campaign.comparison.scenarios import Change, Comparison
from campaign.record import FAILED, Status
from campaign.results.results import Results
from campaign.simulation.field_size import field_size

FIELD = "field."
CRITERIA = ("slide.displaced", "slide.failed", "slide.front_area")
"""Keys that decide what is counted and not what happens."""

STOPPED = {Status.reached_wall: "the wall ahead", Status.not_settled: "the end of the run"}
"""What makes a run-out a lower bound."""


def doubts(given: Comparison) -> list[str]:
    """Return what has to be said of a comparison, a sentence each."""
    others = range(1, len(given.names))
    return [
        *_left_out(given),
        *(sentence for other in others for sentence in _of_pairs(given, other)),
        *(sentence for scenario in range(len(given.names)) for sentence in _of_runouts(given, scenario)),
        *_receptors(given),
    ]


def _left_out(given: Comparison) -> Iterator[str]:
    counts = [each.realizations for each in given.scenarios]
    if len(set(counts)) > 1:
        told = ", ".join(f"{n} in {name}" for name, n in zip(given.names, counts, strict=True))
        yield f"Of {told}, only the realizations that all have are compared."
    failed = [int(np.count_nonzero(each.has_status(FAILED))) for each in given.scenarios]
    if any(failed):
        told = ", ".join(f"{n} in {name}" for name, n in zip(given.names, failed, strict=True))
        yield f"Realizations that failed in any campaign are left out of all ({told})."


def _of_pairs(given: Comparison, other: int) -> Iterator[str]:
    (first, here), name = (given.names[0], given.scenarios[0]), given.names[other]
    there = given.scenarios[other]
    changes = given.changes(other)
    if here.scene.campaign.seed != there.scene.campaign.seed:
        yield (
            f"{name} has another seed than {first}, so their realizations have nothing in common: the differences "
            "hold, but are known no better than from independent campaigns. With the same seed they would be."
        )
    elif reason := _other_field(here, there, changes):
        yield (
            f"The random fields of {name} are not those of {first} ({reason}), so that pairs have less in common, or "
            "nothing: the standard errors show what pairing is worth."
        )
    if here.front != there.front:
        yield f"{name} reports the front of the {there.front}; here the run-out of all is that of the {here.front}."
    if here.scene.numerics.cell != there.scene.numerics.cell:
        yield f"The cells of {name} are not those of {first}, so the differences hold what the mesh changes as well."
    if here.data.attrs["realization_sha256"] != there.data.attrs["realization_sha256"]:
        yield (
            f"{name} was computed by another version of the solver than {first}, so the differences hold what that "
            "changed as well."
        )
    if counted := [each.key for each in changes if each.key in CRITERIA]:
        differ = "differs" if len(counted) == 1 else "differ"
        yield (
            f"{', '.join(counted)} {differ} between {name} and {first}: what counts as a slide, or as its front, is "
            "not the same."
        )


def _other_field(here: Results, there: Results, changes: Sequence[Change]) -> str:
    """Return why two scenes of the same seed draw different Gaussian fields, "" if they draw the same."""
    if changed := [each.key for each in changes if each.key.startswith(FIELD) or _is_own_field(each)]:
        return ", ".join(changed)
    one, two = field_size(here.scene), field_size(there.scene)
    if (one.shape, one.resolution) != (two.shape, two.resolution):
        return "the ground is of another width or height"
    return ""


def _is_own_field(change: Change) -> bool:
    """Whether a layer has a field of its own in one of two scenes."""
    is_of_layer = change.key.startswith("layer.") and change.key.endswith(".field")
    return is_of_layer and "own" in (change.first, change.other)


def _of_runouts(given: Comparison, scenario: int) -> Iterator[str]:
    results, name = given.scenarios[scenario], given.names[scenario]
    if results.data.attrs["solver_drift"] == "true":
        yield f"The realizations of {name} were computed by several versions of the solver."
    for status, what in STOPPED.items():
        if bounds := int(np.count_nonzero(results.has_status([status])[given.ids])):
            means = "" if given.is_cut_short(scenario) else "; so few of them are in the means as far as they came"
            yield (
                f"In {name} {what} stopped {bounds} of the {len(given.ids)} realizations: there the run-out is a lower "
                f"bound, and so are the numbers of {name} that are told as at least so much{means}."
            )
    if behind := int(np.count_nonzero(given.reached_behind(scenario))):
        yield (
            f"In {name} {behind} of the {len(given.ids)} realizations reach the wall behind the crest, which disturbs "
            "their run-outs: with more ground there they may be longer or shorter."
        )
    if given.has_least_volumes(scenario) and not given.is_cut_short(scenario):
        yield (
            f"The sliding volume of {name} is a lower bound: more ground would move, had the wall behind the crest or "
            "the end of the run not kept it from that."
        )


def _receptors(given: Comparison) -> Iterator[str]:
    named = [receptor.name for each in given.scenarios for receptor in each.scene.receptor]
    if missing := [name for name in dict.fromkeys(named) if name not in given.shared_names]:
        yield f"Left out are receptors that are not in all campaigns: {', '.join(missing)}."
    for name in given.shared_names:
        if not given.is_one_place(name):
            places = [
                f"{_stretch(*ends)} in {each}" for ends, each in zip(given.stretches(name), given.names, strict=True)
            ]
            yield f"Left out is {name}, which is another place in each campaign: {', '.join(places)}."


def _stretch(near: float, far: float) -> str:
    return f"x = {near:g} m" if near == far else f"x = {near:g} to {far:g} m"
