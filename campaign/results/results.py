"""The results of a campaign as terminal and report see them: the dataset and the scene it answers."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.errors import RefusalError
from campaign.record import FAILED, FINAL_RUNOUT, SLID, Front, RealizationSummary, Status
from campaign.results.walls import REACHED_BEHIND, with_walls_told_apart
from campaign.scene import Scene, kept_scene
from campaign.seeds import BASELINE
from campaign.statistics.discretisation import Discretisation
from campaign.statistics.intervals import Sample
from campaign.statistics.outcomes import Outcomes, outcomes_of
from campaign.statistics.release import OTHER, ReleaseComparison
from campaign.storage.formats import FORMAT, check_format
from campaign.storage.layout import RESULTS


@dataclass(frozen=True)
class Results:
    """The dataset of a campaign, in memory.

    Parameters
    ----------
    data : xarray.Dataset
        As `campaign.results.dataset` builds it.
    scene : Scene
    """

    data: xr.Dataset
    scene: Scene

    @property
    def realizations(self) -> int:
        """Number of realizations in the result, whatever became of them."""
        return self.data.sizes["realization"]

    @property
    def confidence(self) -> float:
        """Of every interval."""
        return self.scene.campaign.confidence

    @property
    def front(self) -> Front:
        """The front whose run-out statistics are of."""
        return self.scene.slide.front

    @property
    def has_slid(self) -> NDArray[np.bool_]:
        """Whether a realization slid, (realization,)."""
        return self.has_status(SLID)

    @property
    def has_failed(self) -> NDArray[np.bool_]:
        """Whether a realization has no result, (realization,)."""
        return self.has_status(FAILED)

    @cached_property
    def outcomes(self) -> Outcomes:
        """What became of the realizations, for statistics."""
        columns = [self.data[name].values.tolist() for name in ("status", *FINAL_RUNOUT.values())]
        rows = enumerate(zip(*columns, strict=True))
        summaries = (_summary(k, status, mass, tip) for k, (status, mass, tip) in rows)
        return outcomes_of(summaries, self.front)

    @property
    def runouts(self) -> Sample:
        """Final run-out of realization 0, 1, 2, ... in m, NaN where it did not slide."""
        return np.where(self.has_slid, self.data[FINAL_RUNOUT[self.front]].values, np.nan)

    @property
    def slide_runouts(self) -> Sample:
        """Final run-outs of the slides in m, in the order of realizations."""
        return self.of_slides(FINAL_RUNOUT[self.front])

    @property
    def deterministic(self) -> float:
        """Final run-out with mean strengths in m: zero if it does not slide, NaN if that run failed."""
        return self.deterministic_run.runout(self.front)

    @property
    def deterministic_run(self) -> RealizationSummary:
        """How the run with mean strengths ended."""
        return self._deterministic("deterministic")

    @property
    def discretisation(self) -> Discretisation | None:
        """What half the cell changes; None where the campaign does not say."""
        if "paired_difference" not in self.data:
            return None
        differences, deterministic = self.data["paired_difference"], self.data["deterministic_paired_difference"]
        repeated, standing = (int(differences.attrs.get(name, 0)) for name in ("repeated", "standing"))
        cell, change = self.scene.numerics.cell, float(deterministic)
        return Discretisation(cell, differences.values, change, self.confidence, repeated, standing)

    @property
    def release(self) -> ReleaseComparison | None:
        """The deterministic run with the other release protocol; None where the campaign does not say."""
        if "other_release_status" not in self.data:
            return None
        return ReleaseComparison(OTHER[self.scene.numerics.gravity], self._deterministic("other_release"))

    def _deterministic(self, which: str) -> RealizationSummary:
        mass, tip = (float(self.data[f"{which}_{name}"]) for name in FINAL_RUNOUT.values())
        return _summary(BASELINE, int(self.data[f"{which}_status"]), mass, tip)

    @property
    def reached_behind(self) -> NDArray[np.bool_]:
        """Which slides have reached the wall behind the crest, (slides,): it disturbs their run-out, and bounds it not.

        Their volume, and what they take behind the crest, are lower bounds.
        """
        return np.asarray(self.of_slides(REACHED_BEHIND) == 1)

    def of_slides(self, quantity: str) -> Sample:
        """Return a scalar of the realizations that slid, in their order."""
        values: Sample = self.data[quantity].values[self.has_slid]
        return values

    def has_status(self, statuses: Iterable[Status]) -> NDArray[np.bool_]:
        """Whether a realization ended in one of these ways, (realization,)."""
        return np.isin(self.data["status"].values, [int(status) for status in statuses])

    def by_status(self) -> dict[Status, int]:
        """Return how many realizations ended in each way."""
        return {status: int(np.count_nonzero(self.has_status([status]))) for status in Status}

    def final_runout(self, realization: int) -> float:
        """Return how far the front-most particle of one realization, or of the baseline, came in m."""
        if realization == BASELINE:
            return float(self.data["deterministic_final_runout"])
        return float(self.data["final_runout"].sel(realization=realization))

    def ranked(self, share: float) -> int:
        """Return the realization with the given share of the slides' run-outs below it: 0 the shortest, 1 the longest.

        Raises
        ------
        ValueError
            If nothing slid.
        """
        runouts = self.runouts
        order = np.argsort(runouts, kind="stable")[: np.count_nonzero(self.has_slid)]
        if order.size == 0:
            raise ValueError("Nothing slid, so no run-out is the shortest, the median or the longest.")
        return int(self.data["realization"].values[order[round(share * (order.size - 1))]])


def _summary(realization: int, status: int, mass: float, tip: float) -> RealizationSummary:
    return RealizationSummary(realization, Status(status), tip, mass, np.nan)


def open_results(directory: str | Path) -> xr.Dataset:
    """Return the dataset of the campaign in `directory`, in memory; the file may be replaced meanwhile.

    Raises
    ------
    RefusalError
        When there is none, or one that only a newer version can read.
    """
    path = Path(directory) / RESULTS
    if not path.exists():
        raise RefusalError(f"{directory} holds no {RESULTS}; give the directory of a campaign that has results.")
    with xr.open_dataset(path, decode_timedelta=False) as opened:
        check_format(opened.attrs.get("format", 0), str(opened.attrs.get("format_reader", "")), str(path))
        return opened.load()


def read_results(directory: Path) -> Results:
    """Read the results of the campaign in `directory`.

    Raises
    ------
    RefusalError
        When there are none, or when this version cannot read them or the scene that made them.
    """
    data = open_results(directory)
    kept = int(data.attrs.get("format", 0))
    if kept < FORMAT:
        raise RefusalError(
            f"{directory / RESULTS} is of format {kept}, before statistics of all realizations were told from those of "
            f"the slides (format {FORMAT}). campaign run {directory} --allow-drift makes it again from the records."
        )
    overrides = filter(None, str(data.attrs["scene_overrides"]).split("\n"))
    return Results(with_walls_told_apart(data), kept_scene(str(data.attrs["scene"]), overrides))
