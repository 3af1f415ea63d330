"""Slides that were cut short or disturbed: by what, how many, and what can be done; the same words wherever it is told.

The wall ahead and the end of the run cut slides short: they may come farther than they did. The wall behind the crest
bounds no run-out. It disturbs it, which makes it longer or shorter, and bounds what moves there.
"""

from typing import NamedTuple

import numpy as np

from campaign.record import Status
from campaign.results.results import Results
from campaign.scene import more_ground
from campaign.terminal import as_sentence, counted

WALLS, END = "Walls", "End of the run"
"""What cuts slides short."""


class Cause(NamedTuple):
    """Why slides were cut short.

    Attributes
    ----------
    source : str
        `WALLS` or `END`.
    slides : int
        How many; at least one.
    told : str
        A clause: "the wall ahead of the slope stopped 3 of 20 slides".
    remedy : str
        A sentence.
    """

    source: str
    slides: int
    told: str
    remedy: str


def causes(results: Results) -> list[Cause]:
    """Return why slides were cut short; nothing where none was."""
    hindered, unsettled = results.outcomes.hindered, results.by_status()[Status.not_settled]
    slides = counted(results.outcomes.slides, "slide")
    fronts = "the front" if unsettled == 1 else "the fronts"
    found = [
        Cause(
            WALLS,
            hindered,
            f"the wall ahead of the slope stopped {hindered:,} of {slides}",
            as_sentence(more_ground.ahead(results.scene)),
        ),
        Cause(
            END,
            unsettled,
            f"{fronts} of {unsettled:,} of {slides} may have come farther after the end of the run",
            "Raise numerics.end_time.",
        ),
    ]
    return [cause for cause in found if cause.slides]


def in_one_clause(found: list[Cause]) -> str:
    """Return all causes in one clause."""
    return " and ".join(cause.told for cause in found)


def reach_the_wall_behind(results: Results) -> str:
    """Return in a clause how many slides have reached the wall behind the crest, "" if none has."""
    count = int(np.count_nonzero(results.reached_behind))
    reach = "reaches" if count == 1 else "reach"
    slides = counted(results.outcomes.slides, "slide")
    return f"{count:,} of {slides} {reach} the wall behind the crest" if count else ""


def disturbed(results: Results) -> str:
    """Say that the wall behind the crest disturbs run-outs, and what can be done, "" where it does not."""
    told = reach_the_wall_behind(results)
    if not told:
        return ""
    remedy = as_sentence(more_ground.behind_crest(results.scene))
    return f"{told}, which disturbs run-outs: with more ground there they may be longer or shorter. {remedy}"


def bounded_behind(results: Results) -> str:
    """Say what the wall behind the crest bounds and what it does not, "" where no slide has reached it."""
    told = reach_the_wall_behind(results)
    if not told:
        return ""
    return (
        f"{told}: there the volume of the slide and the length that moves behind the crest are lower bounds. Run-outs, "
        "and what reaches a place, count as they were measured, with more ground there they may be larger or smaller."
    )
