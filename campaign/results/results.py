"""The results of a campaign as terminal and report see them: the dataset and the scene it answers."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.errors import RefusalError
from campaign.record import FAILED, USABLE, Status
from campaign.scene import Scene, kept_scene
from campaign.seeds import BASELINE
from campaign.statistics.discretisation import Discretisation
from campaign.statistics.intervals import Sample
from campaign.storage.formats import check_format
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
    def is_usable(self) -> NDArray[np.bool_]:
        """Whether the run-out of a realization counts, (realization,)."""
        return self.has_status(USABLE)

    @property
    def has_failed(self) -> NDArray[np.bool_]:
        """Whether a realization has no result, (realization,)."""
        return self.has_status(FAILED)

    @property
    def runouts(self) -> Sample:
        """Final run-out of realization 0, 1, 2, ... in m, NaN where it does not count."""
        return np.where(self.is_usable, self.data["final_runout"].values, np.nan)

    @property
    def usable_runouts(self) -> Sample:
        """Final run-outs that count, in m, in the order of realizations."""
        return self.usable("final_runout")

    @property
    def deterministic(self) -> float:
        """Final run-out with mean strengths in m; NaN if that run failed."""
        failed = int(self.data["deterministic_status"]) in FAILED
        return np.nan if failed else float(self.data["deterministic_final_runout"])

    @property
    def discretisation(self) -> Discretisation | None:
        """What half the cell changes; None where the campaign does not say."""
        if "paired_difference" not in self.data:
            return None
        differences, deterministic = self.data["paired_difference"], self.data["deterministic_paired_difference"]
        return Discretisation(self.scene.numerics.cell, differences.values, float(deterministic), self.confidence)

    def usable(self, quantity: str) -> Sample:
        """Return a scalar of the realizations whose run-out counts, in their order."""
        values: Sample = self.data[quantity].values[self.is_usable]
        return values

    def has_status(self, statuses: Iterable[Status]) -> NDArray[np.bool_]:
        """Whether a realization ended in one of these ways, (realization,)."""
        return np.isin(self.data["status"].values, [int(status) for status in statuses])

    def by_status(self) -> dict[Status, int]:
        """Return how many realizations ended in each way."""
        return {status: int(np.count_nonzero(self.has_status([status]))) for status in Status}

    def final_runout(self, realization: int) -> float:
        """Return the final run-out of one realization, or of the baseline, in m."""
        if realization == BASELINE:
            return float(self.data["deterministic_final_runout"])
        return float(self.data["final_runout"].sel(realization=realization))

    def ranked(self, share: float) -> int:
        """Return the realization with the given share of the usable run-outs below it: 0 the shortest, 1 the longest.

        Raises
        ------
        ValueError
            If no run-out counts.
        """
        runouts = self.runouts
        order = np.argsort(runouts, kind="stable")[: np.count_nonzero(self.is_usable)]
        if order.size == 0:
            raise ValueError("No run-out counts, so none is the shortest, the median or the longest.")
        return int(self.data["realization"].values[order[round(share * (order.size - 1))]])


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
    overrides = filter(None, str(data.attrs["scene_overrides"]).split("\n"))
    return Results(data, kept_scene(str(data.attrs["scene"]), overrides))
