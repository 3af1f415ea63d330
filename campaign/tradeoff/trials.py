"""`campaign tradeoff`: what a scene's numerical choices cost in time and in accuracy, against a finer mesh.

Realization k is the same ground whatever the numerics, so that a few of them, and the run with mean strengths, compare
settings without the scatter between realizations. The reference is the scene with half its cell where the budget
allows, otherwise the scene itself.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from campaign.errors import RefusalError, SamplerError
from campaign.record import FINAL_RUNOUT, UNHINDERED, Status
from campaign.scene import Scene, kept_scene
from campaign.scene.cost import realization_seconds
from campaign.seeds import BASELINE
from campaign.simulation.contract import Interrupted
from campaign.simulation.flags import without_debris
from campaign.simulation.ground import Ground, prepare
from campaign.statistics.intervals import Sample
from campaign.terminal import duration
from solver.timestep import largest_courant

NEAR = 0.05
"""Of the reference's run-out: a setting this near is good enough to be recommended."""

OWN = "as the scene says"

WITHOUT_RUNOUT = {Status.no_slide: "the slope stands", Status.timeout: "took too long"}
"""Ends of a run that has no run-out to compare, where its record does not say why."""

CHOICES: dict[str, Sequence[str | int | float]] = {
    "numerics.basis": ("gimp", "linear", "bspline"),
    "numerics.stress_update": ("musl", "usl", "usf"),
    "numerics.locking": ("none", "cell-average"),
    "numerics.courant": (0.3, 0.6, 0.9),
    "numerics.particles_per_cell": (4, 9, 16),
}


@dataclass(frozen=True, eq=False)
class Trial:
    """One setting: the scene with an override, and what became of it.

    Parameters
    ----------
    setting
        The override, or `OWN`.
    cell
        In m.
    runouts
        Final run-out of the deterministic run and of realization 0, 1, ... in m, NaN where there is none.
    seconds
        Median CPU time of one of them in s; the estimate where none was run.
    reason
        Why runs have no run-out, or it was left out; "" if neither.
    was_run
        Whether it was tried at all.
    """

    setting: str
    cell: float
    runouts: Sample
    seconds: float
    reason: str = ""
    was_run: bool = True

    @property
    def failures(self) -> int:
        """Number of runs without a run-out."""
        return int(np.count_nonzero(np.isnan(self.runouts)))

    def differences(self, reference: "Trial") -> Sample:
        """Return the final run-outs less those of the reference in m."""
        return self.runouts - reference.runouts

    def rms(self, reference: "Trial") -> float:
        """Return the root mean square difference of final run-outs in m; NaN if any failed."""
        return float(np.sqrt(np.mean(self.differences(reference) ** 2)))

    def bias(self, reference: "Trial") -> float:
        """Return the mean difference of final run-outs in m; NaN if any failed."""
        return float(np.mean(self.differences(reference)))


@dataclass(frozen=True, eq=False)
class Tradeoff:
    """All settings of a scene; `reference` is one of `trials`."""

    scene: Scene
    trials: Sequence[Trial]
    reference: Trial

    @property
    def compared(self) -> list[Trial]:
        """Trials without a failure, the cheapest first."""
        sound = [trial for trial in self.trials if trial.was_run and not trial.failures]
        return sorted(sound, key=lambda trial: trial.seconds)

    @property
    def front(self) -> list[Trial]:
        """Trials that no cheaper one equals in accuracy, the cheapest first."""
        front: list[Trial] = []
        for trial in self.compared:
            if not front or trial.rms(self.reference) < front[-1].rms(self.reference):
                front.append(trial)
        return front

    @property
    def recommended(self) -> Trial | None:
        """The cheapest trial on the front within `NEAR` of the reference, other than that; None if there is none."""
        allowed = NEAR * float(np.mean(self.reference.runouts))
        near = (t for t in self.front if t is not self.reference and t.rms(self.reference) <= allowed)
        return next(near, None)

    @property
    def advice(self) -> str:
        """What to choose, in a sentence."""
        chosen, reference = self.recommended, self.reference
        against = f"the run-outs with cells of {reference.cell:g} m ({reference.setting})"
        if chosen is None:
            return f"No cheaper setting is within {100 * NEAR:g} % of {against}, so none of them is recommended."
        faster = reference.seconds / chosen.seconds
        return (
            f"Recommended: {chosen.setting}, within {chosen.rms(reference):.2f} m of {against} at a cost {faster:.1f} "
            "times smaller."
        )


