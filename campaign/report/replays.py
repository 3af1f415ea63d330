"""The slides that are simulated again for the figures: the deterministic one, the shortest, the median, the longest."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from campaign.errors import RefusalError
from campaign.report.kept_slides import kept_slide, slide_again
from campaign.report.snapshots import ReplayedSlide, frame_times
from campaign.results.results import Results
from campaign.seeds import BASELINE
from campaign.simulation.ground import Ground, prepare
from campaign.simulation.solver_model import Array
from campaign.storage.access import check_digest

RANKS = {"shortest": 0.0, "median": 0.5, "longest": 1.0}
"""The slides to look at, and the share of run-outs below theirs."""


class Replays(NamedTuple):
    """The slides simulated again."""

    ground: Ground
    deterministic: ReplayedSlide
    ranked: dict[str, ReplayedSlide]
    times: Array  # (t,) s, of the frames of a film


def shown_slides(results: Results) -> dict[str, int]:
    """Return the slides that are drawn, by their rank and "deterministic"; without a slide there is none to draw."""
    if not results.outcomes.slides:
        return {"deterministic": BASELINE} if results.deterministic > 0 else {}
    return {"deterministic": BASELINE} | {called: results.ranked(share) for called, share in RANKS.items()}


def replays(results: Results, directory: Path, simulate: bool) -> tuple[Replays | None, list[str]]:
    """Return the slides to draw, and say if they are not the recorded ones.

    Where it cannot be done, the page has fewer figures and a sentence.

    Parameters
    ----------
    results, directory
        Of the campaign.
    simulate
        Whether to simulate again what is not kept there.
    """
    shown = shown_slides(results)
    if not shown:
        return None, []
    try:
        replayed = _replayed(results, directory, shown, simulate)
    except RefusalError as refusal:
        return None, [str(refusal)]
    except Exception as error:
        return None, [f"The slides could not be simulated again for the figures ({error!r})."]
    return replayed, _differences(results, replayed)


def _replayed(results: Results, directory: Path, shown: dict[str, int], simulate: bool) -> Replays:
    check_digest(results.scene, results.data.attrs["scene_sha256"])
    ground = prepare(results.scene, directory)
    seen = {k: _slide(ground, directory, k, simulate) for k in dict.fromkeys(shown.values())}
    ranked = {called: seen[k] for called, k in shown.items() if called in RANKS}
    return Replays(ground, seen[BASELINE], ranked, frame_times(results.scene.numerics.end_time))


def _slide(ground: Ground, directory: Path, realization: int, simulate: bool) -> ReplayedSlide:
    if simulate:
        return slide_again(ground, directory, realization)
    if found := kept_slide(ground, directory, realization):
        return found
    raise RefusalError(
        "Single slides are not drawn, because some would have to be simulated again; "
        f"that is what campaign report {directory} does."
    )


def _differences(results: Results, replayed: Replays) -> list[str]:
    drawn = {slide.realization: slide for slide in (replayed.deterministic, *replayed.ranked.values())}
    different = [
        "the run with mean strengths" if realization == BASELINE else f"realization {realization}"
        for realization, slide in drawn.items()
        if not np.array_equal(slide.record.values["final_runout"], results.final_runout(realization), equal_nan=True)
    ]
    if not different:
        return []
    return [
        f"Simulated again for the drawings, {', '.join(different)} did not come out exactly as recorded: the solver, a "
        "library or the kind of processor has changed since the campaign ran."
    ]
