"""The answer in ten seconds: does it slide, how far, and does it reach the places asked about."""

import math
from typing import NamedTuple

import numpy as np

from campaign.accuracy.foretold import Estimate
from campaign.report import estimates
from campaign.report.aimed import at_least
from campaign.report.cut_short import causes, in_one_clause
from campaign.report.places import Reach, reach_estimates
from campaign.report.raised import goes_ahead
from campaign.report.wording import bounds
from campaign.results.accuracy import reached_of
from campaign.results.results import Results
from campaign.statistics.intervals import Interval
from campaign.statistics.proportions import results_to_bound
from campaign.statistics.total import has_mesh_error
from campaign.statistics.wording import chance, chance_of_slide, chances, estimated_chance, least
from campaign.terminal import counted


class Tile(NamedTuple):
    """A number of the first screen: what it is, its value, its interval, and a remark ("" for none)."""

    name: str
    value: str
    interval: str
    remark: str


def tiles(results: Results) -> list[Tile]:
    """Return the numbers of the first screen, the probability of a slide first."""
    if not results.outcomes.usable:
        return []
    return [_slide(results), *_aimed(results), *_runouts(results)]


def _aimed(results: Results) -> list[Tile]:
    """Return the mean from all meshes and models, where an accuracy was asked for."""
    reached = reached_of(results.data)
    if reached is None:
        return []
    mean = reached.total
    remark = f"cells down to {reached.cells[0]:g} m; all else was counted with {results.scene.numerics.cell:g} m alone"
    return [
        Tile(
            "The front of a slide stops on average at",
            f"{at_least(reached)}{mean.estimate:.2f} m",
            bounds(mean, "m", ".2f"),
            remark,
        )
    ]


def reaches(results: Results) -> list[Tile]:
    """Return for each receptor how probable it is that a slide gets there."""
    reached = reached_of(results.data)
    from_all_models = {} if reached is None else reached.reaches
    tiles = [_reach(each) for each in reach_estimates(results)]
    return [_on_finest_mesh(tile, results, from_all_models.get(tile.name)) for tile in tiles]


def _on_finest_mesh(tile: Tile, results: Results, foretold: Estimate | None) -> Tile:
    """Return what all models together tell of a receptor, where they do, with what the scene's own cells count."""
    if foretold is None:
        return tile
    counted_here = f"counted with cells of {results.scene.numerics.cell:g} m alone: {tile.value}, {tile.interval}"
    remark = "; ".join(filter(None, [counted_here, tile.remark]))
    total = foretold.total
    return Tile(tile.name, estimated_chance(total), chances(total), remark)


def what_intervals_hold(results: Results) -> str:
    """Say what the intervals of the first screen hold."""
    mesh = "sampling and mesh" if has_mesh_error(results.discretisation) else "sampling alone"
    of_runouts = f"; those of the run-out hold {mesh}" if results.outcomes.slides else ""
    if has_mesh_error(results.discretisation) and results.outcomes.slides:
        of_runouts += ", those of probabilities sampling alone"
    return f"Intervals are at {100 * results.confidence:g} % confidence{of_runouts}. None holds the error of the model."


def _slide(results: Results) -> Tile:
    probability, given = estimates.slide_probability(results), results.outcomes
    failed = int(np.count_nonzero(results.has_failed))
    remark = f"{given.slides:,} of {counted(given.usable, 'simulated slope')} slid" + (
        f"; {failed} failed" if failed else ""
    )
    if given.slides in (0, given.usable):
        return Tile("Probability of a slide", chance_of_slide(probability), "", remark)
    return Tile("Probability of a slide", chance(probability.estimate), chances(probability), remark)


def _runouts(results: Results) -> list[Tile]:
    slides = results.outcomes.slides
    if not slides:
        return []
    if slides == 1:
        least = "at least " if results.outcomes.cut_short else ""
        runout = f"{least}{results.slide_runouts[0]:.2f} m"
        return [
            Tile("Run-out of the only slide", runout, "", in_one_clause(causes(results)) or "two slides tell how sure")
        ]
    names = {
        0.5: "Half of the fronts stop within",
        estimates.FAR: f"{100 * estimates.FAR:g} % stop within",
    }
    return [_runout(results, name, share) for share, name in names.items()]


def _runout(results: Results, name: str, share: float) -> Tile:
    total = estimates.total_quantile(results, share)
    form = ".1f" if total.estimate >= 1 else ".2f"
    return Tile(
        name, f"{least(total)}{total.estimate:{form}} m", bounds(total, "m", form), _remark(results, total, share)
    )


def _remark(results: Results, total: Interval, share: float) -> str:
    ahead = goes_ahead(results, share)
    raised = f"ground is raised {ahead}" if ahead else ""
    return "; ".join(filter(None, [_bounds_known(results, total, share), raised]))


def _bounds_known(results: Results, total: Interval, share: float) -> str:
    if total.is_least and not math.isfinite(total.upper):
        return f"lower bound: {in_one_clause(causes(results))}"
    if total.is_least:
        return f"the interval allows for {counted(results.outcomes.cut_short, 'slide')} cut short"
    needed = results_to_bound(1 - max(share, 1 - share), results.confidence)
    return f"both bounds need {needed} slides" if math.isnan(total.half_width) else ""


def _reach(each: Reach) -> Tile:
    front = each.front
    most = front.open_bounds[1]
    lost = (
        f"up to {chance(most)} if those that failed or were cut short got there" if most > front.interval.upper else ""
    )
    pushed = f"any moved ground: {estimated_chance(each.moved.interval)}, {chance_of_slide(each.moved.interval)}"
    remark = "; ".join(filter(None, [lost, pushed if each.is_pushed_farther else ""]))
    value = estimated_chance(front.interval)
    if front.interval.estimate == 0 and each.is_pushed_farther:
        value = f"front {value}, moved ground {estimated_chance(each.moved.interval)}"
    return Tile(front.receptor, value, chance_of_slide(front.interval), remark)
