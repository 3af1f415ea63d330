"""Slides that were cut short: by what, how many of them, and what can be done; the same words wherever it is told."""

from typing import NamedTuple

from campaign.record import Status
from campaign.results.results import Results
from campaign.scene import more_ground
from campaign.simulation.flags import AHEAD_WALL, CREST_WALL
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
    slides, (wall, remedy) = counted(results.outcomes.slides, "slide"), _wall(results)
    found = [
        Cause(WALLS, hindered, f"{wall} stopped {hindered:,} of {slides}", remedy),
        Cause(
            END,
            unsettled,
            f"{unsettled:,} of {slides} still moved when the run ended",
            "Raise numerics.end_time.",
        ),
    ]
    return [cause for cause in found if cause.slides]


def in_one_clause(found: list[Cause]) -> str:
    """Return all causes in one clause."""
    return " and ".join(cause.told for cause in found)


def _wall(results: Results) -> tuple[str, str]:
    """Say which wall of the model was in the way, or which of them, and what moves them away."""
    reasons = [str(each) for each in results.data["reason"].values[results.has_status([Status.reached_wall])]]
    walls = {
        "behind the crest": (CREST_WALL, more_ground.behind_crest),
        "ahead of the slope": (AHEAD_WALL, more_ground.ahead),
    }
    met = {
        where: remedy(results.scene)
        for where, (sentence, remedy) in walls.items()
        if any(sentence.partition(" (x")[0] in each for each in reasons)
    }
    if not met:
        return "a wall of the model", "Lengthen the ground there."
    remedies = " ".join(map(as_sentence, met.values()))
    return f"the wall {' or that '.join(met)}", remedies
