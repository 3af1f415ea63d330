"""What the shell and SLURM are told about how a command ended."""

from enum import IntEnum


class ExitCode(IntEnum):
    """Exit codes of `campaign`; 70 and 75 are those of BSD's sysexits, 130 is that of shells."""

    DONE = 0
    REFUSED = 2
    TOO_MANY_FAILED = 3
    INTERNAL_ERROR = 70
    RESUMABLE = 75
    INTERRUPTED = 130
