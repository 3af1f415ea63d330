"""The answer of a campaign in words, for the terminal and the report."""

import math
import re
from collections.abc import Iterable
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.record import Status
from campaign.report import estimates
from campaign.report.aimed import from_all_models, is_aimed
from campaign.report.cut_short import Cause, causes, disturbed, in_one_clause
from campaign.results.results import Results
from campaign.simulation.flags import with_remedy
from campaign.statistics.intervals import Interval
from campaign.statistics.proportions import results_to_bound
from campaign.statistics.stopping import RARE
from campaign.statistics.total import has_mesh_error
from campaign.statistics.wording import (
    at_least,
    chance,
    chance_of_slide,
    chances,
    estimated_chance,
    least,
    metres,
    so_far,
)
from campaign.terminal import as_sentence, counted

OUTCOMES = {
    Status.slid: "slid and came to rest",
    Status.no_slide: "did not slide (nothing displaced farther than slide.failed)",
    Status.not_settled: "slid, and the front may have come farther after the end time; the run-out is a lower bound",
    Status.reached_wall: "slid as far as the wall ahead of the slope; the run-out is a lower bound",
    Status.timeout: "failed: took too long",
    Status.diverged: "failed: diverged",
    Status.left_domain: "failed: left the domain",
    Status.crashed: "failed: crashed",
}


FRONT_SETTLED = "slid; the front comes no farther, but ground behind it still moved at the end time"
"""How slides ended that have not come to rest and yet have their run-out."""

VARYING = re.compile(r"[\d.]+(?= s\b| ?%)")
"""Numbers of a reason that are those of one realization."""


SENTENCES = re.compile(r"(?<=\.) (?=[A-Z])")
"""What parts sentences."""


RARER = 0.01
"""A probability of a slide that one may want to be bounded by, where slides are known to be rare."""


class Outcome(NamedTuple):
    """How many realizations ended in one way, and what is said of some of them, of the most first."""

    realizations: int
    meaning: str
    reasons: list[str]


def answer(results: Results) -> str:
    """Return the result in a paragraph, the number that was asked for first."""
    outcomes = results.outcomes
    if outcomes.usable == 0:
        none = f"No answer: {counted(results.realizations, 'realization')}, and none with a result."
        return " ".join(filter(None, [none, why_failed(results)]))
    of_slides = _slides(results) if outcomes.slides else []
    parts = [_chance(results), from_all_models(results), *of_slides, _comparison(results), _beyond(results)]
    return " ".join(filter(None, parts))


def outcomes(results: Results) -> list[Outcome]:
    """Return how the realizations ended, with the distinct reasons of failures and remarks on slides."""
    ways = {OUTCOMES[status]: results.has_status([status]) for status in Status}
    slid, at_rest = ways[OUTCOMES[Status.slid]], np.isfinite(results.data["settle_time"].values)
    ways = {OUTCOMES[Status.slid]: slid & at_rest, FRONT_SETTLED: slid & ~at_rest} | {
        meaning: which for meaning, which in ways.items() if meaning != OUTCOMES[Status.slid]
    }
    counts = {meaning: int(np.count_nonzero(which)) for meaning, which in ways.items()}
    return [Outcome(n, meaning, _told_of(results, ways[meaning], n)) for meaning, n in counts.items() if n]


def _told_of(results: Results, which: NDArray[np.bool_], count: int) -> list[str]:
    """Return what is said of realizations that ended in one way, and of how many, if that is not all."""
    reasons = map(str, results.data["reason"].values[which])
    # What is said of slides is a sentence for each matter, of which a slide may have several; a failure has one reason.
    are_slides = bool(results.has_slid[which].all())
    kinds = alike(chain.from_iterable(map(SENTENCES.split, reasons)) if are_slides else reasons)
    return [
        f"{'' if n == count else f'In {n:,} of them: '}{with_remedy(reason, results.scene)}"
        for reason, n in kinds.items()
    ]


def alike(reasons: Iterable[object]) -> dict[str, int]:
    """Return one of the reasons that differ in times and shares alone, and how many these are, the most first."""
    kinds: dict[str, list[str]] = {}
    for reason in filter(None, map(str, reasons)):
        kinds.setdefault(VARYING.sub("", reason), []).append(reason)
    return {kind[0]: len(kind) for kind in sorted(kinds.values(), key=len, reverse=True)}


def why_failed(results: Results) -> str:
    """Return the most frequent reason of failures, with what can be done about it, "" without one."""
    reasons = alike(results.data["reason"].values[results.has_failed])
    return with_remedy(next(iter(reasons)), results.scene) if reasons else ""


def _chance(results: Results) -> str:
    """Say how probable a slide is."""
    probability, given = estimates.slide_probability(results), results.outcomes
    with_result = " with a result" if results.has_failed.any() else ""
    seen = f"{given.slides:,} of {counted(given.usable, 'realization')}{with_result}"
    within, confidence = chance_of_slide(probability), f"{100 * results.confidence:g} % confidence"
    if given.slides == 0:
        stable = "It does not slide: " if probability.upper <= RARE else ""
        more = _bounded_by_less(results) if stable else _not_yet_rare(results)
        return f"{stable}{seen} slid, so the probability of a slide is {within} ({confidence}). {more}"
    if given.slides < given.usable:
        within = f"{chance(probability.estimate)}, {within}"
    return f"{seen} slid: the probability of a slide is {within} ({confidence})."


