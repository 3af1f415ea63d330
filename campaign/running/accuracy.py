"""A campaign with an accuracy as its aim: as many runs of each of its models as that takes.

Which runs that takes depends on the results alone, neither on ranks nor on interruptions.
"""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from campaign.accuracy.field_control import deviations
from campaign.accuracy.mesh_limit import Runs
from campaign.accuracy.pursuit import Model, Pursuit, Wanted, pursue
from campaign.accuracy.settings import HALF, OWN, Models, models_of
from campaign.accuracy.wording import plan, setting
from campaign.errors import RefusalError
from campaign.record import LOWER_BOUND, SLID
from campaign.running.level import Level
from campaign.running.side_run import Means, SideRun, Stopped, make
from campaign.scene import Scene
from campaign.scene.constraints import tolerance
from campaign.scene.layers import random_properties
from campaign.statistics.repetition import UNASKED, without_rule
from campaign.statistics.ridge import Matrix
from campaign.statistics.tally import Tally
from campaign.storage.layout import HALF_CELL, MODELS
from campaign.storage.record_store import RecordStore
from campaign.terminal import counted, say


class OwnRuns(NamedTuple):
    """The realizations that a campaign has run in its own setting.

    Attributes
    ----------
    tally : Tally
        Their account.
    stopped : str
        Why that is not all, "" if it is.
    aim : Aim or None
        What came of an accuracy that was asked for.
    """

    tally: Tally
    stopped: str
    aim: "Aim | None" = None


class Aim(NamedTuple):
    """What came of the pursuit of an accuracy, and the models that it ran."""

    pursuit: Pursuit
    models: Models

    @property
    def pairs(self) -> int:
        """Number of realizations that both the scene and half its cell have run."""
        return self.counts[HALF]

    @property
    def counts(self) -> dict[str, int]:
        """Number of realizations by the name of the model that has run them."""
        names = (model.name for model in self.pursuit.models)
        return dict(zip(names, self.pursuit.counts, strict=True))


def to_accuracy(scene: Scene, means: Means) -> OwnRuns:
    """Run the models of a scene until its accuracy is reached.

    Raises
    ------
    RefusalError
        If the scene has no models that could tell.
    """
    models = models_of(scene)
    say(f"Accuracy: {plan(models, scene)}")

    @cache  # a round asks again for what does not grow in it
    def runs(model: Model, count: int) -> Runs:
        return _runs(model, models.scenes[model], count, means)

    def compute(counts: Mapping[Model, int]) -> dict[Model, Runs]:
        cheapest_first = reversed([*counts.items()])
        return {model: runs(model, count) for model, count in cheapest_first}

    def account(realizations: int) -> Tally:
        return Level(without_rule(scene, realizations), means.home, means.retry).tally()

    try:
        pursuit = pursue(models.ladders, _wanted(scene), compute)
    except Stopped as stopped:
        return OwnRuns(account(scene.campaign.realizations), str(stopped))
    aim = Aim(pursuit, models)
    return OwnRuns(account(aim.counts[OWN]), "", aim)


def _wanted(scene: Scene) -> Wanted:
    asked = scene.campaign
    return Wanted(tolerance(asked.accuracy or ""), asked.confidence, asked.realizations)


def _runs(model: Model, scene: Scene, count: int, means: Means) -> Runs:
    """Have so many realizations of a model run, and return them."""
    whole, home = without_rule(scene, count), directory_of(means.home, model)
    run = SideRun(
        scene=lambda: whole,
        directory=home,
        announcement=f"Accuracy: {counted(count, 'realization')} in all {setting(scene)}.",
        loss="The accuracy cannot be reached.",
        known=[] if model.name in (OWN, HALF) else [UNASKED],
    )
    made = make(run, means)
    if made.tally is None:
        if made.stopped:
            raise Stopped(made.stopped)
        raise RefusalError(f"The accuracy cannot be reached without realizations {setting(scene)}.")
    return _as_runs(made.tally, home, scene)


def directory_of(home: Path, model: Model) -> Path:
    """Return where the realizations of a model are kept."""
    if model.name == OWN:
        return home
    return home / HALF_CELL if model.name == HALF else home / MODELS / model.name


def _as_runs(tally: Tally, directory: Path, scene: Scene) -> Runs:
    summaries = [tally.summaries[k] for k in range(tally.maximum)]
    runout = np.array([each.runout(tally.front) for each in summaries])
    slid = np.array([float(each.status in SLID) for each in summaries])
    cut_short = sum(each.status in LOWER_BOUND for each in summaries)
    return Runs(runout, slid, deviations(_field_maps(directory, scene, tally.maximum), scene), cut_short)


def _field_maps(directory: Path, scene: Scene, count: int) -> Matrix:
    """Return the coarse maps of the fields, (n, property, row, column); without boxes where the records hold none."""
    maps: dict[int, Matrix] = {}
    for block in RecordStore(directory, scene.digest()).columns(count):
        found = block.values.get("field_map", np.empty((len(block), len(random_properties(scene)), 0, 0)))
        maps |= dict(zip(block.realizations.tolist(), found, strict=True))
    return np.stack([maps[k] for k in range(count)]).astype(np.float64)
