"""How sure the answer of a campaign is, for the terminal and the report."""

from typing import NamedTuple

import numpy as np

from campaign.record import FAILED, Status
from campaign.report import aimed, estimates
from campaign.report.cut_short import WALLS, causes, reach_the_wall_behind
from campaign.results.accuracy import reached_of
from campaign.results.results import Results
from campaign.statistics.intervals import Interval
from campaign.statistics.proportions import failure_bounds
from campaign.statistics.total import has_mesh_error
from campaign.statistics.wording import at_least, chance, chances, estimated_chance, least, metres, so_far
from campaign.terminal import counted

NOT_ESTIMATED = "not estimated"

LOST = dict.fromkeys(FAILED, "failed") | {
    Status.reached_wall: "reached the wall ahead",
    Status.not_settled: "may have come farther after the end time",
}
"""Ends of a run after which its run-out is not that of the slope, in words."""

NO_RESULT = "no realization with a result"


class Row(NamedTuple):
    """A line of the error budget; interval and number of values are "" where there are none."""

    source: str
    quantity: str
    value: str
    interval: str
    n: str


def error_budget(results: Results) -> list[Row]:
    """Return what the answer's uncertainty consists of."""
    return [
        *_chance(results),
        *_aimed(results),
        *_runout(results),
        *_exceedance(results),
        *_cut_short(results),
        *_failures(results),
        *_unknown_to_the_mesh(results),
        *_discretisation(results),
        _release(results),
        _energy(results),
    ]


def _chance(results: Results) -> list[Row]:
    probability = estimates.slide_probability(results)
    value = chance(probability.estimate) if probability.n else NO_RESULT
    bounds = chances(probability) if probability.n else ""
    return [Row("Sampling", "probability of a slide", value, bounds, str(probability.n))]


def _aimed(results: Results) -> list[Row]:
    """Return the mean from all meshes and models, where an accuracy was asked for."""
    reached = reached_of(results.data)
    if reached is None:
        return []
    mean, change, _ = reached.limit
    value = f"{aimed.at_least(reached)}{mean.estimate:.2f} m"
    cell, n = reached.cells[0], str(mean.n)
    name = "mean run-out of a slide, from all meshes and models"
    return [
        Row("Total", f"{name}, sampling and mesh", value, metres(reached.total), n),
        Row("Sampling", f"{name}, with cells of {cell:g} m", f"{mean.estimate:.2f} m", metres(mean), n),
        Row("Discretisation", f"{name}, changed by cells of {cell:g} m", *_signed(change), n),
    ]


def _runout(results: Results) -> list[Row]:
    mean, std, n = estimates.mean_runout(results), estimates.std_runout(results), str(results.outcomes.slides)
    came = so_far(results.outcomes)
    if mean.n == 0:
        return []
    total, spread = estimates.total_runout(results), metres(std) if std.is_known else ""
    holds = "sampling and mesh" if has_mesh_error(results.discretisation) else "sampling alone"
    return [
        Row("Total", f"mean run-out of a slide, {holds}", f"{least(total)}{total.estimate:.2f} m", metres(total), n),
        Row("Sampling", f"mean run-out of a slide{came}", f"{mean.estimate:.2f} m", metres(mean), n),
        Row("Sampling", f"standard deviation of a slide{came}", _known(std.estimate, ".2f", " m"), spread, n),
    ]


def _exceedance(results: Results) -> list[Row]:
    distance = results.deterministic
    if not distance > 0 or not results.outcomes.usable:
        return []
    came = "as far as it came" if at_least(results.deterministic_run) else "the run-out"
    farther = f"more than {distance:.2f} m, {came} with mean strengths"
    rows = [_probability(f"probability of {farther}", estimates.exceedance(results, distance))]
    if 0 < results.outcomes.slides < results.outcomes.usable:
        rows.append(_probability("the same of a slide", estimates.exceedance_given_sliding(results, distance)))
    return rows


def _probability(name: str, share: Interval) -> Row:
    return Row("Sampling", name, estimated_chance(share), chances(share), str(share.n))


def _cut_short(results: Results) -> list[Row]:
    """Return what makes a mean a lower bound, and what disturbs it in either direction."""
    slides, name, behind = str(results.outcomes.slides), "mean run-out of a slide", reach_the_wall_behind(results)
    told = [Row(each.source, name, "at least", each.told, slides) for each in causes(results)]
    return told + ([Row(WALLS, name, "longer or shorter", behind, slides)] if behind else [])


def _failures(results: Results) -> list[Row]:
    failed, given, distance = int(np.count_nonzero(results.has_failed)), results.outcomes, results.deterministic
    if not failed or not given.usable:
        return []
    rows = [_whatever_happened("probability of a slide", given.slides, given.usable, failed)]
    if distance > 0:
        of_farther = given.beyond(distance), given.usable, failed, given.undecided(distance)
        rows.append(_whatever_happened(f"probability of more than {distance:.2f} m", *of_farther))
    return rows


