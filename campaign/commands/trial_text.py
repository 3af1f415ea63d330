"""The slide with mean strengths in words, before a campaign."""

from collections.abc import Sequence
from math import isfinite

import numpy as np

from campaign.record import LOWER_BOUND, Status
from campaign.scene import Scene
from campaign.scene.sections import Receptor
from campaign.simulation.flags import with_remedy
from campaign.simulation.trial import Trial
from campaign.statistics.wording import at_least
from campaign.terminal import listing


def trial_text(scene: Scene, made: Trial | None) -> str:
    """Say whether a slope of mean strengths slides, how far and how long, and which receptors the front reaches."""
    if made is None:
        return "A slide takes too long for a first look; the campaign computes the one with mean strengths first."
    cells = f"Simulated in cells of {made.cell:g} m"
    if made.cell > scene.numerics.cell:
        cells += f" instead of {scene.numerics.cell:g} m, which may change the run-out by a fifth"
    return f"{_outcome(made)} {cells}."


def _outcome(made: Trial) -> str:
    record = made.record
    if record.status is Status.no_slide:
        farthest = float(record.values["max_displacement"][-1])  # type: ignore[index]
        return f"The slope stands: nothing moves farther than {farthest:.2g} m."
    if not made.slides:
        return f"The simulation fails: {with_remedy(record.reason, made.ground.scene)}"
    moves = "still moves at the end of the run" + (", behind its front" if record.status is Status.slid else "")
    how = f"comes to rest after {made.rest:.2g} s" if isfinite(made.rest) else moves
    is_hindered = record.status is Status.reached_wall
    stopped = ", and the wall ahead stopped it" if is_hindered else ""
    where = f"its front is {at_least(record)}{made.runout:.3g} m beyond the toe, at x = {made.front:.4g} m{stopped}"
    return f"The slope slides and {how}; {where}.{_receptors(made)}"


def _receptors(made: Trial) -> str:
    asked = made.ground.scene.receptor
    if not asked:
        return ""
    reached = np.asarray(made.record.values["front_reaches"]) == 1
    by_then = "by then " if made.record.status in LOWER_BOUND else ""
    there = [each for each, hit in zip(asked, reached, strict=True) if hit]
    if not there:
        return f" {'By then it has not reached' if by_then else 'It does not reach'} {_listed(asked)}."
    others = [each for each in asked if each not in there]
    return f" It reaches {_listed(there)}{f', {by_then}not {_listed(others)}' if others else ''}."


def _listed(receptors: Sequence[Receptor]) -> str:
    return listing([f"{each.name} ({each.where})" for each in receptors])
