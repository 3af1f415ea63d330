"""What ends a computation and is no fault of its own: the same one may succeed elsewhere, or later."""

import traceback
from collections.abc import Iterator
from contextlib import contextmanager

OF_MACHINE = (MemoryError, OSError, ImportError, EOFError)
"""Memory, disks, files that cannot be read; EOFError is what a truncated file of compiled code gives."""

COMPILERS = {"numba", "llvmlite"}


class MachineFaultError(Exception):
    """The machine failed; the message says how."""


def is_machine_fault(error: Exception) -> bool:
    """Whether an exception says something about the machine and not about what was computed."""
    return isinstance(error, OF_MACHINE) or type(error).__module__.partition(".")[0] in COMPILERS


@contextmanager
def machine_faults() -> Iterator[None]:
    """Raise what says something about the machine as `MachineFaultError`."""
    try:
        yield
    except Exception as error:
        if is_machine_fault(error):
            raise MachineFaultError(reason_of(error)) from error
        raise


def reason_of(error: Exception) -> str:
    """Return the last line of the traceback and the place it comes from."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{traceback.format_exception_only(error)[-1].strip()} ({place.name}, line {place.lineno})"
