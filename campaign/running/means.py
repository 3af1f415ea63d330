"""What a campaign computes with: its crew, as long as nobody asks for an end and the directory is there."""

import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

from campaign.exit_codes import ExitCode
from campaign.running.campaign_directory import CampaignDirectory
from campaign.running.crew import Crew, Order
from campaign.running.dispatcher import Dispatcher
from campaign.running.interrupt import LAST_CALL
from campaign.running.level import Level
from campaign.running.machine_fault import machine_faults
from campaign.running.progress import Progress, nothing_ahead
from campaign.running.side_run import Means
from campaign.running.stop_request import BrokenOff, StopRequest
from campaign.running.walltime import job_end
from campaign.running.workload import seconds_beyond_sampling
from campaign.scene import Scene
from campaign.simulation.contract import Prepare, PreparedGround
from campaign.statistics.tally import Tally

Lead = Callable[[CampaignDirectory, Crew, StopRequest], ExitCode]
"""What rank 0 does in an opened directory with a crew, as long as nobody asks for an end."""


def means_of(directory: CampaignDirectory, prepare: Prepare, crew: Crew, stop: StopRequest) -> Means:
    """Return the means of a directory.

    Parameters
    ----------
    directory
        Opened.
    prepare
        Computes what realizations share.
    crew
        Computes realizations.
    stop
        Whether somebody asked for an end.
    """
    end = job_end()
    obstacle = _obstacle(stop, end, directory.obstacle)
    is_rehearsed = False

    def prepare_unless_stopped(scene: Scene, path: Path) -> PreparedGround:
        with stop.breaking_off(), machine_faults():
            stop.obey()
            return prepare(scene, path)

    def hand_out(level: Level, ground: PreparedGround, tally: Tally, breaks_off: bool = False) -> str:
        nonlocal is_rehearsed
        wanted, timeout, is_main = level.scene, level.scene.campaign.realization_timeout, level is directory.level
        rehearses = tally.size is None and not is_rehearsed
        is_rehearsed = is_rehearsed or rehearses
        order = Order(ground, level.directory, wanted.digest(), timeout, end, breaks_off, rehearses)
        dispatcher = Dispatcher(tally, obstacle, _unless_stopped(stop, level.tidier(tally)))
        ahead = partial(seconds_beyond_sampling, wanted, crew.size) if is_main else nothing_ahead
        progress = Progress(tally, ahead, is_beside=not is_main)
        crew.compute(order, dispatcher, lambda: dispatcher.observe(progress.tick))
        return dispatcher.stopped

    return Means(directory.path, prepare_unless_stopped, hand_out, "", directory.level.retry)


def _unless_stopped(stop: StopRequest, tidy: Callable[[], None]) -> Callable[[], None]:
    """Return what tidies up until somebody asks for an end; the next start does the rest."""

    def tidy_unless_stopped() -> None:
        with suppress(BrokenOff), stop.breaking_off():
            stop.obey()
            tidy()

    return tidy_unless_stopped


def _obstacle(stop: StopRequest, end: float, lost: Callable[[], str]) -> Callable[[float], str]:
    def obstacle(longest: float) -> str:
        if stop.drain:
            return "asked to stop"
        return lost() or ("the job's time is nearly over" if time.time() + longest + LAST_CALL > end else "")

    return obstacle
