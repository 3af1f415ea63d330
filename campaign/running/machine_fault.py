"""What ends a realization and is no fault of its own: the same realization may succeed elsewhere, or later."""

OF_MACHINE = (MemoryError, OSError, ImportError, EOFError)
"""Memory, disks, files that cannot be read; EOFError is what a truncated file of compiled code gives."""

COMPILERS = {"numba", "llvmlite"}


class MachineFaultError(Exception):
    """The machine failed; the message says how."""


def is_machine_fault(error: Exception) -> bool:
    """Whether an exception says something about the machine and not about what was computed."""
    return isinstance(error, OF_MACHINE) or type(error).__module__.partition(".")[0] in COMPILERS