def settings(scene: Scene) -> list[str]:
    """Return the overrides to try one at a time; those of the scene itself are left out."""
    cell, modulus = scene.numerics.cell, scene.soil.young_modulus
    own = {key: getattr(scene.numerics, key.partition(".")[2]) for key in CHOICES}
    return [
        f"numerics.cell={2 * cell:g} m",
        *(f"{key}={value}" for key, values in CHOICES.items() for value in values if value != own[key]),
        f"soil.young_modulus={modulus / 4e6:g} MPa",
    ]


def needed(scene: Scene, setting: str) -> list[str]:
    """Return what a basis or a stress update needs beside it: a stable Courant number, and no averages of wide domains.

    Those that are unstable at any Courant number need what is not there.
    """
    key, value = setting.split("=")
    own = scene.numerics.model_dump() | {key.partition(".")[2]: value}
    if key not in ("numerics.basis", "numerics.stress_update"):
        return []
    largest = largest_courant(own["basis"], own["stress_update"])
    step = [f"numerics.courant={largest:g}"] if 0.0 < largest < scene.numerics.courant else []
    averaged = own["basis"] == "bspline" and scene.numerics.locking == "cell-average"
    return step + ["numerics.locking=none"] * averaged


def compare(scene: Scene, realizations: int, budget: float, directory: Path, say: Callable[[str], None]) -> Tradeoff:
    """Run the deterministic run and `realizations` realizations of a scene with each setting.

    Parameters
    ----------
    scene
    realizations
        Random fields to run.
    budget
        CPU time in s; what is estimated to exceed the rest of it is left out; half the cell comes first.
    directory
        For files of the field sampler.
    say
        Hears a line for every setting.

    Raises
    ------
    RefusalError
        If the scene itself gives no run-out.
    """
    bench = Bench(realizations, budget, directory)
    own = bench.tried(OWN, scene, realization_seconds(scene), say)
    if own.failures:
        raise RefusalError(f"The scene itself gives no run-out to compare with: {own.reason or 'over the budget'}.")
    speed = own.seconds / realization_seconds(scene)
    trials = [own]
    for setting in (f"numerics.cell={scene.numerics.cell / 2:g} m", *settings(scene)):
        overrides = [setting, *needed(scene, setting)]
        told = ", ".join(overrides)
        try:
            variant = kept_scene(scene.text, [*scene.overrides, *overrides])
        except RefusalError as refusal:
            say(f"{told}: left out, no valid scene. {refusal.__cause__}")
            continue
        trials.append(bench.tried(told, variant, speed * realization_seconds(variant), say))
    return Tradeoff(scene, trials, min((t for t in trials if not t.failures), key=lambda trial: trial.cell))


class Bench:
    """Runs settings while the budget lasts."""

    def __init__(self, realizations: int, budget: float, directory: Path) -> None:
        self.ids = range(BASELINE, realizations)
        self._end = time.process_time() + budget
        self._directory = directory

    def tried(self, setting: str, scene: Scene, estimate: float, say: Callable[[str], None]) -> Trial:
        """Run a setting of which a realization is estimated to cost `estimate` seconds, or say why not."""
        total, left = estimate * len(self.ids), self._end - time.process_time()
        if total > left:
            reason = f"left out, about {duration(total)} of CPU time and {duration(max(left, 0))} left"
            say(f"{setting}: {reason}")
            return Trial(setting, scene.numerics.cell, np.full(len(self.ids), np.nan), estimate, reason, was_run=False)
        say(f"{setting}: about {total:.2g} s of CPU time")
        return self._run(setting, scene, estimate)

    def _run(self, setting: str, scene: Scene, estimate: float) -> Trial:
        runouts, seconds, reasons = np.full(len(self.ids), np.nan), [], []
        try:
            ground = prepare(scene, self._directory)
            for i, realization in enumerate(self.ids):
                begin = time.process_time()
                runouts[i], reason = self._runout(ground, realization)
                seconds.append(time.process_time() - begin)
                reasons.append(reason)
        except (RefusalError, SamplerError) as refusal:
            reasons.append(str(refusal))
        median = float(np.median(seconds)) if seconds else estimate
        return Trial(setting, scene.numerics.cell, runouts, median, next(filter(None, reasons), ""))

    def _runout(self, ground: Ground, realization: int) -> tuple[float, str]:
        """Return the final run-out in m, or NaN and why there is none."""
        try:
            record = ground.simulate(realization, lambda: time.process_time() > self._end)
        except Interrupted:
            return np.nan, "the budget of CPU time is used up"
        except Exception as error:
            return np.nan, f"crashed ({error!r})"
        if record.status not in UNHINDERED:
            return np.nan, without_debris(record.reason) or WITHOUT_RUNOUT.get(record.status, record.status.name)
        return float(np.asarray(record.values[FINAL_RUNOUT[ground.scene.slide.front]])), ""
