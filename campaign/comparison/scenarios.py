"""Several campaigns, and the realizations that count in all of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.errors import RefusalError
from campaign.record import FINAL_RUNOUT, LOWER_BOUND, USABLE, Front
from campaign.results.results import Results, read_results
from campaign.results.walls import REACHED_BEHIND
from campaign.scene.comparison import differing_values
from campaign.scene.document import numbered_from_one
from campaign.statistics.intervals import Sample
from campaign.statistics.outcomes import FEW
from campaign.statistics.receptors import REACHED, may_still_come, still_moves
from campaign.terminal import counted

SAME_PLACE = 1e-6
"""Distance in m below which places are one."""


class Change(NamedTuple):
    """A key in which the scene of a campaign differs from that of the first one, with both values as people write them.

    Attributes
    ----------
    key, first, other : str
    """

    key: str
    first: str
    other: str


@dataclass(frozen=True)
class Comparison:
    """Campaigns with the realizations that have a result in all of them; the first is what the others are held against.

    Parameters
    ----------
    names : tuple of str
        Of the scenarios: their directories.
    scenarios : tuple of Results
    ids : int array (realization,)
        Realizations that have a result in every scenario.
    """

    names: tuple[str, ...]
    scenarios: tuple[Results, ...]
    ids: NDArray[np.int64]

    @property
    def front(self) -> Front:
        """The front whose run-out is compared: that of the first campaign's statistics."""
        return self.scenarios[0].front

    @property
    def confidence(self) -> float:
        """Of every interval: that of the first campaign."""
        return self.scenarios[0].confidence

    @property
    def receptors(self) -> tuple[str, ...]:
        """Names of the receptors that all campaigns have at the same place, in the order of the first."""
        return tuple(name for name in self.shared_names if self.is_one_place(name))

    @property
    def shared_names(self) -> tuple[str, ...]:
        """Names that receptors of all campaigns have, whatever their places, in the order of the first."""
        named = [_receptors(each) for each in self.scenarios]
        return tuple(name for name in named[0] if all(name in others for others in named))

    def stretches(self, receptor: str) -> Sample:
        """Return near and far end of a receptor in each campaign in m, (scenario, 2)."""
        return np.array([each.data["receptor_x_bounds"].sel(receptor=receptor).values for each in self.scenarios])

    def is_one_place(self, receptor: str) -> bool:
        """Whether a receptor is at the same x in all campaigns, or as far from the toe: a longer crest moves both."""
        stretches = self.stretches(receptor)
        toes = np.array([[float(each.data.attrs["toe_x"])] for each in self.scenarios])
        return any(np.ptp(ends, axis=0).max() < SAME_PLACE for ends in (stretches, stretches - toes))

    def is_cut_short(self, scenario: int) -> bool:
        """Whether walls or the end of the run cut so many slides short that numbers of them are lower bounds."""
        return self._are_many(self.cut_short(scenario), scenario)

    def cut_short(self, scenario: int) -> NDArray[np.bool_]:
        """Return which realizations may have come farther than they did, (realization,)."""
        return self.scenarios[scenario].has_status(LOWER_BOUND)[self.ids]

    def reached_behind(self, scenario: int) -> NDArray[np.bool_]:
        """Return which slides have reached the wall behind the crest, (realization,)."""
        is_there = self.scenarios[scenario].data[REACHED_BEHIND].values[self.ids] == 1
        return np.asarray(self.has_slid(scenario) & is_there)

    def still_moves(self, scenario: int) -> NDArray[np.bool_]:
        """Return in which slides any ground still moved at the end, (realization,)."""
        return still_moves(self.scenarios[scenario].data)[self.ids]

    def has_least_volumes(self, scenario: int) -> bool:
        """Whether more would move in so many slides that the mean volume is a lower bound: walls, or the end."""
        which = (self.cut_short, self.reached_behind, self.still_moves)
        return self._are_many(np.logical_or.reduce([each(scenario) for each in which]), scenario)

    def _are_many(self, which: NDArray[np.bool_], scenario: int) -> bool:
        """Whether some of the slides are more than a few."""
        return bool(np.count_nonzero(which) > FEW * np.count_nonzero(self.has_slid(scenario)))

    def has_slid(self, scenario: int) -> NDArray[np.bool_]:
        """Whether each realization slid, (realization,)."""
        return self.scenarios[scenario].has_slid[self.ids]

    def runouts(self, scenario: int) -> Sample:
        """Return final run-outs in m, zero without a slide, (realization,)."""
        return self._of_slides(scenario, FINAL_RUNOUT[self.front])

    def volumes(self, scenario: int) -> Sample:
        """Return sliding volumes in m3/m, zero without a slide, (realization,)."""
        return self._of_slides(scenario, "sliding_volume")

    def reaches(self, scenario: int, what: str, receptor: str) -> NDArray[np.bool_]:
        """Whether something, a name in `REACHED`, reaches a receptor in each realization, (realization,)."""
        data = self.scenarios[scenario].data
        reached = data[what].values[self.ids, _receptors(self.scenarios[scenario]).index(receptor)]
        return np.asarray(reached == 1.0)

    def may_reach(self, scenario: int, what: str, receptor: str) -> NDArray[np.bool_]:
        """Whether it was cut short before that, and may have reached it, (realization,)."""
        data = self.scenarios[scenario].data.isel(receptor=_receptors(self.scenarios[scenario]).index(receptor))
        return may_still_come(data)[what][self.ids]

    def changes(self, scenario: int) -> list[Change]:
        """Return the keys in which the scene of a scenario differs from the first one's."""
        first, other = (self.scenarios[number].scene.identity() for number in (0, scenario))
        return [Change(numbered_from_one(key), *texts) for key, texts in differing_values(first, other).items()]

    def _of_slides(self, scenario: int, quantity: str) -> Sample:
        values = self.scenarios[scenario].data[quantity].values[self.ids]
        return np.where(self.has_slid(scenario), values, 0.0)


