"""How sure the answer of a campaign is, and on what it rests, for the terminal and the report."""

from typing import NamedTuple

import numpy as np

from campaign.fields.properties import BY_NAME
from campaign.results.results import Results
from campaign.scene import Scene
from campaign.scene.sections import RandomField
from campaign.simulation.solver_model import softening_rate
from campaign.statistics.intervals import Interval, failure_bounds, mean_interval, proportion_interval, std_interval

NOT_ESTIMATED = "not estimated"


class Row(NamedTuple):
    """A line of the error budget; interval and number of values are "" where there are none."""

    source: str
    quantity: str
    value: str
    interval: str
    n: str


def error_budget(results: Results) -> list[Row]:
    """Return what the answer's uncertainty consists of."""
    return [*_sampling(results), *_failures(results), _discretisation(results), _energy(results)]


def modelling_choices(scene: Scene) -> dict[str, str]:
    """Return the choices that the answer rests on and that no interval contains, by name."""
    numerics, field = scene.numerics, scene.field
    kind = field.length_kind.replace("-", " ")
    release = "elastic stresses at rest under gravity, then the strength at time 0"
    ramp = f"gravity grows over {numerics.ramp_time:g} s while the ground yields"
    return {
        "Soil law": scene.soil.law,
        "Release": f"{numerics.gravity}: {ramp if numerics.gravity == 'ramp' else release}",
        "Softening": _softening(scene),
        "Volumetric locking": f"treatment: {numerics.locking}",
        "Method": f"{numerics.basis} basis, {numerics.stress_update} stress update, cells of {numerics.cell:g} m with "
        f"{numerics.particles_per_cell} particles, FLIP share {numerics.flip:g}",
        "Correlation": f"{field.correlation}, {kind} {field.horizontal:g} m along and {field.vertical:g} m across",
        "Cross-correlation": _cross_correlation(field),
    }


def exceedance_interval(results: Results) -> Interval:
    """Return the share of slides that run farther than the deterministic one."""
    runouts = results.usable_runouts
    return proportion_interval(int(np.count_nonzero(runouts > results.deterministic)), runouts.size, results.confidence)


def metres(interval: Interval) -> str:
    """Write the bounds of an interval in m."""
    return f"{interval.lower:.2f} to {interval.upper:.2f} m" if interval.is_known else "not enough slides"


def percents(interval: Interval) -> str:
    """Write the bounds of a probability in per cent."""
    return f"{100 * interval.lower:.0f} to {100 * interval.upper:.0f} %" if interval.is_known else "not enough slides"


def _sampling(results: Results) -> list[Row]:
    runouts, n = results.usable_runouts, str(results.usable_runouts.size)
    if runouts.size == 0:
        return [Row("Sampling", "run-out", "no slide", "", n)]
    mean, std = mean_interval(runouts, results.confidence), std_interval(results.usable_runouts, results.confidence)
    rows = [
        Row("Sampling", "mean run-out", f"{mean.estimate:.2f} m", metres(mean), n),
        Row("Sampling", "standard deviation", _known(std.estimate, ".2f", " m"), metres(std), n),
    ]
    if np.isfinite(results.deterministic):
        share = exceedance_interval(results)
        name = f"probability of more than {results.deterministic:.2f} m (deterministic)"
        rows.append(Row("Sampling", name, f"{100 * share.estimate:.0f} %", percents(share), n))
    return rows


def _failures(results: Results) -> list[Row]:
    failed, n = int(np.count_nonzero(results.has_failed)), results.usable_runouts.size
    if not failed or not n or not np.isfinite(results.deterministic):
        return []
    exceeding = int(np.count_nonzero(results.usable_runouts > results.deterministic))
    lowest, highest = failure_bounds(exceeding, n, failed)
    name = "the same probability, whatever the failed would have done"
    bounds = f"{100 * lowest:.0f} to {100 * highest:.0f} %"
    return [Row("Failures", name, f"{failed} failed", bounds, str(n + failed))]


def _discretisation(results: Results) -> Row:
    found = results.discretisation
    if found is None:
        remedy = "give campaign.discretisation_pairs, or repeat the campaign with half the cell and compare"
        return Row("Discretisation", "mean run-out", NOT_ESTIMATED, remedy, "")
    change, name = found.interval, f"mean run-out, by what cells of {found.cell / 2:g} m change"
    if change.n == 0:
        return Row("Discretisation", name, NOT_ESTIMATED, "no pair of run-outs counts", "0")
    bounds = f"{change.lower:+.2f} to {change.upper:+.2f} m" if change.is_known else "not enough pairs"
    return Row("Discretisation", name, f"{found.error:.2f} m ({change.estimate:+.2f} m)", bounds, str(change.n))


def _energy(results: Results) -> Row:
    errors = np.abs(results.data["energy_error"].values[results.is_usable])
    name = "created or lost, of the energy released"
    if errors.size == 0:
        return Row("Energy balance", name, "no slide", "", "0")
    median, largest = f"median {100 * np.median(errors):.2g} %", f"at most {100 * errors.max():.2g} %"
    return Row("Energy balance", name, median, largest, str(errors.size))


def _cross_correlation(field: RandomField) -> str:
    pairs = [
        f"{rho:g} between {BY_NAME[one].long_name} and {BY_NAME[other].long_name}"
        for (one, other), rho in field.cross_correlations().items()
    ]
    return f"{', '.join(pairs)} ({field.cross_correlation_of} fields)" if pairs else "none"


def _softening(scene: Scene) -> str:
    softening, rate = scene.soil.softening, softening_rate(scene)
    if softening.law == "none" or softening.rate is None:
        return "none"
    if softening.internal_length is not None:
        average = f"{softening.law} with plastic strain averaged over {softening.internal_length:g} m"
        factor = rate / softening.rate
        coarse = f", times {factor:.2g} because bands of these cells are thicker" if factor > 1.0 else ""
        return f"{average}, rate {softening.rate:g}{coarse}"
    return (
        f"{softening.law} with plastic strain, rate {rate:g} at this cell, in proportion to its "
        f"size ({softening.rate:g} at {softening.reference_cell:g} m)"
    )


def _known(value: float, form: str, unit: str) -> str:
    return f"{value:{form}}{unit}" if np.isfinite(value) else "not enough slides"