def _bounded_by_less(results: Results) -> str:
    """Say how to ask for more than that slides are rare."""
    number = results_to_bound(RARER, results.confidence)
    block = results.scene.campaign.block
    looked_at = block * math.ceil(number / block)
    is_too_many = looked_at > results.scene.campaign.realizations
    raised = f", and raise campaign.realizations to {looked_at} or more" if is_too_many else ""
    return (
        f"About {number:,} realizations without a slide bound it by {100 * RARER:g} %: ask for "
        f"campaign.slide_probability_tolerance = {RARER / 2:g}, which is half of that{raised}."
    )


def _not_yet_rare(results: Results) -> str:
    """Say how many realizations without a slide show that slides are rare."""
    number = results_to_bound(RARE, results.confidence)
    return f"It takes {number:,} without a slide to bound it by {100 * RARE:g} %."


def _slides(results: Results) -> list[str]:
    """Say how far slides come, and what is open of that."""
    cut_short = _cut_short(results, causes(results))
    return [_runout(results), cut_short, disturbed(results), _spread(results), _farthest(results)]


def _runout(results: Results) -> str:
    """Say how far the slide runs on average, with the total interval and what it consists of."""
    total, mean = estimates.total_runout(results), estimates.mean_runout(results)
    if mean.n == 1:
        return (
            f"That slide ran {least(mean)}{mean.estimate:.2f} m. It takes two slides or more to say how sure that is."
        )
    given = " where it slides" if mean.n < results.outcomes.usable else ""
    if is_aimed(results):
        ran = f"{least(mean)}{mean.estimate:.2f} m"
        return f"The slides of these cells ran {ran} on average, sampling ±{mean.half_width:.2f} m."
    return (
        f"The slide runs {least(total)}{total.estimate:.2f} m on average{given}, {metres(total)} with "
        f"{100 * results.confidence:g} % confidence: {_parts(results, mean)}."
    )


def _parts(results: Results, mean: Interval) -> str:
    sampling, found = f"sampling ±{mean.half_width:.2f} m", results.discretisation
    if found is None or not has_mesh_error(found):
        return f"{sampling}; what the mesh adds is not estimated"
    change, cell, came = found.interval, results.scene.numerics.cell, so_far(results.outcomes)
    changes = f"changes it{came}," if came else "changes it"
    return (
        f"as counted with cells of {cell:g} m, {sampling}; half the cell {changes} by {change.estimate:+.2f} ± "
        f"{change.half_width:.2f} m, and the interval holds up to twice that"
    )


def _cut_short(results: Results, found: list[Cause]) -> str:
    """Say why a mean is a lower bound, and what that leaves open."""
    if not found:
        return ""
    why, remedies = in_one_clause(found), " ".join(cause.remedy for cause in found)
    if results.outcomes.bound_the_mean:
        added = float(np.sum(results.slide_runouts[results.outcomes.is_cut_short])) / results.outcomes.slides
        these = "it" if results.outcomes.cut_short == 1 else "they"
        return as_sentence(f"{why}: had {these} come twice as far, the mean would be {added:.2f} m larger")
    return f"This is a lower bound, and nothing bounds the mean from above: {why}. {remedies}"


def _spread(results: Results) -> str:
    std, runouts = estimates.std_runout(results), results.slide_runouts
    if runouts.size < 2:
        return ""
    is_bounded, of_longest = results.outcomes.bound_the_mean, "at least " if results.outcomes.cut_short else ""
    interval = f" ({metres(std)})" if std.is_known and is_bounded else ""
    came = "" if is_bounded else f"{so_far(results.outcomes)},"
    of_shortest = "at least " if results.outcomes.is_cut_short[runouts.argmin()] else ""
    return (
        f"Single slides{came} scatter by a standard deviation of {std.estimate:.2f} m{interval}; the shortest ran "
        f"{of_shortest}{runouts.min():.2f} m, the longest {of_longest}{runouts.max():.2f} m."
    )


def _farthest(results: Results) -> str:
    far = estimates.total_quantile(results, estimates.FAR)
    if np.isnan(far.upper):
        return ""
    within = f"{'a distance of ' if far.is_least else ''}{least(far)}{far.estimate:.2f} m"
    return f"{100 * estimates.FAR:g} % of the slides stop within {within} ({metres(far)})."


def _comparison(results: Results) -> str:
    run, distance, slides = results.deterministic_run, results.deterministic, results.outcomes.slides
    with_mean = "With mean strengths everywhere"
    if not np.isfinite(distance):
        return "The deterministic run failed, so there is nothing to compare with."
    if run.status is Status.no_slide:
        return f"{with_mean} it {'would not slide' if slides else 'does not slide either'}."
    if not slides:
        return f"{with_mean} it would slide and run {at_least(run)}{distance:.2f} m."
    farther, some = estimates.exceedance(results, distance), ""
    than = f" than these {distance:.2f} m" if at_least(run) else ""
    if slides < results.outcomes.usable:
        some = f", {estimated_chance(estimates.exceedance_given_sliding(results, distance))} of those that slide"
    return (
        f"{with_mean} it would run {at_least(run)}{distance:.2f} m; {estimated_chance(farther)} of all realizations "
        f"run farther{than} ({chances(farther)}){some}."
    )


def _beyond(results: Results) -> str:
    """Say what no interval holds."""
    return "The error of the model is in no interval." if results.outcomes.slides > 1 else ""
