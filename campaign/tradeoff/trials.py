"""What settings of a scene cost, and how far off a campaign with them is.

A campaign of n realizations costs n c and knows its mean to

    e(n) = |b| + z s / sqrt(n),

with c the core time of a realization, s the standard deviation between realizations and b how much the setting shifts
the mean against the finest mesh, from realizations that both have run. No number of realizations removes b.
"""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from campaign.accuracy.allocation import allocation
from campaign.accuracy.nested import FEWEST, nested_mean
from campaign.record import FAILED, UNHINDERED, Status
from campaign.running.study import Changes, Outcome, named
from campaign.scene import Scene
from campaign.scene.wanted import wanted_accuracy
from campaign.seeds import BASELINE
from campaign.statistics.intervals import Interval, Sample, mean_interval, normal_quantile
from campaign.statistics.repetition import unhindered_runout
from campaign.terminal import counted, duration

WORTH_IT = 0.9
"""Of the core time of a realization: what saves less is not told from the noise of a busy machine."""

END = {
    Status.no_slide: "stood",
    Status.timeout: "took too long",
    Status.diverged: "diverged",
    Status.left_domain: "left the ground",
    Status.crashed: "crashed",
    Status.reached_wall: "reached the wall ahead",
}
"""What is said of realizations without a run-out of their own."""


@dataclass(frozen=True, eq=False)
class Trial:
    """One setting, and what became of its realizations.

    Parameters
    ----------
    changes
        What it changes in the scene.
    cell
        In m.
    runouts
        Final run-out of realization 0, 1, ... in m, NaN of all that did not slide or had the wall ahead in the way.
    seconds
        Core time of one of them in s; the estimate where none was run.
    ends
        How those ended that did not slide or had the wall ahead in the way, and how many of each.
    why_not
        Why none was run, "" if they were.
    """

    changes: Changes
    cell: float
    runouts: Sample
    seconds: float
    ends: Mapping[Status, int] = field(default_factory=dict)
    why_not: str = ""

    @property
    def name(self) -> str:
        """The setting in one line."""
        return named(self.changes)

    @property
    def slides(self) -> int:
        """Number of realizations that slid without the wall ahead in the way."""
        return int(np.isfinite(self.runouts).sum())

    @property
    def is_sound(self) -> bool:
        """Whether there is something to compare: no failure, and slides enough."""
        return self.slides >= FEWEST and not FAILED.intersection(self.ends)

    @property
    def std(self) -> float:
        """Standard deviation between realizations in m."""
        return float(np.nanstd(self.runouts, ddof=1))

    @property
    def remark(self) -> str:
        """Why there is nothing to compare, "" if there is."""
        if self.why_not or self.is_sound:
            return self.why_not
        n = len(self.runouts)
        return ", ".join(f"{count} of {n} {END[status]}" for status, count in self.ends.items())


def trial_of(outcome: Outcome, realizations: int) -> Trial:
    """Return what a variant of a study has come to."""
    cell, tally = outcome.scene.numerics.cell, outcome.tally
    if tally is None:
        nothing = np.full(realizations, np.nan)
        return Trial(outcome.changes, cell, nothing, outcome.seconds, why_not=outcome.why_not)
    summaries = [each for k, each in sorted(tally.summaries.items()) if k != BASELINE][:realizations]
    runouts = np.array([unhindered_runout(each, tally.front) for each in summaries])
    ends = Counter(each.status for each in summaries if each.status not in UNHINDERED)
    return Trial(outcome.changes, cell, runouts, outcome.seconds, ends)


class Judged(NamedTuple):
    """A setting against the finest mesh.

    Attributes
    ----------
    trial : Trial
    shift : Interval
        Of the mean run-out in m, from realizations that slid in both; exactly zero for the finest mesh itself.
    quantile : float
        Of the normal distribution, for the half-width of the sampling error.
    """

    trial: Trial
    shift: Interval
    quantile: float

    @property
    def bias(self) -> float:
        """The largest shift in m that the realizations leave possible."""
        return max(abs(self.shift.lower), abs(self.shift.upper))

    def error(self, seconds: float) -> float:
        """Return the total error in m, at most, of a campaign that takes so much core time."""
        return self.bias + self.quantile * self.trial.std * math.sqrt(self.trial.seconds / seconds)

    def cost(self, error: float) -> float:
        """Return the core time in s of a campaign with such a total error in m; infinite where there is none."""
        room = error - self.bias
        return self.sampling_cost(room) if room > 0 else math.inf

    def sampling_cost(self, half_width: float) -> float:
        """Return the core time in s until the sampling error is so large in m."""
        return max(FEWEST, (self.quantile * self.trial.std / half_width) ** 2) * self.trial.seconds


