"""Which realization next, and when no more: rank 0's desk, without MPI and without a clock of its own."""

from collections.abc import Callable, Container, Iterator
from threading import Lock

from campaign.seeds import BASELINE
from campaign.statistics.tally import RankReport, Tally


class Dispatcher:
    """Hands out the missing realizations, the baseline first; may be called from several threads.

    Parameters
    ----------
    tally
        The account, holding what earlier starts have finished.
    obstacle
        Given the time a realization may take [s], says why none may be started now, "" if it may. That time is the
        longest so far, a prediction that seldom falls short.
    tidy
        Called by rank 0 between two of its realizations.

    Attributes
    ----------
    stopped
        Why the hand-out ended before the campaign did, "" if it did not.
    """

    def __init__(self, tally: Tally, obstacle: Callable[[float], str], tidy: Callable[[], None] = lambda: None) -> None:
        self.stopped = ""
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
            if self._tally.size is not None:
                return None
            self.stopped = self.stopped or report.problem or self._obstacle(self._tally.longest)
            return None if self.stopped else next(self._missing, None)

    def exchange_here(self, report: RankReport) -> int | None:
        """Do the same for rank 0 itself, which tidies up first: it keeps nobody else waiting."""
        self._tidy()
        return self.exchange(report)

    def observe(self, look: Callable[[Tally], None]) -> None:
        """Show the account to `look` while nobody changes it."""
        with self._lock:
            look(self._tally)


def _missing(maximum: int, finished: Container[int]) -> Iterator[int]:
    return (k for k in (BASELINE, *range(maximum)) if k not in finished)
