"""Why an answer is to be read with care."""

import numpy as np

from campaign.record import FAILED, FINAL_RUNOUT, SLID, Status
from campaign.report import estimates
from campaign.report.answer import why_failed
from campaign.report.cut_short import END, WALLS, bounded_behind, causes
from campaign.report.raised import goes_ahead, least_rise
from campaign.results.results import Results
from campaign.statistics.doubts import detached_fronts, doubts
from campaign.statistics.outcomes import FEW
from campaign.terminal import as_sentence, counted


def reasons_for_doubt(results: Results) -> list[str]:
    """Return sentences on why the run-outs or their intervals may not hold."""
    volumes, mass_runouts = results.of_slides("detached_volume"), results.of_slides(FINAL_RUNOUT["mass"])
    apart = detached_fronts(volumes, mass_runouts, results.scene.front_area, results.front)
    slid = [
        _hindered(results),
        bounded_behind(results),
        *doubts(results.runouts),
        *apart,
        _ahead(results),
        _moving(results),
    ]
    told = [_failed(results), _beginning(results), *slid]
    return [sentence for sentence in told if sentence]


def _failed(results: Results) -> str:
    failed = int(np.count_nonzero(results.has_failed))
    if not results.outcomes.usable or failed <= results.scene.campaign.max_failed_fraction * results.realizations:
        return ""
    why = f" (the most frequent reason: {why_failed(results).rstrip('.')})" if why_failed(results) else ""
    return (
        f"{failed:,} of {counted(results.realizations, 'realization')} failed{why}. What is told of the "
        "others need not hold for those."
    )


def _beginning(results: Results) -> str:
    """Say that the way to begin decides whether the slope slides, where it does so for mean strengths."""
    run, found = results.deterministic_run, results.release
    if found is None or {run.status, found.summary.status} & FAILED:
        return ""
    slides = {
        results.scene.numerics.gravity: run.status in SLID,
        found.other: found.summary.status in SLID,
    }
    if len(set(slides.values())) == 1:
        return ""
    by = {has_slid: protocol for protocol, has_slid in slides.items()}
    return (
        "How failure begins decides whether the slope slides: with mean strengths it slides with gravity = "
        f'"{by[True]}" and stands with "{by[False]}". The probability of a slide holds for '
        f'"{results.scene.numerics.gravity}" alone; repeat the campaign with the other, and compare.'
    )


def _hindered(results: Results) -> str:
    if results.outcomes.hindered <= FEW * results.outcomes.slides:
        return ""
    (stopped,) = (each.told for each in causes(results) if each.source == WALLS)
    return as_sentence(f"{stopped}, which would have come farther")


def _ahead(results: Results) -> str:
    """Say how far ground is raised ahead of the fronts."""
    half, far = goes_ahead(results, 0.5), goes_ahead(results, estimates.FAR)
    if not half:
        return ""
    rise = f"{least_rise(results):.2g} m or more (half a cell, the least that the mesh can tell)"
    return (
        f"Ground is raised by {rise} {half} from the toe in half of the slides, and {far} in "
        f"{100 * estimates.FAR:g} % of them, farther than their fronts come: slid ground from upslope of the toe, the "
        "front, pushes and throws other ground ahead. Whether any of it reaches a place is told as moved ground."
    )


def _moving(results: Results) -> str:
    """Say how many slides had not come to rest, and what their fronts still did."""
    for cause in causes(results):
        if cause.source == END:
            bounds = "its run-out is a lower bound" if cause.slides == 1 else "their run-outs are lower bounds"
            return f"{as_sentence(f'{cause.told} (numerics.end_time): {bounds}')} {_last_advance(results)}"
    return ""


def _last_advance(results: Results) -> str:
    """Say how far the fronts of slides that still moved came in the last tenth of the run."""
    name = "runout" if results.front == "tip" else "runout_mass"
    histories, time = results.data[name].values[results.has_status([Status.not_settled])], results.data["time"].values
    before = int(np.searchsorted(time, 0.9 * time[-1]))
    advance = histories[:, -1] - histories[:, before]
    lately = f"In the last {time[-1] - time[before]:.2g} s"
    if advance.size == 1:
        return f"{lately} its front advanced by {advance[0]:.2f} m."
    still = int(np.count_nonzero(advance > 0.01))
    return (
        f"{lately} the fronts of {still or 'none'} of these {advance.size:,} advanced by more than 1 cm, the farthest "
        f"by {advance.max():.2f} m."
    )
