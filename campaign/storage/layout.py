"""What the parts of a results directory are called."""

import re

from campaign.seeds import BASELINE

MANIFEST = "manifest.json"
RESULTS = "results.nc"
REPORT = "report.html"
FIGURES = "figures"
LOCK = "lock"
RECORDS = "records"
PACKS = "packs"
REPLAY = "replay"
ATTEMPTS = "attempts"
CRASHES = "crashes"
"""Among the attempts: those that took the process down."""

HALF_CELL = "half-cell"
"""Holds the realizations repeated with half the cell, in the same layout."""

MODELS = "models"
"""Holds a directory for each other model of a scene, named by what it is, in the same layout."""

VARIANTS = "variants"
"""Holds a directory for each variant of a scene that a study has run, named by its changes, in the same layout."""

OTHER_RELEASE = "other-release"
"""Holds the deterministic run with the other release protocol, in the same layout."""

SNAPSHOTS = "snapshots"
"""Holds the slides that the report draws, simulated again, in the same layout, and what they looked like on the way."""

CHANGED_INPUTS = "changed-inputs"
"""Holds a directory for each input, named by its key: the slides repeated with more of it, in the same layout."""


def realization_name(realization: int) -> str:
    """Return what the files of a realization are called, without a suffix."""
    return "baseline" if realization == BASELINE else f"realization-{realization:06d}"


def realization_file(realization: int) -> str:
    """Return the name of a record's file."""
    return f"{realization_name(realization)}.h5"


def realization_of(name: str) -> int | None:
    """Return whose record a file of this name holds, or None when it is not a record's name."""
    found = re.fullmatch(r"baseline\.h5|realization-(\d{6,})\.h5", name)
    if found is None:
        return None
    return BASELINE if found[1] is None else int(found[1])


def pack_file(number: int) -> str:
    """Return the name of a pack's file."""
    return f"p{number:05d}.h5"


def pack_of(name: str) -> int | None:
    """Return the number of the pack that a file of this name holds, or None when it is not a pack's name."""
    found = re.fullmatch(r"p(\d{5,})\.h5", name)
    return int(found[1]) if found else None


def attempt_file(rank: int) -> str:
    """Return the name of the file in which a rank says what it has begun."""
    return f"rank-{rank:04d}"


def snapshots_file(realization: int) -> str:
    """Return the name of the file that holds what a realization looked like on its way."""
    return f"{realization_name(realization)}.arrays"


def is_attempt(name: str) -> bool:
    """Whether a file of this name is one of those."""
    return re.fullmatch(r"rank-\d{4,}", name) is not None


def replay_file(realization: int) -> str:
    """Return the name of the file that holds a realization with all its particles."""
    return f"{realization_name(realization)}.vtkhdf"
