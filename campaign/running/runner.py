"""A campaign from its first missing realization to its results, whoever computes."""

import threading
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from campaign.errors import CampaignError
from campaign.exit_codes import ExitCode
from campaign.running.accuracy import OwnRuns, to_accuracy
from campaign.running.beyond_sampling import BeyondSampling, beyond_sampling
from campaign.running.campaign_directory import CampaignDirectory, opened
from campaign.running.crew import Alone, Crew
from campaign.running.machine_fault import MachineFaultError, machine_faults
from campaign.running.means import means_of
from campaign.running.reporting import WriteReport, draw_report
from campaign.running.stop_request import BrokenOff, StopRequest, listening
from campaign.scene import Scene, load_scene
from campaign.simulation.contract import Prepare
from campaign.storage.layout import RESULTS

if TYPE_CHECKING:
    import xarray as xr


def run(
    scene: Scene | str | Path,
    out: str | Path | None = None,
    realizations: int | None = None,
    seed: int | None = None,
    report: bool = False,
) -> "xr.Dataset":
    """Run a campaign in this process, without MPI, or continue it; tells its progress in lines.

    An interrupt (Ctrl-C, or a signal to stop) lets the realization under way finish; the same call continues.

    Parameters
    ----------
    scene : Scene, or what `load_scene` takes
    out : path, optional
        The results directory; `campaign-NAME` after the scene if not given.
    realizations, seed : int, optional
        Instead of the scene's own.
    report : bool
        Whether to draw the report, too.

    Returns
    -------
    xarray.Dataset
        The results so far, as `open_results` gives them.

    Raises
    ------
    campaign.errors.CampaignError
        If the scene or the directory is refused, or no realization was finished.
    """
    from campaign.report.page import write_report
    from campaign.results.results import open_results
    from campaign.simulation.ground import prepare_to_run

    asked = {"campaign.realizations": realizations, "campaign.seed": seed}
    scene = load_scene(scene, [f"{key}={value}" for key, value in asked.items() if value is not None])
    directory = Path(out or f"campaign-{scene.name}")
    is_main = threading.current_thread() is threading.main_thread()  # others may not listen to signals
    with listening() if is_main else nullcontext(StopRequest()) as stop, opened(scene, directory, 1) as opened_here:
        code = conduct(opened_here, prepare_to_run, Alone(stop), stop, write_report if report else None)
    if code is ExitCode.RESUMABLE and not (directory / RESULTS).exists():
        raise CampaignError(f"No realization of {scene.title} was finished; call run again to continue.")
    return open_results(directory)


def conduct(
    directory: CampaignDirectory,
    prepare: Prepare,
    crew: Crew,
    stop: StopRequest,
    write_report: WriteReport | None,
) -> ExitCode:
    """Have the crew compute what the campaign lacks, and write its results.

    Parameters
    ----------
    directory
        Of the campaign, opened.
    prepare
        Computes what realizations share.
    crew
        Computes realizations.
    stop
        Whether somebody asked for an end.
    write_report
        Makes the report when the results are written; None for no report.

    Raises
    ------
    CampaignError
        If the scene cannot be run.
    """
    means = means_of(directory, prepare, crew, stop)
    try:
        ground = means.prepare(directory.scene, directory.path)
        with machine_faults():
            directory.level.fit(ground)
    except BrokenOff:
        return directory.leave("asked to stop")
    except MachineFaultError as fault:
        return directory.leave(f"the ground could not be prepared: {fault}")
    tally = directory.level.tally()
    directory.announce(crew.size, tally)
    if directory.scene.campaign.accuracy is None:
        own = OwnRuns(tally, means.hand_out(directory.level, ground, tally))
    else:
        own = to_accuracy(directory.scene, means)
    tally, means = own.tally, means.after(own.stopped)
    beyond = BeyondSampling(own.stopped)
    if tally.size is not None:
        beyond = beyond_sampling(directory.scene, tally, means, own.aim and own.aim.pairs)
    means = means.after(beyond.stopped)
    draw = None if write_report is None else partial(draw_report, tally, means, stop, write_report)
    return directory.conclude(ground, own, beyond, draw)
