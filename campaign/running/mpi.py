"""The campaign under MPI: every rank runs whole realizations alone, rank 0 hands them out and computes too.

Rank 0 reads the scene, prepares what all realizations share, and scatters the first ids. From then on no collective
operation joins the ranks: each sends a report when it has finished and is sent its next id. Rank 0 answers from a
thread, or, where the MPI library allows no threads, from within its own time loop. Nobody waits in a blocking call,
which would burn a core and hold back signals.
"""

import os
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack, nullcontext
from pathlib import Path

from mpi4py import MPI

from campaign.errors import CampaignError
from campaign.exit_codes import ExitCode
from campaign.running import launcher
from campaign.running.campaign_directory import ALL_STANDS, CampaignDirectory, Earlier, opened
from campaign.running.crew import Crew, Order, work, worker_of
from campaign.running.dispatcher import Dispatcher
from campaign.running.guard import ending_all_ranks
from campaign.running.means import Lead
from campaign.running.reporting import WriteReport
from campaign.running.runner import conduct
from campaign.running.stop_request import BrokenOff, StopRequest, listening
from campaign.running.watch import Watch
from campaign.running.worker import Worker
from campaign.scene import Scene
from campaign.simulation.contract import Prepare
from campaign.statistics.tally import RankReport
from campaign.storage.attempts import Attempts
from campaign.terminal import complain, say

REPORT, ANSWER = 1, 2

PAUSE = 0.002
"""Seconds between two looks for a message."""


def run_on_ranks(
    read_scene: Callable[[], Scene],
    out: Path | None,
    prepare: Prepare,
    write_report: WriteReport | None = None,
    earlier: Earlier = ALL_STANDS,
    stop: StopRequest | None = None,
) -> ExitCode:
    """Run a campaign on all ranks of this MPI job, or continue it.

    Parameters
    ----------
    read_scene
        Called on rank 0.
    out
        The results directory; None for `campaign-NAME` after the scene.
    prepare
        Computes what realizations share; called on rank 0.
    write_report
        Makes the report when the results are written.
    earlier
        What may become of the work of earlier starts.
    stop
        Where somebody listens to signals already.
    """

    def lead(directory: CampaignDirectory, crew: Crew, stop: StopRequest) -> ExitCode:
        return conduct(directory, prepare, crew, stop, write_report)

    return on_ranks(read_scene, lambda scene: out or Path(f"campaign-{scene.name}"), lead, earlier, stop)


def on_ranks(
    read_scene: Callable[[], Scene],
    place: Callable[[Scene], Path],
    lead: Lead,
    earlier: Earlier = ALL_STANDS,
    stop: StopRequest | None = None,
) -> ExitCode:
    """Have all ranks of this MPI job compute what rank 0 wants in a results directory.

    Parameters
    ----------
    read_scene
        Called on rank 0.
    place
        Returns the results directory of the scene.
    lead
        Called on rank 0 with that directory, opened, the crew of all ranks and what listens to signals.
    earlier, stop
        As of `run_on_ranks`.
    """
    with ending_all_ranks() as comm, nullcontext(stop) if stop else listening() as stop:
        if sentence := launcher.mismatch(comm.size, os.environ):
            complain(sentence)
            return ExitCode.REFUSED
        if comm.rank > 0:
            return _follow(comm, stop)
        code = _lead(Ranks(comm, stop), stop, read_scene, place, lead, earlier)
        _share(comm, None)
        return _agree(comm, code)


def _lead(
    ranks: "Ranks",
    stop: StopRequest,
    read_scene: Callable[[], Scene],
    place: Callable[[Scene], Path],
    lead: Lead,
    earlier: Earlier,
) -> ExitCode:
    try:
        with ExitStack() as stack:
            with stop.breaking_off():
                stop.obey()
                scene = read_scene()
                begun = stack.enter_context(opened(scene, place(scene), ranks.size, earlier))
            return lead(begun, ranks, stop)
    except BrokenOff:
        say("Asked to stop before anything was begun. Give the same command again to continue.")
        return ExitCode.RESUMABLE
    except CampaignError as refusal:
        complain(refusal)
        return ExitCode.REFUSED


def _follow(comm: MPI.Comm, stop: StopRequest) -> ExitCode:
    while (order := _share(comm, None)) is not None:
        worker = worker_of(order, comm.rank, stop, lambda: None)
        if order.rehearses:
            _rehearse(comm, worker)
        work(worker, comm.scatter(None), lambda report: _ask(comm, report))
    return _agree(comm, None)


