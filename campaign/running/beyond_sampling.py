"""What a campaign measures of its own errors beyond sampling, once it has enough realizations.

Which runs that takes depends on the result alone, neither on ranks nor on interruptions.
"""

from collections.abc import Sequence
from typing import NamedTuple

from campaign.record import UNHINDERED
from campaign.running.changed_inputs import with_changed_inputs
from campaign.running.side_run import Means, SideRun, make
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.statistics import discretisation
from campaign.statistics.changed_inputs import InputEffects, first_slides
from campaign.statistics.discretisation import Discretisation
from campaign.statistics.release import OTHER, ReleaseComparison, with_other_release
from campaign.statistics.tally import Tally
from campaign.storage.layout import HALF_CELL, OTHER_RELEASE
from campaign.terminal import counted


class BeyondSampling(NamedTuple):
    """What is known besides: why that is not all, or "", and what half the cell, release and inputs change."""

    stopped: str
    discretisation: Discretisation | None = None
    release: ReleaseComparison | None = None
    inputs: InputEffects | None = None


def beyond_sampling(scene: Scene, tally: Tally, means: Means, repeated: int | None = None) -> BeyondSampling:
    """Measure the errors beyond sampling of a whole campaign, and what it owes to its inputs.

    Parameters
    ----------
    scene, tally
        Of the campaign.
    means
        To compute with.
    repeated
        Number of realizations that half the cell has run already, where an accuracy asked for them.
    """
    if tally.too_many_failed:
        return BeyondSampling("")
    release, found, lacking = None, None, ""
    if repeated or scene.campaign.discretisation_pairs:
        release, lacking = _with_other_release(scene, means)
        slides = first_slides(tally, scene.campaign.discretisation_pairs)
        found, stopped = _with_half_cell(scene, tally, range(repeated) if repeated else slides, means.after(lacking))
        lacking = lacking or stopped
    inputs, stopped = with_changed_inputs(scene, tally, means.after(lacking))
    return BeyondSampling(lacking or stopped, found, release, inputs)


def _with_other_release(scene: Scene, means: Means) -> tuple[ReleaseComparison | None, str]:
    """Run the deterministic run with the release protocol that the scene does not use."""
    other = OTHER[scene.numerics.gravity]
    run = SideRun(
        scene=lambda: with_other_release(scene),
        directory=means.home / OTHER_RELEASE,
        announcement=f'Release protocol: the deterministic run again, with gravity = "{other}".',
        loss="What the release protocol changes cannot be estimated.",
    )
    made = make(run, means)
    if made.tally is None:
        return None, made.stopped
    return ReleaseComparison(other, made.tally.summaries[BASELINE]), made.stopped


def _with_half_cell(
    scene: Scene, tally: Tally, pairs: Sequence[int], means: Means
) -> tuple[Discretisation | None, str]:
    """Repeat realizations with half the cell; what has no run-out of its own needs no repetition."""
    finer = discretisation.with_half_cell(scene, max(pairs, default=0) + 1)
    wanted = {BASELINE, *pairs}
    asked = {k for k, summary in tally.summaries.items() if k in wanted and summary.status in UNHINDERED}
    run = SideRun(
        scene=lambda: finer,
        directory=means.home / HALF_CELL,
        announcement=f"Discretisation error: {repeated_words(asked)} again, with cells of {finer.numerics.cell:g} m.",
        loss="The discretisation error cannot be estimated with half the cell.",
        known=[summary for k, summary in tally.summaries.items() if k not in asked],
    )
    made = make(run, means)
    if made.tally is None:
        return None, made.stopped
    return discretisation.estimate(scene, tally, made.tally, asked), made.stopped


def repeated_words(asked: set[int]) -> str:
    """Say which of the slides and the deterministic run are repeated."""
    slides = asked - {BASELINE}
    told = [counted(len(slides), "slide")] if slides else []
    return " and ".join([*told, *(["the deterministic run"] if BASELINE in asked else [])])
