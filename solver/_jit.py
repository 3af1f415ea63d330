"""The one place where Numba is configured.

``kernel`` compiles passes over all particles or nodes; ``law`` compiles what they are made of, scalar functions of one
point and operations on a block of particles, always inlined so that LLVM can vectorise the loops as a whole.
"""

import hashlib
import os
import tempfile
from pathlib import Path
from typing import Any

import numba


def _cache_directory() -> Path:
    """Return a node-local compile cache that belongs to exactly this source of ``solver``.

    Numba's cache does not notice an edit in a callee of another file, so the directory is keyed by all sources.
    """
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.read_bytes())
    user = os.environ.get("USER") or str(os.getuid())
    return Path(tempfile.gettempdir()) / f"runout-solver-{user}" / digest.hexdigest()[:16]


numba.config.CACHE_DIR = os.environ.get("NUMBA_CACHE_DIR") or str(_cache_directory())  # type: ignore[attr-defined]

_FLAGS: dict[str, Any] = {
    # Sums may be reordered and fused, which vectorises them. NaN and infinity keep their meaning, because the guards
    # against divergence rest on comparisons with NaN being false.
    "fastmath": {"contract", "reassoc", "arcp", "nsz"},
    # Division by zero gives infinity instead of a Python exception, which would stop vectorisation.
    "error_model": "numpy",
    # A warm start takes milliseconds instead of tens of seconds.
    "cache": True,
    # Other threads of the process (the hand-out of realizations) run while a kernel computes.
    "nogil": True,
}

kernel = numba.njit(**_FLAGS)
law = numba.njit(forceinline=True, **_FLAGS)
