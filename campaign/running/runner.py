"""The campaign under MPI: every rank runs whole realizations alone, rank 0 hands them out and computes too.

Rank 0 reads the scene, prepares what all realizations share, and scatters the first ids. From then on no collective
operation joins the ranks: each sends a report when it has finished and is sent its next id. Rank 0 answers from a
thread, or, where the MPI library allows no threads, from within its own time loop. Nobody waits in a blocking call,
which would burn a core and hold back signals.
"""

import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from mpi4py import MPI

from campaign.errors import RefusalError, SamplerError, SceneError
from campaign.exit_codes import ExitCode
from campaign.running import launcher
from campaign.running.campaign_directory import Draw, Site
from campaign.running.dispatcher import Dispatcher
from campaign.running.half_cell import Repetition, repeat_with_half_cell
from campaign.running.level import Level
from campaign.running.progress import Progress
from campaign.running.stop_request import StopRequest, listening
from campaign.running.walltime import job_end
from campaign.running.worker import LAST_CALL, Interrupt, Worker
from campaign.scene import Scene
from campaign.simulation.contract import Model
from campaign.statistics.tally import Report, Tally
from campaign.storage.attempts import Attempts
from campaign.storage.record_store import RecordStore

REPORT, ANSWER = 1, 2

PAUSE = 0.002
"""Seconds between two looks for a message."""

REFUSALS = (RefusalError, SceneError, SamplerError)
"""Exceptions that tell the user what to mend; any other ends all ranks with a traceback."""


class Order(NamedTuple):
    """What rank 0 tells every rank before it hands out realizations."""

    setup: Any
    home: Path  # of the campaign: the sampler's
    directory: Path  # of the records
    timeout: float
    job_end: float


def run(
    read_scene: Callable[[], Scene],
    out: Path | None,
    model: Model,
    draw: Draw | None = None,
    allow_drift: bool = False,
) -> ExitCode:
    """Run a campaign on all ranks of this MPI job, or continue it.

    Parameters
    ----------
    read_scene
        Called on rank 0.
    out
        The results directory; None for `campaign-NAME` after the scene.
    model
        The module `campaign.simulation.realization`, or a stand-in.
    draw
        Makes the report when the results are written.
    allow_drift
        Whether to continue what another version of the solver began.
    """
    comm = MPI.COMM_WORLD
    _abort_on_exception(comm)
    if sentence := launcher.mismatch(comm.size, os.environ):
        print(sentence, file=sys.stderr, flush=True)
        return ExitCode.REFUSED
    with listening() as stop:
        if comm.rank > 0:
            return _follow(comm, model, stop)
        try:
            scene = read_scene()
            site = Site(scene, out or Path(f"campaign-{scene.name}"), comm.size, allow_drift)
        except REFUSALS as refusal:
            return _refuse(comm, refusal)
        try:
            return _lead(comm, site, model, stop, draw)
        finally:
            site.close()


def _lead(comm: MPI.Comm, site: Site, model: Model, stop: StopRequest, draw: Draw | None) -> ExitCode:
    try:
        setup = model.prepare(site.scene)
        desk = Desk(comm, site.directory, model, model.build_sampler(setup, site.directory), stop, job_end())
        site.level.give_up_crashed(setup)
        tally = site.level.tally()
    except REFUSALS as refusal:
        return _refuse(comm, refusal)
    site.announce(comm.size, tally)
    stopped = desk.hand_out(site.level, setup, tally)
    repeated = Repetition(None, stopped)
    if tally.size is not None:
        repeated = repeat_with_half_cell(site, tally, model, desk.hand_out, stopped)
    _share(comm, None)
    return _agree(comm, site.conclude(setup, tally, *repeated, draw))


