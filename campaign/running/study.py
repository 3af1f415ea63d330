"""The same realizations of a scene in several variants, one after the other, while a budget of time lasts.

Realization k is the same ground in all of them, as far as they change nothing in the ground, so that a few tell what a
change does. A variant that has been run is read and not run again; what is left out follows from the times that are
kept with the realizations, so that it stays left out.
"""

import math
import re
from collections.abc import Callable, Iterable
from hashlib import sha256
from itertools import chain
from pathlib import Path
from typing import NamedTuple

import numpy as np

from campaign.errors import SceneError
from campaign.exit_codes import ExitCode
from campaign.running.campaign_directory import CampaignDirectory
from campaign.running.crew import Crew
from campaign.running.level import Level
from campaign.running.means import Lead, means_of
from campaign.running.side_run import Means, SideRun, Stopped, make
from campaign.running.stop_request import StopRequest
from campaign.scene import Scene
from campaign.scene.cost import realization_seconds
from campaign.scene.variant import variant_of
from campaign.seeds import BASELINE
from campaign.simulation.contract import Prepare
from campaign.statistics.repetition import UNASKED, without_rule
from campaign.statistics.tally import Tally
from campaign.storage import manifest
from campaign.storage.layout import VARIANTS
from campaign.terminal import counted, duration

OWN = "as the scene says"

LONGEST = 150
"""Characters of the name of a variant's directory that say what it changes; file systems take 255 in all."""

Changes = tuple[str, ...]
"""What a variant changes, as `--set` takes it; nothing where it is the scene itself."""


class Outcome(NamedTuple):
    """What became of a variant.

    Attributes
    ----------
    changes
        What it changes.
    scene
        Its scene; that of the study where the changes give none.
    tally
        The account of its realizations; None if they were not run.
    why_not
        Why not, "" if they were.
    seconds
        Core time of a realization; the estimate where none was run.
    """

    changes: Changes
    scene: Scene
    tally: Tally | None
    why_not: str
    seconds: float

    @property
    def name(self) -> str:
        """The changes in one line."""
        return named(self.changes)


def leading(prepare: Prepare, study: Callable[[CampaignDirectory, Means], str]) -> Lead:
    """Return what has a crew compute what the study of an opened directory lacks.

    Parameters
    ----------
    prepare
        Computes what realizations share.
    study
        Runs variants with these means, writes what it found, and returns what it came to in a sentence.
    """

    def lead(directory: CampaignDirectory, crew: Crew, stop: StopRequest) -> ExitCode:
        try:
            verdict = study(directory, means_of(directory, prepare, crew, stop))
        except Stopped as stopped:
            return directory.leave(str(stopped), when="")
        manifest.end(directory.path, ExitCode.DONE, verdict)
        return ExitCode.DONE

    return lead


class Study:
    """Runs variants of a scene.

    Parameters
    ----------
    scene
        The scene that they change.
    realizations
        Number of realizations of each.
    budget
        Core time in s of all realizations together: what is estimated to exceed the rest of it is left out.
    means
        To compute with.
    """

    def __init__(self, scene: Scene, realizations: int, budget: float, means: Means) -> None:
        self.scene = scene
        self.realizations = realizations
        self._left = budget
        self._means = means
        self._pace = 1.0  # core time of the scene's own realizations relative to the estimate

    def run(self, *changes: str) -> Outcome:
        """Run what is missing of a variant.

        Raises
        ------
        Stopped
            If somebody asked for an end.
        """
        try:
            variant = variant_of(self.scene, changes)
        except SceneError as error:
            return Outcome(changes, self.scene, None, f"no valid scene: {error}", math.nan)
        estimate = self._pace * realization_seconds(variant)
        whole, directory = without_rule(variant, self.realizations), directory_of(self._means.home, changes)
        expected = self.realizations * estimate
        if expected > self._left and not _is_whole(whole, directory):
            why = f"left out: about {duration(expected)} of core time, and {duration(max(self._left, 0.0))} left"
            return Outcome(changes, variant, None, why, estimate)
        again = counted(self.realizations, "realization")
        run = SideRun(
            scene=lambda: whole,
            directory=directory,
            announcement=f"{named(changes)}: {again}, about {duration(expected)} of core time.",
            loss=f"{named(changes)} cannot be run.",
            known=[UNASKED],
        )
        made = make(run, self._means)
        if made.stopped:
            raise Stopped(made.stopped)
        if made.tally is None:
            return Outcome(changes, variant, None, made.refusal, estimate)
        times = [each.wall_time for k, each in made.tally.summaries.items() if k != BASELINE]
        seconds = float(np.nanmean(times)) if np.isfinite(times).any() else estimate
        self._left -= self.realizations * seconds
        if not changes:
            self._pace = seconds / realization_seconds(variant)
        return Outcome(changes, variant, made.tally, "", seconds)


def named(changes: Changes) -> str:
    """Return changes in one line, "numerics.cell = 2 m, numerics.courant = 0.4"."""
    return ", ".join(change.replace("=", " = ", 1) for change in changes) or OWN


def together(several: Iterable[Changes]) -> Changes:
    """Return all changes at once; where two change the same, the first counts."""
    changes = {change.partition("=")[0]: change for change in reversed([*chain.from_iterable(several)])}
    return tuple(sorted(changes.values()))


def directory_of(home: Path, changes: Changes) -> Path:
    """Return where the realizations of a variant are kept."""
    return home / VARIANTS / _short(re.sub(r"[^A-Za-z0-9.]+", "-", "_".join(changes))) if changes else home


def _short(name: str) -> str:
    """Return a name of a directory as it is, or so much of it as a file system takes and what tells it from others."""
    return name if len(name) <= LONGEST else f"{name[:LONGEST]}-{sha256(name.encode()).hexdigest()[:16]}"


def _is_whole(scene: Scene, directory: Path) -> bool:
    """Whether all realizations of a scene have been run."""
    tally = Level(scene, directory).tally()
    tally.add(UNASKED)
    return tally.size is not None
