"""The answer of a campaign in words, and how sure it is: rows for the report."""

from typing import NamedTuple

import numpy as np

from campaign.doubts import detached_fronts, doubts
from campaign.record import FAILED, USABLE, Status
from campaign.results import Results
from campaign.statistics import (
    Interval,
    failure_bounds,
    mean_interval,
    proportion_interval,
    quantile_interval,
    std_interval,
)

FAR = 0.95
"""The share of slides that stop before the distance named in the answer."""

NOT_ESTIMATED = "not estimated"

OUTCOMES = {
    Status.slid: "slid and came to rest",
    Status.no_slide: "did not slide (nothing displaced farther than slide.failed)",
    Status.not_settled: "still moving at the end time; the run-out is a lower bound",
    Status.timeout: "failed: took too long",
    Status.diverged: "failed: diverged",
    Status.left_domain: "failed: left the domain",
    Status.crashed: "failed: crashed",
}


class Row(NamedTuple):
    """A line of the error budget."""

    source: str
    quantity: str
    value: str
    interval: str
    n: str


class Outcome(NamedTuple):
    """How many realizations ended in one way, and why they say they failed."""

    realizations: int
    meaning: str
    reasons: list[str]


def answer(results: Results) -> str:
    """Return the result in a paragraph, the number that was asked for first."""
    runouts, confidence = results.usable_runouts, results.confidence
    if runouts.size == 0:
        return f"No slide: none of the {results.realizations} realizations gave a run-out."
    mean = mean_interval(runouts, confidence)
    if not mean.is_known:
        return f"One slide ran {runouts[0]:.2f} m. It takes more of them to say how sure that is."
    sentences = [
        f"The slide runs {mean.estimate:.2f} ± {mean.half_width:.2f} m on average ({100 * confidence:g} % confidence, "
        f"{runouts.size} slides).",
        _spread(results),
        _farthest(results),
        _comparison(results),
        _beyond_sampling(results),
    ]
    return " ".join(filter(None, sentences))


def error_budget(results: Results) -> list[Row]:
    """Return what the answer's uncertainty consists of."""
    return [*_sampling(results), *_failures(results), _discretisation(results), _energy(results)]


def modelling_choices(results: Results) -> dict[str, str]:
    """Return the choices that the answer rests on and that no interval contains, by name."""
    scene = results.scene
    numerics, field = scene.numerics, scene.field
    kind = field.length_kind.replace("-", " ")
    release = "elastic stresses at rest under gravity, then the strength at time 0"
    ramp = f"gravity grows over {numerics.ramp_time:g} s while the ground yields"
    return {
        "Release": f"{numerics.gravity}: {ramp if numerics.gravity == 'ramp' else release}",
        "Softening": _softening(results),
        "Volumetric locking": f"treatment: {numerics.locking}",
        "Method": f"{numerics.basis} basis, {numerics.stress_update} stress update, cells of {numerics.cell:g} m with "
        f"{numerics.particles_per_cell} particles, FLIP share {numerics.flip:g}",
        "Correlation": f"{field.correlation}, {kind} {field.horizontal:g} m along and {field.vertical:g} m across",
        "Cross-correlation": f"{field.cross_correlation:g} between cohesion and friction angle "
        f"({field.cross_correlation_of} fields)",
    }


def reasons_for_doubt(results: Results) -> list[str]:
    """Return sentences on why the intervals may not hold."""
    unsettled, n = results.by_status()[Status.not_settled], results.usable_runouts.size
    censored = f"{unsettled} of the {n} run-outs are lower bounds: those slides were still moving at numerics.end_time."
    apart = detached_fronts(results.detached_volumes, results.scene.slide.front_area)
    return [*doubts(results.runouts), *apart, *([censored] if unsettled else [])]


def outcomes(results: Results) -> list[Outcome]:
    """Return how the realizations ended, with the distinct reasons of failures and flags."""
    reasons, status = results.data["reason"].values, results.data["status"].values
    return [
        Outcome(count, OUTCOMES[each], sorted({str(reason) for reason in reasons[status == int(each)]} - {""}))
        for each, count in results.by_status().items()
        if count
    ]


def metres(interval: Interval) -> str:
    """Write the bounds of an interval in m."""
    return f"{interval.lower:.2f} to {interval.upper:.2f} m" if interval.is_known else "not enough slides"


def percents(interval: Interval) -> str:
    """Write the bounds of a probability in per cent."""
    return f"{100 * interval.lower:.0f} to {100 * interval.upper:.0f} %" if interval.is_known else "not enough slides"


def exceedance_interval(results: Results) -> Interval:
    """Return the share of slides that run farther than the deterministic one."""
    runouts = results.usable_runouts
    return proportion_interval(int(np.count_nonzero(runouts > results.deterministic)), runouts.size, results.confidence)


def _spread(results: Results) -> str:
    std, runouts = std_interval(results.usable_runouts, results.confidence), results.usable_runouts
    interval = f" ({metres(std)})" if std.is_known else ""
    return (
        f"Single slides scatter about that by a standard deviation of {std.estimate:.2f} m{interval}; the shortest ran "
        f"{runouts.min():.2f} m, the longest {runouts.max():.2f} m."
    )


def _farthest(results: Results) -> str:
    far = quantile_interval(results.usable_runouts, FAR, results.confidence)
    if not far.is_known:
        return ""
    return f"{100 * FAR:g} % of the slides stop within {far.estimate:.2f} m ({metres(far)})."


def _comparison(results: Results) -> str:
    if not np.isfinite(results.deterministic):
        return "The deterministic run failed, so there is nothing to compare with."
    share = exceedance_interval(results)
    return (
        f"With mean strengths everywhere it would run {results.deterministic:.2f} m, which "
        f"{100 * share.estimate:.0f} % of the slides exceed ({percents(share)})."
    )


def _beyond_sampling(results: Results) -> str:
    found = results.discretisation
    if found is None or found.interval.n == 0:
        return "These are sampling errors; the errors of the mesh and of the model are not among them."
    return (
        f"These are sampling errors; the mesh adds about {found.error:.2f} m to that of the mean (half the cell "
        f"changes it by {_change(found.interval)}), the model an unknown one."
    )


def _change(mean: Interval) -> str:
    return f"{mean.estimate:+.2f} ± {mean.half_width:.2f} m" if mean.is_known else f"{mean.estimate:+.2f} m"


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
    failed = sum(count for status, count in results.by_status().items() if status in FAILED)
    n = sum(count for status, count in results.by_status().items() if status in USABLE)
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
    if errors.size == 0:
        return Row("Energy balance", "created or lost, of the energy released", "no slide", "", "0")
    name = "created or lost, of the energy released"
    median, largest = f"{100 * np.median(errors):.2g} % (median)", f"at most {100 * errors.max():.2g} %"
    return Row("Energy balance", name, median, largest, str(errors.size))


def _softening(results: Results) -> str:
    softening, cell = results.scene.soil.softening, results.scene.numerics.cell
    if softening.law == "none":
        return "none"
    if softening.internal_length is not None:
        average = f"plastic strain averaged over {softening.internal_length:g} m"
        return f"{softening.law} with {average}, rate {softening.rate:g}"
    return (
        f"{softening.law} with plastic strain, rate {softening.rate_at(cell):g} at this cell, in proportion to its "
        f"size ({softening.rate:g} at {softening.reference_cell:g} m)"
    )


def _known(value: float, form: str, unit: str) -> str:
    return f"{value:{form}}{unit}" if np.isfinite(value) else "not enough slides"