class Desk(NamedTuple):
    """Rank 0's means of handing out realizations."""

    comm: MPI.Comm
    home: Path
    model: Model
    sampler: Any
    stop: StopRequest
    job_end: float

    def hand_out(self, level: Level, setup: Any, tally: Tally) -> str:
        """Have all ranks compute what `tally` lacks; returns why that ended early, "" if it did not."""
        order = Order(setup, self.home, level.directory, level.scene.campaign.realization_timeout, self.job_end)
        progress = Progress(tally)
        dispatcher = Dispatcher(tally, _obstacle(self.stop, self.job_end))
        _share(self.comm, order)
        first = [dispatcher.exchange(Report(None)) for _ in range(self.comm.size)]
        service = Service(self.comm, first, dispatcher.exchange, lambda: dispatcher.observe(progress.tick))
        worker = _worker(self.comm, order, self.model, self.sampler, self.stop, service.poll)
        _work(worker, self.comm.scatter(first), dispatcher.exchange)
        service.finish()
        return dispatcher.stopped


def _follow(comm: MPI.Comm, model: Model, stop: StopRequest) -> ExitCode:
    while (order := _share(comm, None)) is not None:
        sampler = model.build_sampler(order.setup, order.home)
        worker = _worker(comm, order, model, sampler, stop, lambda: None)
        _work(worker, comm.scatter(None), lambda report: _ask(comm, report))
    return _agree(comm, None)


def _refuse(comm: MPI.Comm, refusal: Exception) -> ExitCode:
    print(refusal, file=sys.stderr, flush=True)
    _share(comm, None)
    return _agree(comm, ExitCode.REFUSED)


def _worker(
    comm: MPI.Comm, order: Order, model: Model, sampler: Any, stop: StopRequest, poll: Callable[[], None]
) -> Worker:
    interrupt = Interrupt(stop, order.job_end, order.timeout, poll)
    store, attempts = RecordStore(order.directory), Attempts(order.directory)
    return Worker(model, order.setup, sampler, store, attempts, comm.rank, interrupt)


def _work(worker: Worker, realization: int | None, exchange: Callable[[Report], int | None]) -> None:
    while realization is not None:
        realization = exchange(worker.run(realization))


def _ask(comm: MPI.Comm, report: Report) -> int | None:
    comm.send(report, dest=0, tag=REPORT)
    while not comm.iprobe(source=0, tag=ANSWER):
        time.sleep(PAUSE)
    answer: int | None = comm.recv(source=0, tag=ANSWER)
    return answer


class Service:
    """Rank 0's answers to the other ranks, and what else it does on the side.

    Parameters
    ----------
    first
        The first realization of each rank; one that got None will not ask for more.
    exchange
        Turns a report into the next realization.
    aside
        Called again and again.
    """

    def __init__(
        self,
        comm: MPI.Comm,
        first: list[int | None],
        exchange: Callable[[Report], int | None],
        aside: Callable[[], None],
    ) -> None:
        self._comm = comm
        self._exchange = exchange
        self._aside = aside
        self._busy = sum(realization is not None for realization in first[1:])
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        if MPI.Query_thread() == MPI.THREAD_MULTIPLE:
            self._thread = threading.Thread(target=self._serve_on, name="service", daemon=True)
            self._thread.start()

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
            realization = self._exchange(self._comm.recv(source=source, tag=REPORT))
            self._busy -= realization is None
            self._comm.send(realization, dest=source, tag=ANSWER)
        self._aside()


def _obstacle(stop: StopRequest, end: float) -> Callable[[float], str]:
    def obstacle(longest: float) -> str:
        if stop.drain:
            return "asked to stop"
        return "the job's time is nearly over" if time.time() + longest + LAST_CALL > end else ""

    return obstacle


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


def _abort_on_exception(comm: MPI.Comm) -> None:
    """End all ranks when one ends in an exception, which would otherwise wait in MPI_Finalize for ever."""

    def abort(kind: Any, value: Any, trace: Any) -> None:
        traceback.print_exception(kind, value, trace)
        sys.stderr.flush()
        comm.Abort(ExitCode.INTERNAL_ERROR)

    sys.excepthook = abort
    threading.excepthook = lambda raised: abort(raised.exc_type, raised.exc_value, raised.exc_traceback)
