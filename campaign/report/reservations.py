"""Why an answer is to be read with care."""

import numpy as np

from campaign.record import FINAL_RUNOUT, Status
from campaign.report import estimates
from campaign.report.answer import walls_in_words, why_failed
from campaign.report.raised import goes_ahead, least_rise
from campaign.results.results import Results
from campaign.statistics.doubts import detached_fronts, doubts
from campaign.statistics.wording import chance
from campaign.terminal import counted

MANY = 0.1
"""Share of the slides from which on walls decide the answer; fewer only make the mean a lower bound."""


def reasons_for_doubt(results: Results) -> list[str]:
    """Return sentences on why the run-outs or their intervals may not hold."""
    volumes, mass_runouts = results.of_slides("detached_volume"), results.of_slides(FINAL_RUNOUT["mass"])
    apart = detached_fronts(volumes, mass_runouts, results.scene.front_area, results.front)
    told = [_failed(results), _hindered(results), *doubts(results.runouts), *apart, _ahead(results), _moving(results)]
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


def _hindered(results: Results) -> str:
    hindered, slides = results.outcomes.hindered, results.outcomes.slides
    if hindered <= MANY * slides:
        return ""
    wall, stopped = walls_in_words(results), f"{hindered:,} of {counted(slides, 'slide')}"
    return f"{wall[0].upper()}{wall[1:]} stopped {stopped}, which would have come farther."


def _ahead(results: Results) -> str:
    """Say how far ground is raised ahead of the fronts."""
    half, far = goes_ahead(results, 0.5), goes_ahead(results, estimates.FAR)
    if half is None or far is None:
        return ""
    return (
        f"Ground is raised by {least_rise(results):.2g} m or more as far as {half:.1f} m from the toe in half of the "
        f"slides, and {far:.1f} m in {100 * estimates.FAR:g} % of them, farther than their fronts come: slid ground "
        "from upslope of the toe, the front, pushes and throws other ground ahead. Whether any of it reaches a place "
        "is told as moved ground."
    )


def _moving(results: Results) -> str:
    """Say how many slides had not come to rest, and what their fronts still did."""
    unsettled, n = results.by_status()[Status.not_settled], results.outcomes.slides
    if not unsettled:
        return ""
    bounds = "is a lower bound" if unsettled == 1 else "are lower bounds"
    told = f"{unsettled:,} of {counted(n, 'run-out')} {bounds}: still moving when the run ended (numerics.end_time)."
    return f"{told} {_last_advance(results)}"


def _last_advance(results: Results) -> str:
    """Say how far the fronts of slides that still moved came in the last tenth of the run."""
    name = "runout" if results.front == "tip" else "runout_mass"
    histories, time = results.data[name].values[results.has_status([Status.not_settled])], results.data["time"].values
    before = int(np.searchsorted(time, 0.9 * time[-1]))
    advance = histories[:, -1] - histories[:, before]
    still = float(np.mean(advance > 0.01))
    return (
        f"In the last {time[-1] - time[before]:.2g} s the fronts of {chance(still)} of these advanced by more than "
        f"1 cm, the farthest by {advance.max():.2f} m."
    )
