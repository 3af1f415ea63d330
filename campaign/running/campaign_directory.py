"""A results directory in the hands of rank 0: opened for work, and concluded."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from campaign.accuracy.wording import verdict as accuracy_verdict
from campaign.errors import RefusalError
from campaign.exit_codes import ExitCode
from campaign.record import Status
from campaign.running.accuracy import OwnRuns
from campaign.running.beyond_sampling import BeyondSampling
from campaign.running.level import Level
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.simulation.contract import PreparedGround
from campaign.statistics.stopping import too_few
from campaign.statistics.tally import Tally
from campaign.storage import manifest
from campaign.storage.layout import RESULTS
from campaign.storage.lock import DirectoryLock
from campaign.storage.provenance import attributes
from campaign.terminal import counted, say


class Earlier(NamedTuple):
    """What may become of the work of earlier starts.

    Attributes
    ----------
    allow_drift
        Whether to continue what another version of the solver began.
    retry
        Realizations that ended so are run again.
    """

    allow_drift: bool = False
    retry: frozenset[Status] = frozenset()


ALL_STANDS = Earlier()


@contextmanager
def opened(scene: Scene, path: Path, ranks: int, earlier: Earlier = ALL_STANDS) -> Iterator["CampaignDirectory"]:
    """Open a results directory for a campaign of `scene`, and give it free afterwards.

    Raises
    ------
    RefusalError
        When the directory cannot be written, is in use, or belongs to something else.
    """
    directory = CampaignDirectory(scene, path, ranks, earlier)
    try:
        yield directory
    finally:
        directory.close()


class CampaignDirectory:
    """The directory of a scene's campaign, locked for this process."""

    def __init__(self, scene: Scene, path: Path, ranks: int, earlier: Earlier) -> None:
        self.scene = scene
        self.path = path
        self.level = Level(scene, path, earlier.retry)
        self._lock = DirectoryLock(path)
        try:
            self._open(ranks, earlier.allow_drift)
        except OSError as error:
            raise RefusalError(f"{path} cannot be written ({error}); give another --out, or make room.") from error

    def _open(self, ranks: int, allow_drift: bool) -> None:
        self.path.mkdir(parents=True, exist_ok=True)
        notes = [self._lock.acquire()]
        try:
            notes += manifest.begin(self.path, self.scene, ranks, allow_drift)
            notes += self.level.open()
        except BaseException:
            self.close()
            raise
        for note in filter(None, notes):
            say(note)

    def obstacle(self) -> str:
        """Return why nothing more may be written here, "" if it may."""
        return "" if self._lock.is_ours() else f"{self.path} was moved away, or another campaign has taken it over"

    def announce(self, ranks: int, tally: Tally) -> None:
        """Say what is about to be done."""
        earlier = f"; {tally.done} are finished already" if tally.done else ""
        most, ours = counted(tally.maximum, "realization"), counted(ranks, "rank")
        say(f"{self.scene.title}: at most {most} on {ours}, in {self.path}{earlier}.")
        if few := too_few(self.scene.campaign):
            say(few)

    def close(self) -> None:
        """Give the directory free."""
        self._lock.release()

    def leave(self, why: str, when: str = " before its first realization of this start") -> ExitCode:
        """Say and write down why the campaign ends without results, and return its exit code."""
        verdict = f"stopped early ({why}){when}"
        say(f"{self.scene.title}: {verdict}. Give the same command again to continue.")
        with suppress(OSError):
            manifest.end(self.path, ExitCode.RESUMABLE, verdict)
        return ExitCode.RESUMABLE

    def conclude(
        self,
        ground: PreparedGround,
        own: OwnRuns,
        beyond: BeyondSampling,
        draw_report: Callable[[], None] | None,
    ) -> ExitCode:
        """Write the results, draw them, say how the campaign ended, and return its exit code.

        Parameters
        ----------
        ground
            Of the campaign.
        own
            Its realizations.
        beyond
            What it knows of errors beyond sampling, and why not all was done.
        draw_report
            Called once the results are written; None for no report.
        """
        tally = own.tally
        code, verdict = _end(own, self.scene, beyond.stopped)
        say(f"\n{self.scene.title}: {verdict}")
        if self._is_lost():
            return ExitCode.RESUMABLE
        try:
            if tally.prefix > 0:
                say(self._write_results(ground, own, verdict, beyond))
            if (
                code is not ExitCode.RESUMABLE
            ):  # whoever was asked to stop has no time for it, and the next start does it
                self.level.store.pack()
            manifest.end(self.path, code, verdict)
        except (OSError, KeyError) as error:  # KeyError: of a record that was there
            if self._is_lost():
                return ExitCode.RESUMABLE
            if isinstance(error, KeyError):
                raise
            say(f"The results cannot be written ({error}). All records are kept: make room and repeat the command.")
            return ExitCode.RESUMABLE
        if tally.prefix > 0:
            say(f"Results: {self.path / RESULTS} (opens with xarray)")
            if draw_report is not None:
                draw_report()
            say(f"One realization again, with all particles: campaign replay {self.path} K")
        if code is ExitCode.RESUMABLE:
            say("Give the same command again to continue.")
        return code

    def _is_lost(self) -> bool:
        """Whether nothing more may be written here, which is said."""
        if lost := self.obstacle():
            say(f"{lost}. Its records are kept: give the same command again where it is.")
        return bool(lost)

    def _write_results(self, ground: PreparedGround, own: OwnRuns, verdict: str, beyond: BeyondSampling) -> str:
        """Write the dataset and return what it says, in that order: a terminal may fail, the results must be safe.

        What this needs is loaded here, once, and not by every rank at its start.
        """
        from campaign.report.summary import summary
        from campaign.results import dataset
        from campaign.results.accuracy import of_pursuit
        from campaign.results.results import Results
        from campaign.results.sensitivity import with_sensitivity

        tally = own.tally
        about = attributes(self.scene, manifest.read(self.path), verdict)
        columns, baseline = self.level.store.columns(tally.prefix), self.level.store.read(BASELINE)
        known = (beyond.discretisation, beyond.release)
        built = dataset.build(ground, columns, baseline, tally.history(), about, *known)
        if own.aim is not None:
            receptors = [receptor.x[0] - ground.toe_x for receptor in self.scene.receptor]
            built = built.assign(of_pursuit(own.aim.pursuit, own.aim.models, receptors))
        result = Results(with_sensitivity(Results(built, self.scene), beyond.inputs), self.scene)
        dataset.write(result.data, self.path / RESULTS)
        return summary(result)


def _end(own: OwnRuns, scene: Scene, stopped: str) -> tuple[ExitCode, str]:
    tally = own.tally
    if tally.too_many_failed:
        failed, limit = tally.failed_in_prefix, 100 * tally.max_failed_fraction
        return (
            ExitCode.TOO_MANY_FAILED,
            f"{failed:,} of {counted(tally.prefix, 'realization')} failed, more than the {limit:g} % of "
            "campaign.max_failed_fraction",
        )
    verdict = tally.history().verdict if tally.prefix else "no result yet"
    if tally.size is None or stopped:
        return ExitCode.RESUMABLE, f"stopped early ({stopped}); {verdict}"
    if own.aim is not None:
        return ExitCode.DONE, accuracy_verdict(own.aim.pursuit, scene)
    if tally.history().converged_at is None:
        return ExitCode.DONE, f"stopped at the maximum of {counted(tally.maximum, 'realization')}; {verdict}"
    return ExitCode.DONE, verdict
