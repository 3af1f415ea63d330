"""Runs besides a campaign's own, in a directory of their own, which tell an error that sampling does not show."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple, Protocol

from campaign.errors import RefusalError
from campaign.record import RealizationSummary, Status
from campaign.running.level import Level
from campaign.running.machine_fault import MachineFaultError
from campaign.running.stop_request import BrokenOff
from campaign.scene import Scene
from campaign.simulation.contract import Prepare, PreparedGround
from campaign.statistics.tally import Tally
from campaign.terminal import say


class HandOut(Protocol):
    """Has all ranks compute what an account lacks, and says why that ended early, "" if it did not."""

    def __call__(self, level: Level, ground: PreparedGround, tally: Tally, breaks_off: bool = False) -> str:
        """Leave what is under way when somebody asks for an end, if it `breaks_off`; else finish it."""


class Means(NamedTuple):
    """What it takes to run something.

    Attributes
    ----------
    home
        The campaign's directory.
    prepare
        Computes what realizations share.
    hand_out
        Has all ranks compute realizations.
    stopped
        Why nothing new may be begun, "" if it may.
    retry
        Realizations that ended so in an earlier start are run again.
    """

    home: Path
    prepare: Prepare
    hand_out: HandOut
    stopped: str
    retry: frozenset[Status] = frozenset()

    def after(self, stopped: str) -> "Means":
        """Return the means that are left when something had to stop for this reason, "" if it had not."""
        return self._replace(stopped=self.stopped or stopped)


class SideRun(NamedTuple):
    """Runs to be made.

    Attributes
    ----------
    scene
        Makes their scene; what it raises is told with the loss.
    directory
        Theirs.
    announcement
        Said before they begin.
    loss
        A sentence on what cannot be said without them.
    known
        Those of them that need not be made.
    breaks_off
        Whether what is under way is left when somebody asks for an end; else it is finished.
    """

    scene: Callable[[], Scene]
    directory: Path
    announcement: str
    loss: str
    known: Iterable[RealizationSummary] = ()
    breaks_off: bool = False


class Made(NamedTuple):
    """What became of the runs.

    Attributes
    ----------
    tally
        Their account, None if it is not whole.
    stopped
        Why it may become whole later, "" if it will not.
    refusal
        Why it cannot become so.
    """

    tally: Tally | None
    stopped: str
    refusal: str = ""


class Stopped(Exception):  # noqa: N818  -- not an error: somebody asked for it
    """Nothing more may be begun."""


def make(run: SideRun, means: Means) -> Made:
    """Make the runs that earlier starts have not made."""
    try:
        level = Level(run.scene(), run.directory, means.retry)
        for note in level.open():
            say(note)
        tally = _account(level, run)
        if tally.size is None and not means.stopped:
            return _compute(level, run, means)
    except RefusalError as refusal:
        say(f"{run.loss} {refusal}")
        return Made(None, "", str(refusal))
    except BrokenOff:
        return Made(None, "asked to stop")
    except MachineFaultError as fault:
        return Made(None, f"the ground of {run.directory} could not be prepared: {fault}")
    except OSError as error:
        return Made(None, f"{run.directory} cannot be written ({error})")
    return _made(tally, means.stopped)


def _compute(level: Level, run: SideRun, means: Means) -> Made:
    say(run.announcement)
    ground = means.prepare(level.scene, means.home)
    level.fit(ground)
    tally = _account(level, run)
    stopped = means.hand_out(level, ground, tally, run.breaks_off)
    return _made(tally, stopped)


def _made(tally: Tally, stopped: str) -> Made:
    return Made(None, stopped) if tally.size is None else Made(tally, "")


def _account(level: Level, run: SideRun) -> Tally:
    tally = level.tally()
    for summary in run.known:
        tally.add(summary)
    return tally
