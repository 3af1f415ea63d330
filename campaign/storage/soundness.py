"""Whether what a file holds can be a result of the campaign in whose directory it lies."""

import math
from collections.abc import Iterable

from campaign.errors import DamagedRecordError
from campaign.record import SLID, RealizationSummary


def check_owner(scene: str, owner: str, place: str) -> None:
    """Make sure that records are not those of another scene, seed or cell.

    Parameters
    ----------
    scene
        SHA-256 of the scene that they say they belong to; "" where they do not say, as older ones do not.
    owner
        SHA-256 of the scene of the campaign; "" takes all.
    place
        Names the file in the error.

    Raises
    ------
    DamagedRecordError
        When they are.
    """
    if not may_belong(scene, owner):
        raise DamagedRecordError(f"{place} belongs to another scene, seed or cell.")


def may_belong(scene: str, owner: str) -> bool:
    """Whether records of `scene` can be those of a campaign of `owner`; "" says nothing."""
    return "" in (scene, owner) or scene == owner


def is_sound(summary: RealizationSummary) -> bool:
    """Whether a slide has a run-out that is a number."""
    return summary.status not in SLID or math.isfinite(summary.final_runout + summary.final_runout_mass)


def check_sound(summaries: Iterable[RealizationSummary], place: str) -> None:
    """Make sure that the run-out of each slide is a number; raises DamagedRecordError if not."""
    if strange := [summary.realization for summary in summaries if not is_sound(summary)]:
        raise DamagedRecordError(f"{place} says that realization {strange[0]} slid, and its run-out is not a number.")
