"""Results of earlier versions, in which a slide that reached either wall had one status.

It is for the wall ahead alone since, which bounds the run-out; what reached the wall behind the crest alone is said by
`reached_wall_behind`, and ends as any other slide does.
"""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.record import Status

REACHED_BEHIND = "reached_wall_behind"
"""The quantity that says so."""

BEHIND, AHEAD = "the wall behind the crest", "the wall ahead"
"""What the reasons of all versions call the walls."""


def told_apart(
    statuses: NDArray[np.int8], reasons: NDArray[np.object_], settle_times: NDArray[np.float64]
) -> tuple[NDArray[np.int8], NDArray[np.int64]]:
    """Return statuses, (n,), and 1 where the wall behind the crest was reached, of records that say it in their reason.

    Without the wall ahead a slide that has come to rest has slid; of one that still moved, nobody had asked whether its
    front could come farther.
    """
    at_wall = statuses == Status.reached_wall
    behind, ahead = (at_wall & np.array([wall in str(reason) for reason in reasons], bool) for wall in (BEHIND, AHEAD))
    ended = np.where(np.isfinite(settle_times), Status.slid, Status.not_settled)
    return np.where(behind & ~ahead, ended, statuses).astype(statuses.dtype), behind.astype(np.int64)


def with_walls_told_apart(data: xr.Dataset) -> xr.Dataset:
    """Return a dataset in which the walls are told apart, whatever version made it."""
    if REACHED_BEHIND in data:
        return data
    statuses, behind = told_apart(*(data[name].values for name in ("status", "reason", "settle_time")))
    attributes = data["status"].attrs
    return data.assign({"status": ("realization", statuses, attributes), REACHED_BEHIND: ("realization", behind)})
