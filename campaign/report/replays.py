"""The slides that are simulated again for the figures: the deterministic one, the shortest, the median, the longest."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from campaign.errors import RefusalError
from campaign.report.figures.configurations import TIMES
from campaign.report.snapshots import ReplayedSlide, replay
from campaign.results.results import Results
from campaign.seeds import BASELINE
from campaign.simulation.ground import Ground, prepare
from campaign.simulation.solver_model import Array
from campaign.storage.access import check_digest

RANKS = {"shortest": 0.0, "median": 0.5, "longest": 1.0}
"""The slides to look at, and the share of run-outs below theirs."""

FRAMES = 21
"""Of a film; there are two in a second where a run ends after 10 s."""


class Replays(NamedTuple):
    """The slides simulated again."""

    ground: Ground
    deterministic: ReplayedSlide
    ranked: dict[str, ReplayedSlide]
    times: Array  # (t,) s, of the frames of a film


def replays(results: Results, directory: Path) -> tuple[Replays | None, list[str]]:
    """Simulate the slides to draw again, and say if they are not the recorded ones.

    Without a slide there is none to draw. Where it cannot be done, the page has fewer figures and a sentence.
    """
    if not results.outcomes.slides and not results.deterministic > 0:
        return None, []
    try:
        replayed = _simulated(results, directory)
    except RefusalError as refusal:
        return None, [str(refusal)]
    except Exception as error:
        return None, [f"The slides could not be simulated again for the figures ({error!r})."]
    return replayed, _differences(results, replayed)


def _simulated(results: Results, directory: Path) -> Replays:
    check_digest(results.scene, results.data.attrs["scene_sha256"])
    ground = prepare(results.scene, directory)
    times = np.linspace(0.0, results.scene.numerics.end_time, FRAMES)
    wanted = {results.ranked(share): share for share in RANKS.values()} if results.outcomes.slides else {}
    seen = {k: replay(ground, k, times.tolist() if share == RANKS["median"] else ()) for k, share in wanted.items()}
    ranked = {called: seen[results.ranked(share)] for called, share in RANKS.items()} if seen else {}
    return Replays(ground, replay(ground, BASELINE, [*TIMES, *times.tolist()]), ranked, times)


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
