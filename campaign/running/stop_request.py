"""Being asked to stop: a flag is set, and the work that goes on looks at it."""

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

ECHO = 1.0
"""Seconds within which a repeated interrupt is one key press that came by the process group and by the launcher."""


class StopRequest:
    """Whether somebody asked for an end.

    `drain` is set by the first USR1, TERM or INT: start nothing new, finish what is under way. `now` is set by a second
    INT: abandon it.
    """

    def __init__(self) -> None:
        self.drain = False
        self.now = False
        self._first = 0.0

    def receive(self, number: int, _frame: FrameType | None = None) -> None:
        """Handle a signal; does nothing but set flags, since it may interrupt anything."""
        repeated = self.drain and time.monotonic() - self._first > ECHO
        self.now = self.now or (repeated and number == signal.SIGINT)
        if not self.drain:
            self.drain, self._first = True, time.monotonic()


@contextmanager
def listening() -> Iterator[StopRequest]:
    """Turn USR1, TERM and INT into a `StopRequest` for the length of the context."""
    request = StopRequest()
    numbers = (signal.SIGUSR1, signal.SIGTERM, signal.SIGINT)
    previous = {number: signal.signal(number, request.receive) for number in numbers}
    try:
        yield request
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
