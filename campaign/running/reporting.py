"""The report at the end of a campaign: its slides simulated by all ranks, its page drawn by rank 0.

The results are written by then and do not depend on it. So a signal breaks it off, and what stopped the campaign early
keeps slides from being simulated again.
"""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias, cast

from campaign.running.side_run import Means, SideRun, make
from campaign.running.stop_request import BrokenOff, StopRequest
from campaign.scene import Scene
from campaign.statistics.repetition import without_rule
from campaign.statistics.tally import Tally
from campaign.storage.layout import SNAPSHOTS
from campaign.terminal import counted, say

WriteReport: TypeAlias = Callable[[Path, bool], Path]
"""Makes the report of a results directory and returns its page; may simulate slides again if told so."""


def draw_report(tally: Tally, means: Means, stop: StopRequest, write_report: WriteReport) -> None:
    """Draw the report if that can be done.

    Parameters
    ----------
    tally
        Of the campaign, whose results are written.
    means
        To simulate with the slides that are drawn.
    stop
        Whether somebody asked for an end.
    write_report
        Draws it.
    """
    later = f"campaign report {means.home}"
    try:
        if not means.stopped:
            _simulate_slides(tally, means)
            stop.obey()
        with stop.breaking_off():
            say(f"Report: {write_report(means.home, False)}")
    except BrokenOff:
        say(f"The report is left out, as asked to stop; results.nc is safe. It is made by: {later}")
    except Exception as error:
        say(f"The report could not be made ({error!r}); results.nc is safe. Try again: {later}")


def _simulate_slides(tally: Tally, means: Means) -> None:
    """Have the ranks simulate the slides that are drawn, unless they are kept from an earlier start.

    What this needs is loaded here, once, and not by every rank at its start.
    """
    from campaign.report.kept_slides import FilmedGround
    from campaign.report.replays import shown_slides
    from campaign.results.results import read_results
    from campaign.simulation.ground import Ground

    results = read_results(means.home)
    shown = set(shown_slides(results).values())
    if not shown:
        return
    run = SideRun(
        scene=lambda: without_rule(results.scene, max(shown) + 1),
        directory=means.home / SNAPSHOTS,
        announcement=f"Report: simulates {counted(len(shown), 'slide')} once more, for the drawings of single slides.",
        loss="Single slides cannot be drawn.",
        known=[summary for k, summary in tally.summaries.items() if k not in shown],
        breaks_off=True,
    )

    def filmed(scene: Scene, home: Path) -> FilmedGround:
        return FilmedGround(cast(Ground, means.prepare(scene, home)), home)

    make(run, means._replace(prepare=filmed))
