"""What came of an accuracy that was asked for: the mean run-out from all meshes and models together, in words."""

from campaign.accuracy.wording import error_of
from campaign.results.accuracy import Reached, reached_of
from campaign.results.results import Results
from campaign.scene.units import PRESSURE, shown_in_unit
from campaign.statistics.wording import chances, estimated_chance, least, metres
from campaign.terminal import counted, listing


def is_aimed(results: Results) -> bool:
    """Whether an accuracy was asked for, and something slid."""
    return reached_of(results.data) is not None


def from_all_models(results: Results) -> str:
    """Say how far the slide runs on average and what that rests on; "" where no accuracy was asked for."""
    reached = reached_of(results.data)
    if reached is None:
        return ""
    mean, change, _ = reached.limit
    asked = results.scene.campaign.accuracy
    met = f"{asked} were asked" if reached.is_reached else f"not the {asked} that were asked"
    return " ".join(
        filter(
            None,
            [
                f"The slide runs {at_least(reached)}{mean.estimate:.2f} m on average, {metres(reached.total)} with "
                f"{100 * results.confidence:g} % confidence for sampling and mesh together: "
                f"{error_of(reached.limit)}, {met}.",
                f"That is the mean with cells of {reached.cells[0]:g} m, sampling ±{mean.half_width:.2f} m; the last "
                f"halving of the cell changed it by {change.estimate:+.2f} ± {change.half_width:.2f} m, and the "
                "interval holds as much again in either direction.",
                _cut_short(reached),
                _distribution(reached),
                f"It rests on {models_in_words(reached)}.",
                f"All that follows is counted with cells of {results.scene.numerics.cell:g} m alone.",
            ],
        )
    )


def _distribution(reached: Reached) -> str:
    """Say how far single slides run on the finest mesh, and how probably they reach the places asked about."""
    if not reached.quantiles:
        return ""
    totals = {share: each.total for share, each in reached.quantiles.items()}
    within = [
        f"{100 * share:g} % of the slides stop within {least(total)}{total.estimate:.2f} m ({metres(total)})"
        for share, total in totals.items()
    ]
    there = [
        f"{estimated_chance(each.total)} ({chances(each.total)}) come as far as {name}"
        for name, each in reached.reaches.items()
    ]
    beyond = f"; of all slopes {listing(there)}" if there else ""
    return f"Foretold for that mesh from all models, for sampling and mesh, {listing(within)}{beyond}."


def at_least(reached: Reached) -> str:
    """Return what to put before the mean: "at least " where more than a few runs were cut short."""
    return "" if reached.bounds_the_mean else "at least "


def _cut_short(reached: Reached) -> str:
    """Say what makes the mean a lower bound."""
    count, of = reached.cut_short[0], reached.counts[0]
    if not count:
        return ""
    return (
        f"It is a lower bound: {count} of {counted(of, 'run')} on that mesh met the wall ahead, or their fronts may "
        "have come farther after the end."
    )


def models_in_words(reached: Reached) -> str:
    """Say how many realizations each model has run, the finest mesh first."""
    stiffest = max(reached.young_moduli)
    told = [
        f"{count} with {cell:g} m" + ("" if modulus == stiffest else f" and E = {shown_in_unit(modulus, PRESSURE)}")
        for count, cell, modulus in zip(reached.counts, reached.cells, reached.young_moduli, strict=True)
    ]
    return listing([told[0].replace("with", "runs with cells of", 1), *told[1:]])
