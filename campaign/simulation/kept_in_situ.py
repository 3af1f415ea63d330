"""The in-situ state of a campaign: computed once, and found again by whoever needs the same one.

It is named by what decides it: the model as far as loading goes, and the source of the solver. So realizations with
half the cell have one of their own, and those with another strength share that of the campaign.
"""

import contextlib
import hashlib
from pathlib import Path
from typing import Any

import numpy as np

from campaign.files import clear_temporaries
from campaign.kept_arrays import keep, kept
from solver.compile_cache import source_digest
from solver.in_situ import in_situ_state, loading_model
from solver.model import Model
from solver.particles import Particles

IN_SITU = "in-situ"
"""Holds the states in a results directory."""


def kept_in_situ_state(model: Model, from_nothing: bool, directory: Path | None) -> Particles:
    """Return the in-situ state, from a results directory if it is there; else compute it and keep it there.

    Parameters
    ----------
    model, from_nothing
        See `solver.in_situ.in_situ_state`, and for what it raises.
    directory
        Of the results; without one nothing is kept. Where it cannot be written, nothing is either.
    """
    if directory is None:
        return in_situ_state(model, from_nothing)
    key = key_of(model, from_nothing)
    path = directory / IN_SITU / f"{key[:16]}.arrays"
    if found := kept(path, key):
        return Particles(**found)
    state = in_situ_state(model, from_nothing)
    with contextlib.suppress(OSError):
        clear_temporaries(path.parent)
        keep(path, key, state._asdict())
    return state


def key_of(model: Model, from_nothing: bool) -> str:
    """Return the SHA-256 of what decides an in-situ state."""
    return hashlib.sha256(repr((source_digest(), from_nothing, _plain(loading_model(model)))).encode()).hexdigest()


def _plain(value: Any) -> Any:
    """Return a value, or a tuple of them, with its arrays as lists: NumPy shortens what it shows of a long one."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    return (type(value).__name__, *map(_plain, value)) if isinstance(value, tuple) else value
