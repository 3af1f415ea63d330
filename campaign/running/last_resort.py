"""An end of this process with an exit code, though a call that never returns keeps all of its Python from running.

A timer of the system starts a thread in C that calls `_exit`; MPI launchers then end the other ranks with that code.
"""

import ctypes
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress

CLOCK_MONOTONIC = 1
CALL_IN_THREAD = 2  # SIGEV_THREAD


class _Event(ctypes.Structure):
    """Linux's `struct sigevent`: which function is called, and with which number."""

    _fields_ = (
        ("value", ctypes.c_int64),
        ("signal", ctypes.c_int),
        ("notify", ctypes.c_int),
        ("function", ctypes.c_void_p),
        ("rest", ctypes.c_char * 40),
    )


class _Times(ctypes.Structure):
    """Linux's `struct itimerspec`: the period, and the time until the first event, each in s and ns."""

    _fields_ = (("period", ctypes.c_long * 2), ("first", ctypes.c_long * 2))


@contextmanager
def ending(code: int, seconds: float) -> Iterator[bool]:
    """End this process with `code` when it stays in the context for so long; yields whether the system can do that."""
    library = _library()
    if library is None:
        yield False
        return
    leave = ctypes.cast(ctypes.CDLL(None)._exit, ctypes.c_void_p)
    timer, whole = ctypes.c_void_p(), int(seconds)
    event = _Event(value=code, notify=CALL_IN_THREAD, function=leave)
    times = _Times(first=(whole, int(1e9 * (seconds - whole))))
    is_made = library.timer_create(CLOCK_MONOTONIC, ctypes.byref(event), ctypes.byref(timer)) == 0
    try:
        yield is_made and library.timer_settime(timer, 0, ctypes.byref(times), None) == 0
    finally:
        if is_made:
            library.timer_delete(timer)


def _library() -> ctypes.CDLL | None:
    """Return the library that has timers: that of C itself, or, before glibc 2.34, one beside it."""
    for name in (None, "librt.so.1") if sys.platform == "linux" else ():
        with suppress(OSError, AttributeError):
            library = ctypes.CDLL(name)
            library.timer_create  # noqa: B018  -- raises where there is none
            return library
    return None