def _whatever_happened(name: str, count: int, usable: int, failed: int, undecided: int = 0) -> Row:
    """Return what a share of all realizations may be: slides cut short before they count are as unknown as failures."""
    lowest, highest = failure_bounds(count, usable - undecided, failed + undecided)
    bounds = chances(Interval(lowest, lowest, highest, usable, is_least=lowest < highest))
    also, them = (" or cut short", f", {undecided} cut short") if undecided else ("", "")
    asked = f"{name}, whatever the failed{also} would have done"
    return Row("Failures", asked, f"{failed} failed{them}", bounds, str(usable + failed))


def _unknown_to_the_mesh(results: Results) -> list[Row]:
    """Return what is known of what the mesh does to the probability of a slide, where that is in doubt."""
    slides = results.outcomes.slides
    remedy, value, n = "repeat the campaign with half the cell and compare", NOT_ESTIMATED, ""
    found = results.discretisation
    if found is not None and found.standing:
        value, n = (
            f"{found.standing} of {counted(found.repeated, 'slide')} stand with half the cell",
            str(found.repeated),
        )
        remedy = f"slides that it adds are not known: {remedy}"
    is_open = slides < results.outcomes.usable or n
    return [Row("Discretisation", "probability of a slide, by the mesh", value, remedy, n)] if is_open else []


def _discretisation(results: Results) -> list[Row]:
    if not results.outcomes.slides and results.outcomes.usable:
        return []
    found = results.discretisation
    if found is None:
        remedy = "give campaign.discretisation_pairs, or repeat the campaign with half the cell and compare"
        if results.scene.campaign.discretisation_pairs:
            remedy = "the campaign ended before its pairs with half the cell"
        return [Row("Discretisation", "mean run-out of a slide", NOT_ESTIMATED, remedy, "")]
    change, came = found.interval, so_far(results.outcomes)
    name = f"mean run-out of a slide{came}, changed by cells of {found.cell / 2:g} m"
    if change.n == 0:
        return [Row("Discretisation", name, NOT_ESTIMATED, _why_no_pair(results), "0")]
    return [Row("Discretisation", name, *_signed(change), str(change.n))]


def _signed(change: Interval) -> tuple[str, str]:
    """Write a change and its bounds, "+0.21 m" and "+0.10 to +0.32 m"."""
    bounds = f"{change.lower:+.2f} to {change.upper:+.2f} m" if change.is_known else "not enough pairs"
    return f"{change.estimate:+.2f} m", bounds


def _why_no_pair(results: Results) -> str:
    """Say why no realization gave a run-out with both cells."""
    slides = results.outcomes.slides
    if not slides:
        return "nothing slid"
    if not results.outcomes.unhindered:
        return f"the wall ahead stopped {'the one slide' if slides == 1 else f'all {slides} slides'}"
    return "with half the cell, none slid to its end without a failure or the wall ahead in its way"


def _release(results: Results) -> Row:
    name, run, found = "run-out with mean strengths", results.deterministic_run, results.release
    if found is None:
        lacking = "the run with the other release protocol was not made"
        if not results.scene.campaign.discretisation_pairs:
            lacking += ", which goes with campaign.discretisation_pairs"
        return Row("Release", name, NOT_ESTIMATED, lacking, "")
    runs = {results.scene.numerics.gravity: run, found.other: found.summary}
    if lost := [f'{LOST[each.status]} with "{gravity}"' for gravity, each in runs.items() if each.status in LOST]:
        return Row("Release", name, NOT_ESTIMATED, f"this run {' and '.join(lost)}", "")
    if all(each.status is Status.no_slide for each in runs.values()):
        both = " and with ".join(f'"{by}"' for by in runs)
        return Row("Release", name, "no slide", f"the slope stands with {both}", "")
    own, other = (each.runout(results.front) for each in runs.values())
    share = f" ({100 * (other / own - 1):+.1f} %)" if own > 0 else ""
    both = ", ".join(f'{at_least(each)}{each.runout(results.front):.2f} m with "{by}"' for by, each in runs.items())
    return Row(
        "Release",
        f'{name}, changed by the other way to begin, gravity = "{found.other}"',
        f"{other - own:+.2f} m{share}",
        both,
        "",
    )


def _energy(results: Results) -> Row:
    errors = np.abs(results.of_slides("energy_error"))
    name = "created or lost, of the energy released"
    if errors.size == 0:
        return Row("Energy balance", name, "no slide" if results.outcomes.usable else NO_RESULT, "", "0")
    median, largest = f"median {100 * np.median(errors):.2g} %", f"at most {100 * errors.max():.2g} %"
    return Row("Energy balance", name, median, largest, str(errors.size))


def _known(value: float, form: str, unit: str) -> str:
    return f"{value:{form}}{unit}" if np.isfinite(value) else "not enough slides"
