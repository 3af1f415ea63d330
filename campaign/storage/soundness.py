"""Whether what a file holds can be a result of the campaign in whose directory it lies."""

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from campaign.errors import DamagedRecordError
from campaign.files import set_aside
from campaign.record import SLID, RealizationSummary

Shape: TypeAlias = tuple[int, ...] | None
"""Of an array of numbers; None for what is not numbers."""


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


def shape_of(value: Any) -> Shape:
    """Return the shape of numbers."""
    array = np.asarray(value)
    return array.shape if array.dtype.kind in "fiu" else None


def misfit(found: Mapping[str, Shape], wanted: Mapping[str, Shape]) -> str:
    """Return the name of a quantity that has not the shape that is wanted, "" if there is none."""
    return next((name for name, shape in found.items() if name in wanted and shape != wanted[name]), "")


def not_fitting(path: Path, name: str, whose: str) -> str:
    """Set a file aside that does not fit the ground; returns the sentence about it."""
    aside = set_aside(path)
    return f"{path} is of another ground ({name} differs in shape). It is set aside as {aside.name}; {whose} run again."
