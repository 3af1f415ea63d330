"""Which realization next, and when no more: rank 0's desk, without MPI and without a clock of its own."""

from collections.abc import Callable, Container, Iterator
from threading import Lock

from campaign.seeds import BASELINE
from campaign.statistics.tally import Fault, RankReport, Tally


class Dispatcher:
    """Hands out the missing realizations, the baseline first; may be called from several threads.

    What a rank could not compute is handed out again when all else is.

    Parameters
    ----------
    tally
        The account, holding what earlier starts have finished.
    obstacle
        Given the time a realization may take [s], says why none may be started now, "" if it may. That time is the
        longest so far, a prediction that seldom falls short.
    tidy
        Called by rank 0 between two of its realizations.
    """

    def __init__(self, tally: Tally, obstacle: Callable[[float], str], tidy: Callable[[], None] = lambda: None) -> None:
        self._problem = ""
        self._faults: list[Fault] = []
        self._tally = tally
        self._obstacle = obstacle
        self._tidy = tidy
        self._missing = _missing(tally.maximum, frozenset(tally.summaries))
        self._lock = Lock()

    def exchange(self, report: RankReport) -> int | None:
        """Take a rank's report and return its next realization; None is the end."""
        with self._lock:
            if report.finished is not None:
                self._tally.add(report.finished)
            if report.fault is not None:
                self._faults.append(report.fault)
            if self._tally.size is not None:
                return None
            self._problem = self._problem or report.problem or self._obstacle(self._tally.longest)
            retires = report.fault is not None and report.fault.retires
            return None if self._problem or retires else self._next()

    @property
    def stopped(self) -> str:
        """Why the hand-out ended before the campaign did, "" if it did not."""
        lacks = self._tally.size is None and self._faults
        return self._problem or (self._faults[-1].reason if lacks else "")

    def exchange_here(self, report: RankReport) -> int | None:
        """Do the same for rank 0 itself, which tidies up first: it keeps nobody else waiting."""
        self._tidy()
        return self.exchange(report)

    def observe(self, look: Callable[[Tally], None]) -> None:
        """Show the account to `look` while nobody changes it."""
        with self._lock:
            look(self._tally)

    def _next(self) -> int | None:
        realization = next(self._missing, None)
        if realization is None and self._faults:
            return self._faults.pop(0).realization
        return realization


def _missing(maximum: int, finished: Container[int]) -> Iterator[int]:
    return (k for k in (BASELINE, *range(maximum)) if k not in finished)
