"""Variables of the dataset after CF: numbers with a unit and a name, and flags with their meanings."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.record import Status

Variables = dict[str, xr.Variable]

STATUS = (
    "slid: the front came to rest, or can come no farther by as much as matters; ground behind it may still have moved "
    "at the end, where settle_time is missing. not_settled, reached_wall: the front may have come farther after the "
    "end of the run, or had the wall ahead not stopped it; run-out and what depends on it are lower bounds. The wall "
    "behind the crest is told by reached_wall_behind. timeout, diverged, left_domain, crashed: no result"
)
"""What the meanings of the flags mean."""


def variable(
    dims: str | tuple[str, ...],
    values: Any,
    units: str,
    long_name: str,
    dtype: str = "f8",
) -> xr.Variable:
    """Return numbers with their unit and name."""
    return xr.Variable(dims, np.asarray(values, dtype=dtype), {"units": units, "long_name": long_name})


def texts(dim: str, values: Sequence[str], long_name: str) -> xr.Variable:
    """Return texts with their name."""
    return xr.Variable(dim, np.array(values, dtype=object), {"long_name": long_name})


def status_flags(statuses: NDArray[np.int8] | np.int8) -> xr.Variable:
    """Return how one realization ended, or all of them."""
    flags = {
        "long_name": "how the realization ended",
        "standard_name": "status_flag",
        "flag_values": np.array([int(status) for status in Status], dtype="i1"),
        "flag_meanings": " ".join(status.name for status in Status),
        "comment": STATUS,
    }
    return xr.Variable("realization" if np.ndim(statuses) else (), statuses, flags)


def mask(holds: NDArray[np.bool_], long_name: str) -> xr.Variable:
    """Return which realizations something holds for."""
    flags = {"flag_values": np.array([0, 1], dtype="i1"), "flag_meanings": "no yes"}
    return xr.Variable("realization", holds, {"long_name": long_name} | flags)