def compare(directories: Sequence[Path]) -> Comparison:
    """Read campaigns and find the realizations that all of them have; the first one is the reference.

    Raises
    ------
    RefusalError
        When there are fewer than two, one is given twice or has no results, or no realization has a result in all.
    """
    places = [directory.resolve() for directory in directories]
    if len(places) < 2:
        raise RefusalError("One campaign alone has nothing to be compared with; give two or more directories.")
    if twice := [str(given) for given, place in zip(directories, places, strict=True) if places.count(place) > 1]:
        raise RefusalError(f"{twice[0]} is given more than once; give each campaign once.")
    scenarios = tuple(read_results(directory) for directory in directories)
    usable = [set(np.flatnonzero(each.has_status(USABLE)).tolist()) for each in scenarios]
    common = sorted(set.intersection(*usable))
    if not common:
        raise RefusalError(
            "There is no realization that has a result in all of these campaigns, so there is nothing to compare; "
            f"{_counts(directories, usable)}. Continue them with campaign run DIR."
        )
    return Comparison(_names(directories), scenarios, np.array(common))


def _counts(directories: Sequence[Path], usable: list[set[int]]) -> str:
    pairs = zip(directories, usable, strict=True)
    return ", ".join(f"{directory} has {counted(len(ids), 'realization')} with a result" for directory, ids in pairs)


def _names(directories: Sequence[Path]) -> tuple[str, ...]:
    """Return the last parts of the paths, or the paths as given where these are the same."""
    short = tuple(directory.resolve().name for directory in directories)
    return short if len(set(short)) == len(short) else tuple(map(str, directories))


def _receptors(results: Results) -> list[str]:
    """Return the names of a campaign's receptors."""
    if not results.data.data_vars.keys() >= REACHED.keys():
        return []
    return [str(name) for name in results.data["receptor"].values]
