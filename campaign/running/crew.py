"""Who computes: what a campaign asks of its ranks, and the crew of one that needs no MPI."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, Protocol

from campaign.running.dispatcher import Dispatcher
from campaign.running.interrupt import Interrupt
from campaign.running.stop_request import StopRequest
from campaign.running.worker import Worker
from campaign.simulation.contract import PreparedGround
from campaign.statistics.tally import RankReport
from campaign.storage.attempts import Attempts
from campaign.storage.record_store import RecordStore


class Order(NamedTuple):
    """What every rank is told before realizations are handed out."""

    ground: PreparedGround
    directory: Path  # of the records
    scene: str  # SHA-256 of the one that the records belong to
    timeout: float  # s, of a realization
    job_end: float  # s since the epoch
    breaks_off: bool  # what is under way when somebody asks for an end
    rehearses: bool  # whether each rank tries itself out before its first realization


class Crew(Protocol):
    """Some ranks that compute realizations."""

    @property
    def size(self) -> int:
        """Number of ranks."""

    def compute(self, order: Order, dispatcher: Dispatcher, aside: Callable[[], None]) -> None:
        """Compute what the dispatcher hands out until it has no more, and call `aside` again and again meanwhile."""


class Alone:
    """One rank: this process.

    Parameters
    ----------
    stop
        Asked whether to go on.
    """

    size = 1

    def __init__(self, stop: StopRequest) -> None:
        self._stop = stop

    def compute(self, order: Order, dispatcher: Dispatcher, aside: Callable[[], None]) -> None:
        """Compute one realization after another."""
        worker = worker_of(order, 0, self._stop, aside)
        if order.rehearses:
            worker.rehearse()
        work(worker, dispatcher.exchange(RankReport(None)), dispatcher.exchange_here)
        aside()


def worker_of(order: Order, rank: int, stop: StopRequest, aside: Callable[[], None]) -> Worker:
    """Return a rank's worker for an order; `aside` is called from within its time loop."""
    interrupt = Interrupt(stop, order.job_end, order.timeout, aside, order.breaks_off)
    store = RecordStore(order.directory, order.scene)
    return Worker(order.ground, store, Attempts(order.directory), rank, interrupt)


def work(worker: Worker, realization: int | None, exchange: Callable[[RankReport], int | None]) -> None:
    """Run realizations, the given one first, until the exchange has no next."""
    while realization is not None:
        realization = exchange(worker.run(realization))