@dataclass(frozen=True, eq=False)
class Tradeoff:
    """All settings that were tried, the scene as it is first; `reference` is one of them, with the finest mesh."""

    scene: Scene
    trials: Sequence[Trial]
    reference: Trial

    @cached_property
    def judged(self) -> list[Judged]:
        """The sound trials."""
        return [self._judged(trial, self.reference) for trial in self.trials if trial.is_sound]

    def _judged(self, trial: Trial, reference: Trial) -> Judged:
        confidence = self.scene.campaign.confidence
        shift = Interval(0.0, 0.0, 0.0, trial.slides)
        if trial is not reference:
            shift = mean_interval(_paired(trial, reference), confidence)
        return Judged(trial, shift, normal_quantile(confidence))

    @property
    def harmless(self) -> list[Changes]:
        """What makes the scene cheaper on its own mesh and shifts its mean by little, of each kind the cheapest.

        By little means by less than half of the wanted error, as far as the realizations tell.
        """
        own, best = self.trials[0], dict[str, Changes]()
        for trial in sorted(self.trials, key=lambda trial: trial.seconds):
            is_cheaper = trial.is_sound and trial.cell == own.cell and trial.seconds < WORTH_IT * own.seconds
            if is_cheaper and self._judged(trial, own).bias < self.wanted / 2:
                best.setdefault(trial.changes[0].partition("=")[0], trial.changes)
        return [*best.values()]

    @property
    def mean(self) -> float:
        """The mean run-out in m on the finest mesh."""
        return float(np.nanmean(self.reference.runouts))

    @property
    def wanted(self) -> float:
        """The total error in m that a setting is recommended for."""
        return wanted_accuracy(self.scene, self.mean)

    @property
    def sampling(self) -> float:
        """The sampling error in m at which campaigns of the settings are drawn: half of the wanted error."""
        return self.wanted / 2

    @property
    def mesh_doubt(self) -> float:
        """How far off the finest mesh itself may be in m: by what the last halving changed; NaN without one."""
        coarser = [each for each in self.trials if not each.changes and each is not self.reference and each.is_sound]
        return abs(float(np.mean(_paired(self.reference, coarser[0])))) if coarser else math.nan

    @property
    def front(self) -> list[Judged]:
        """Settings than which no cheaper one is as near, by campaigns of the drawn sampling error."""
        front: list[Judged] = []
        for each in sorted(self.judged, key=lambda each: each.sampling_cost(self.sampling)):
            if not front or each.bias < front[-1].bias:
                front.append(each)
        return front

    @property
    def recommended(self) -> Judged | None:
        """The setting with which the wanted error costs least; None if none reaches it."""
        best = min(self.judged, key=lambda each: each.cost(self.wanted))
        return best if math.isfinite(best.cost(self.wanted)) else None

    def of(self, trial: Trial) -> Judged | None:
        """Return how a trial is judged, None if it is not."""
        return next((each for each in self.judged if each.trial is trial), None)

    def multilevel_cost(self, half_width: float) -> float:
        """Return the core time in s to know the mean on the finest mesh so well in m, with cheaper models beside it.

        As `--accuracy` would, with those of the settings that it knows. NaN where there are none.
        """
        models = [self.reference, *(each for each in self.trials if each.is_sound and _is_cheap_model(each))]
        models = sorted({id(each): each for each in models}.values(), key=lambda each: -each.seconds)
        slid = np.isfinite([each.runouts for each in models]).all(axis=0)
        if len(models) < 2 or models[0] is not self.reference or slid.sum() < FEWEST:
            return math.nan
        scatter = nested_mean([each.runouts[slid] for each in models]).scatter
        variance = (half_width / normal_quantile(self.scene.campaign.confidence)) ** 2
        cost = [each.seconds for each in models]
        counts = allocation(scatter, cost, variance, [FEWEST] * len(models))
        return math.fsum(n * c for n, c in zip(counts, cost, strict=True))

    @property
    def advice(self) -> str:
        """What to choose, in sentences."""
        reference, chosen = self.reference, self.recommended
        n = counted(len(reference.runouts), "realization")
        mean = f"the mean run-out with cells of {reference.cell:g} m ({self.mean:.2f} m in {n})"
        if chosen is None:
            nearest = min(self.judged, key=lambda each: each.bias)
            found = (
                f"None of the settings gives {mean} to {self.wanted:.2f} m: the nearest, {nearest.trial.name}, may "
                f"shift it by up to {nearest.bias:.2f} m."
            )
        else:
            shift = f", which shifts it by up to {chosen.bias:.2f} m," if chosen.bias else ""
            found = (
                f"Recommended: {chosen.trial.name}. A campaign with it{shift} gives {mean} to {self.wanted:.2f} m in "
                f"{duration(chosen.cost(self.wanted))} of core time{self._gain(chosen)}."
            )
        return " ".join(filter(None, [found, self._multilevel(chosen), self._doubt]))

    def _multilevel(self, chosen: Judged | None) -> str:
        """Say what an accuracy would take, where that is less."""
        cost, usual = self.multilevel_cost(self.wanted), chosen.cost(self.wanted) if chosen else math.inf
        if not cost < usual:
            return ""
        cell, told = self.reference.cell, duration(cost)
        return f"An --accuracy, which runs cheaper models beside those cells of {cell:g} m, would take {told}."

    def _gain(self, chosen: Judged) -> str:
        own, cost = self.of(self.trials[0]), chosen.cost(self.wanted)
        if own is None or own is chosen:
            return ""
        usual = own.cost(self.wanted)
        if math.isfinite(usual):
            return f", {100 * cost / usual:.2g} % of what the scene as it is takes"
        return f"; the scene as it is may shift it by up to {own.bias:.2f} m, however many realizations it runs"

    @property
    def _doubt(self) -> str:
        if math.isnan(self.mesh_doubt):
            return "How far off that mesh itself is, is not known: a finer one did not fit into the budget."
        return (
            f"That mesh itself may be off by some {self.mesh_doubt:.2f} m, which is what the last halving of the cell "
            "changed."
        )


def _paired(trial: Trial, other: Trial) -> Sample:
    differences = trial.runouts - other.runouts
    return differences[np.isfinite(differences)]


def _is_cheap_model(trial: Trial) -> bool:
    """Whether `--accuracy` would run it, too: other cells, softer ground."""
    keys = (change.partition("=")[0] for change in trial.changes)
    return all(key == "numerics.cell" or key.endswith(".young_modulus") for key in keys)