class Ranks:
    """The crew of all ranks, as rank 0 sees it."""

    def __init__(self, comm: MPI.Comm, stop: StopRequest) -> None:
        self._comm = comm
        self._stop = stop

    @property
    def size(self) -> int:
        """Number of ranks."""
        return self._comm.size

    def compute(self, order: Order, dispatcher: Dispatcher, aside: Callable[[], None]) -> None:
        """Hand out realizations to all ranks, this one included, until there are no more."""
        _share(self._comm, order)
        watch = Watch(order.timeout, Attempts(order.directory).note)
        service = Service(self._comm, dispatcher, watch, aside)
        worker = worker_of(order, 0, self._stop, service.poll)
        if order.rehearses:
            _rehearse(self._comm, worker)
        work(worker, self._comm.scatter(service.begin()), service.exchange_here)
        service.finish()


def _rehearse(comm: MPI.Comm, worker: Worker) -> None:
    """Let one rank of each node compile while the others wait, which then find its code."""
    node = comm.Split_type(MPI.COMM_TYPE_SHARED)
    if node.rank == 0:
        worker.rehearse()
    _gather_round(node)
    if node.rank > 0:
        worker.rehearse()
    node.Free()
    _gather_round(comm)


def _ask(comm: MPI.Comm, report: RankReport) -> int | None:
    comm.send(report, dest=0, tag=REPORT)
    while not comm.iprobe(source=0, tag=ANSWER):
        time.sleep(PAUSE)
    answer: int | None = comm.recv(source=0, tag=ANSWER)
    return answer


class Service:
    """Rank 0's answers to the other ranks, and what else it does on the side.

    Parameters
    ----------
    dispatcher
        Turns a report into the next realization.
    watch
        Notices who does not come back.
    aside
        Called again and again.
    """

    def __init__(
        self,
        comm: MPI.Comm,
        dispatcher: Dispatcher,
        watch: Watch,
        aside: Callable[[], None],
    ) -> None:
        self._comm = comm
        self._dispatcher = dispatcher
        self._watch = watch
        self._aside = aside
        self._busy = 0
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None

    def begin(self) -> list[int | None]:
        """Return the first realization of each rank, and answer those who got one from now on."""
        first = [self._dispatcher.exchange(RankReport(None)) for _ in range(self._comm.size)]
        for rank, realization in enumerate(first):
            self._watch.begins(rank, realization)
        self._busy = sum(realization is not None for realization in first[1:])
        if MPI.Query_thread() == MPI.THREAD_MULTIPLE:
            self._thread = threading.Thread(target=self._serve_on, name="service", daemon=True)
            self._thread.start()
        return first

    def exchange_here(self, report: RankReport) -> int | None:
        """Take rank 0's own report and return its next realization."""
        realization = self._dispatcher.exchange_here(report)
        self._watch.begins(0, realization)
        return realization

    def poll(self) -> None:
        """Answer who is waiting, unless a thread does; called from rank 0's time loop."""
        if self._thread is None:
            self._serve()

    def finish(self) -> None:
        """Answer until all ranks have been told that there is no more."""
        self._closing.set()
        if self._thread is None:
            self._serve_on()
        else:
            self._thread.join()

    def _serve_on(self) -> None:
        while self._busy or not self._closing.is_set():
            self._serve()
            time.sleep(PAUSE)

    def _serve(self) -> None:
        status = MPI.Status()
        while self._comm.iprobe(source=MPI.ANY_SOURCE, tag=REPORT, status=status):
            source = status.Get_source()
            realization = self._dispatcher.exchange(self._comm.recv(source=source, tag=REPORT))
            self._watch.begins(source, realization)
            self._busy -= realization is None
            self._comm.send(realization, dest=source, tag=ANSWER)
        self._watch.look()
        self._aside()


def _share(comm: MPI.Comm, order: Order | None) -> Order | None:
    """Send rank 0's order to all ranks; None sends them home."""
    _gather_round(comm)
    shared: Order | None = comm.bcast(order)
    return shared


def _agree(comm: MPI.Comm, code: ExitCode | None) -> ExitCode:
    """End all ranks with rank 0's exit code, since a launcher may report any of them."""
    _gather_round(comm)
    agreed: ExitCode = comm.bcast(code)
    return agreed


def _gather_round(comm: MPI.Comm) -> None:
    """Wait for all ranks without burning a core."""
    request = comm.Ibarrier()
    while not request.Test():
        time.sleep(5 * PAUSE)
