"""What a campaign measures of its own errors beyond sampling, once it has enough realizations.

Which runs that takes depends on the result alone, neither on ranks nor on interruptions.
"""

from typing import NamedTuple

from campaign.errors import RefusalError
from campaign.record import UNHINDERED
from campaign.running.level import Level
from campaign.running.side_run import Means, SideRun, make
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.statistics import discretisation
from campaign.statistics.discretisation import Discretisation
from campaign.statistics.release import OTHER, ReleaseComparison, with_other_release
from campaign.statistics.tally import Tally
from campaign.storage.layout import HALF_CELL, OTHER_RELEASE
from campaign.terminal import say


class BeyondSampling(NamedTuple):
    """What half the cell and what the other release protocol change, as far as known; why that is not all, or ""."""

    discretisation: Discretisation | None
    release: ReleaseComparison | None
    stopped: str


def beyond_sampling(scene: Scene, tally: Tally, means: Means) -> BeyondSampling:
    """Measure the errors beyond sampling of a whole campaign.

    Parameters
    ----------
    scene, tally
        Of the campaign.
    means
        To compute with.
    """
    pairs = min(scene.campaign.discretisation_pairs, tally.prefix)
    if pairs == 0 or tally.too_many_failed:
        return BeyondSampling(None, None, "")
    release, stopped = _with_other_release(scene, means)
    found, stopped_there = _with_half_cell(scene, tally, pairs, means._replace(stopped=means.stopped or stopped))
    return BeyondSampling(found, release, stopped or stopped_there)


def _with_other_release(scene: Scene, means: Means) -> tuple[ReleaseComparison | None, str]:
    """Run the deterministic run with the release protocol that the scene does not use."""
    other, loss = OTHER[scene.numerics.gravity], "What the release protocol changes cannot be estimated."
    try:
        level = Level(with_other_release(scene), means.home / OTHER_RELEASE)
    except RefusalError as refusal:
        say(f"{loss} {refusal}")
        return None, ""
    made = make(
        SideRun(level, f'Release protocol: the deterministic run again, with gravity = "{other}".', loss), means
    )
    if made.tally is None:
        return None, made.stopped
    return ReleaseComparison(other, made.tally.summaries[BASELINE]), made.stopped


def _with_half_cell(scene: Scene, tally: Tally, pairs: int, means: Means) -> tuple[Discretisation | None, str]:
    """Repeat the first realizations with half the cell; what has no run-out of its own needs no repetition."""
    level = Level(discretisation.with_half_cell(scene, pairs), means.home / HALF_CELL)
    announcement = (
        f"Discretisation error: {pairs} realizations and the deterministic run again, with cells of "
        f"{level.scene.numerics.cell:g} m."
    )
    loss = "The discretisation error cannot be estimated with half the cell."
    known = [summary for summary in tally.summaries.values() if summary.status not in UNHINDERED]
    made = make(SideRun(level, announcement, loss, known), means)
    if made.tally is None:
        return None, made.stopped
    return discretisation.estimate(scene, tally, made.tally), made.stopped
