"""The one place where Numba is configured.

``kernel`` compiles what Python calls, and returns a number or nothing: to make an array or a tuple for Python, Numba
runs Python's own code, in which a signal may raise, and crashes over that. So arrays are made before.
``sweep`` marks passes over all particles or nodes, which kernels put together, and ``allocating`` those that make or
return arrays: only there and in kernels are references to arrays counted, whose counting everywhere took a quarter of
the time to compile.
``inlined`` marks what they are made of, operations on a block of particles or on one point: it is always inlined, so
that LLVM can vectorise a loop as a whole. What is only marked stays plain Python outside kernels.
"""

from collections.abc import Callable
from typing import Any

import numba
from numba.extending import overload, register_jitable

from solver.compile_cache import compile_cache

FAST_MATH = {"contract", "reassoc", "arcp", "nsz"}
_FLAGS: dict[str, Any] = {
    # Sums may be reordered and fused, which vectorises them. NaN and infinity keep their meaning, because the guards
    # against divergence rest on comparisons with NaN being false.
    "fastmath": FAST_MATH,
    # Division by zero gives infinity instead of a Python exception, which would stop vectorisation.
    "error_model": "numpy",
    # Other threads of the process (the hand-out of realizations) run while a kernel computes.
    "nogil": True,
}
# Half of the time that Numba takes goes into wrappers for calls from Python and from C.
_WITHIN = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, **_FLAGS}
_UNCOUNTED = {"_nrt": False, **_WITHIN}
# What is inlined is compiled with the kernel that calls it, and never kept by itself: Numba would keep it beside its
# source, and not notice when what it calls changes.
_INLINED = {"forceinline": True, **_UNCOUNTED}


def _compiled(**flags: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that compiles with these flags."""

    def decorate(function: Callable[..., Any]) -> Any:
        with compile_cache():
            return numba.njit(**flags)(function)

    return decorate


kernel = _compiled(cache=True, **_FLAGS)  # a warm start takes milliseconds instead of tens of seconds
sweep = register_jitable(**_UNCOUNTED)
allocating = register_jitable(_nrt=True, **_WITHIN)
inlined = register_jitable(**_INLINED)


def chosen_by_type(function: Any) -> Any:
    """Let kernels call, in place of ``function``, what the decorated function of the argument types returns.

    The choice is made while a kernel is compiled and costs nothing when it runs.
    """
    return overload(function, jit_options=_INLINED, strict=False)  # type: ignore[arg-type]


# A kernel for sums that are to be the same, bit for bit, on every processor: without fastmath they keep their order.
exact = _compiled(cache=True, nogil=True)
