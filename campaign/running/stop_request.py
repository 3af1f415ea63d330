"""Being asked to stop: a flag is set, and the work that goes on looks at it."""

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

ECHO = 1.0
"""Seconds within which a repeated interrupt is one key press that came by the process group and by the launcher."""


AGAIN = 0.5
"""Seconds after which what is still under way is broken off once more."""


class BrokenOff(BaseException):
    """What was under way was left at somebody's request."""


class StopRequest:
    """Whether somebody asked for an end.

    `drain` is set by the first USR1, TERM or INT: start nothing new, finish what is under way. `now` is set by TERM,
    after which SLURM waits half a minute, and by a second INT: abandon it. Within `breaking_off` any of them raises
    `BrokenOff` besides, again and again until that is left: where a destructor or a callback from C is under way, as
    while code is compiled, Python drops it.
    """

    def __init__(self) -> None:
        self.drain = False
        self.now = False
        self._first = 0.0
        self._breaks_off = False

    def receive(self, number: int, _frame: FrameType | None = None) -> None:
        """Handle a signal; sets flags and, since it may interrupt anything, does more only where that is allowed."""
        repeated = self.drain and time.monotonic() - self._first > ECHO
        self.now = self.now or number == signal.SIGTERM or (repeated and number == signal.SIGINT)
        if not self.drain:
            self.drain, self._first = True, time.monotonic()
        if self._breaks_off:
            signal.setitimer(signal.ITIMER_REAL, AGAIN, AGAIN)
            raise BrokenOff

    def receive_again(self, _number: int, _frame: FrameType | None = None) -> None:
        """Handle the alarm that follows a signal; it may ring once more when what was under way has been left."""
        if self._breaks_off and self.drain:
            raise BrokenOff

    @contextmanager
    def breaking_off(self) -> Iterator[None]:
        """Let a signal raise `BrokenOff` inside this, for work that another day can do as well."""
        try:
            self._breaks_off = True
            yield
        finally:
            try:
                self._go_on()
            finally:
                self._go_on()  # a signal may have come in the middle of the first time

    def _go_on(self) -> None:
        self._breaks_off = False
        if self.drain:
            signal.setitimer(signal.ITIMER_REAL, 0.0)

    def obey(self) -> None:
        """Raise `BrokenOff` if somebody has asked for an end already."""
        if self.drain:
            raise BrokenOff


@contextmanager
def listening() -> Iterator[StopRequest]:
    """Turn USR1, TERM and INT into a `StopRequest` for the length of the context."""
    request = StopRequest()
    numbers = (signal.SIGUSR1, signal.SIGTERM, signal.SIGINT)
    previous = {number: signal.signal(number, request.receive) for number in numbers}
    previous[signal.SIGALRM] = signal.signal(signal.SIGALRM, request.receive_again)
    try:
        yield request
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
