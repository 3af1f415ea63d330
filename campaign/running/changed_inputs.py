"""The first slides of a campaign again, with more of one input at a time: which input the run-out owes most to.

Which runs that takes depends on the result alone, neither on ranks nor on interruptions.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from campaign.running.side_run import Made, Means, SideRun, make
from campaign.scene import Scene
from campaign.scene.inputs import MORE, Input, inputs_of, raised, shown, with_more
from campaign.statistics.changed_inputs import InputEffects, differences, first_slides
from campaign.statistics.repetition import without_rule
from campaign.statistics.tally import Tally
from campaign.storage.layout import CHANGED_INPUTS
from campaign.terminal import counted


class Found(NamedTuple):
    """What more of the inputs changes, None if nothing is known; why that is not all, or ""."""

    effects: InputEffects | None
    stopped: str


def with_changed_inputs(scene: Scene, tally: Tally, means: Means) -> Found:
    """Repeat slides of a whole campaign with more of each input.

    Parameters
    ----------
    scene, tally
        Of the campaign.
    means
        To compute with.
    """
    slides = first_slides(tally, scene.campaign.sensitivity_pairs)
    found, lacking = {}, ""
    for changed in inputs_of(scene) if slides else ():
        made = _repeated(scene, changed, slides, tally, means.after(lacking))
        lacking = lacking or made.stopped
        if made.tally is not None:
            found[changed.key] = differences(slides, tally, made.tally)
    if not found:
        return Found(None, lacking)
    return Found(InputEffects(tuple(found), slides, np.array([*found.values()]), scene.campaign.confidence), lacking)


def _repeated(scene: Scene, changed: Input, slides: tuple[int, ...], tally: Tally, means: Means) -> Made:
    again, value = counted(len(slides), "slide"), shown(raised(scene, changed), changed)
    run = SideRun(
        scene=lambda: without_rule(with_more(scene, changed), slides[-1] + 1),
        directory=directory_of(means.home, changed),
        announcement=f"Inputs: {again} computed again with {100 * MORE:g} % more {changed.name}, {value}.",
        loss=f"What more {changed.name} changes cannot be estimated.",
        known=[summary for k, summary in tally.summaries.items() if k not in slides],
    )
    return make(run, means)


def directory_of(home: Path, changed: Input) -> Path:
    """Return where the slides repeated with more of an input are kept."""
    return home / CHANGED_INPUTS / changed.key
