"""The one place where Numba is configured.

``kernel`` compiles passes over all particles or nodes. What they are made of is always inlined, so that LLVM can
vectorise the loops as a whole. ``inlined`` compiles operations on a block of particles. ``point`` marks functions of
one point, which stay plain Python outside kernels.
"""

import hashlib
import os
import tempfile
from pathlib import Path
from typing import Any

import numba
from numba.extending import overload, register_jitable


def _cache_directory() -> Path:
    """Return a node-local compile cache that belongs to exactly this source of ``solver``.

    Numba's cache does not notice an edit in a callee of another file, so the directory is keyed by all sources.
    """
    digest = hashlib.sha256()
    home = Path(__file__).parent
    for source in sorted(home.rglob("*.py")):
        digest.update(f"{source.relative_to(home)}\n".encode() + source.read_bytes())
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
_INLINED = {"forceinline": True, **_FLAGS}

kernel = numba.njit(**_FLAGS)
inlined = numba.njit(**_INLINED)
point = register_jitable(**_INLINED)


def chosen_by_type(function: Any) -> Any:
    """Let kernels call, in place of ``function``, what the decorated function of the argument types returns.

    The choice is made while a kernel is compiled and costs nothing when it runs.
    """
    return overload(function, jit_options=_INLINED, strict=False)  # type: ignore[arg-type]


# For sums that are to be the same, bit for bit, on every processor: without fastmath they are never reordered.
exact = numba.njit(cache=True, nogil=True)
