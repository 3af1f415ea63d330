"""All ranks end when one ends in an exception: the others would wait for it in MPI for ever.

Nothing of ours is imported here before the guard stands, because an import may fail on one rank, too.
"""

import sys
import threading
import time
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mpi4py import MPI

FORWARDING = 1.0
"""Seconds in which the launcher hands on what was said last; with the ranks it ends itself."""


@contextmanager
def ending_all_ranks() -> Iterator["MPI.Comm"]:
    """Start MPI, and end all its ranks when the context, or a thread of it, ends in an exception.

    Any exception counts, `SystemExit` and `KeyboardInterrupt` included.
    """
    from mpi4py import MPI

    def end(error: BaseException | None) -> None:
        code = getattr(error, "exit_code", None)
        if code is None:
            traceback.print_exception(error)
        else:
            print(error, file=sys.stderr)
        sys.stderr.flush()
        time.sleep(FORWARDING)
        MPI.COMM_WORLD.Abort(70 if code is None else code)

    in_threads, threading.excepthook = threading.excepthook, lambda raised: end(raised.exc_value)
    try:
        yield MPI.COMM_WORLD
    except BaseException as error:
        end(error)
        raise
    finally:
        threading.excepthook = in_threads
