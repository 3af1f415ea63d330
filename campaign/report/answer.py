"""The answer of a campaign in words, for the terminal and the report."""

from typing import NamedTuple

import numpy as np

from campaign.record import Status
from campaign.report.error_budget import exceedance_interval, metres, percents
from campaign.results.results import Results
from campaign.statistics.doubts import detached_fronts, doubts
from campaign.statistics.intervals import Interval, mean_interval, quantile_interval, std_interval

FAR = 0.95
"""The share of slides that stop before the distance named in the answer."""

OUTCOMES = {
    Status.slid: "slid and came to rest",
    Status.no_slide: "did not slide (nothing displaced farther than slide.failed)",
    Status.not_settled: "still moving at the end time; the run-out is a lower bound",
    Status.timeout: "failed: took too long",
    Status.diverged: "failed: diverged",
    Status.left_domain: "failed: left the domain",
    Status.crashed: "failed: crashed",
}


class Outcome(NamedTuple):
    """How many realizations ended in one way, and why they say they failed."""

    realizations: int
    meaning: str
    reasons: list[str]


def answer(results: Results) -> str:
    """Return the result in a paragraph, the number that was asked for first."""
    runouts, confidence = results.usable_runouts, results.confidence
    if runouts.size == 0:
        return f"No answer: none of the {results.realizations} realizations gave a run-out."
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


def reasons_for_doubt(results: Results) -> list[str]:
    """Return sentences on why the run-outs or their intervals may not hold."""
    unsettled, n = results.by_status()[Status.not_settled], results.usable_runouts.size
    censored = f"{unsettled} of the {n} run-outs are lower bounds: those slides were still moving at numerics.end_time."
    volumes, mass_runouts = results.usable("detached_volume"), results.usable("final_runout_mass")
    apart = detached_fronts(volumes, mass_runouts, results.scene.slide.front_area)
    return [*doubts(results.runouts), *apart, *([censored] if unsettled else [])]


def outcomes(results: Results) -> list[Outcome]:
    """Return how the realizations ended, with the distinct reasons of failures."""
    reasons, status = results.data["reason"].values, results.data["status"].values
    return [
        Outcome(count, OUTCOMES[each], sorted({str(reason) for reason in reasons[status == int(each)]} - {""}))
        for each, count in results.by_status().items()
        if count
    ]


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
