"""All choices of a scene, each judged by what it changes, and those together that may be dropped."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from campaign.scene import Scene
from campaign.scene.wanted import wanted_accuracy
from campaign.screening.choices import Choice
from campaign.screening.effects import POINTS, Realizations
from campaign.screening.verdict import Effect, Verdict, deciding_number, verdict_of
from campaign.statistics.intervals import Interval, unknown
from campaign.terminal import counted, listing

NOTHING_KNOWN = unknown(math.nan, 0)


@dataclass(frozen=True, eq=False)
class Screened:
    """A choice, and what the scene without it has come to.

    Parameters
    ----------
    choice
        Or several of them at once.
    realizations
        Of the scene without the choice; None if they were not run.
    effects
        What it changes.
    spoiled
        How much more probable a wall of the model or a failure is without the choice.
    why_not
        Why nothing was run, "" if it was.
    """

    choice: Choice
    realizations: Realizations | None = None
    effects: Sequence[Effect] = ()
    spoiled: Interval = NOTHING_KNOWN
    why_not: str = ""

    @property
    def is_spoiled(self) -> bool:
        """Whether the model clearly breaks without the choice, or its walls are clearly more often in the way."""
        return self.spoiled.lower > POINTS

    @cached_property
    def verdict(self) -> Verdict:
        """Without what the model breaks is needed; the rest is judged by its effects."""
        return Verdict.KEEP if self.is_spoiled else verdict_of(self.effects)

    @cached_property
    def needed(self) -> int | None:
        """Number of realizations that would decide, None where none is in sight or the verdict is there."""
        return deciding_number(self.effects) if self.effects and self.verdict is Verdict.OPEN else None

    @property
    def share(self) -> float:
        """The largest of the effects, in tolerances."""
        return max((effect.share for effect in self.effects), default=-1.0)

    @property
    def name(self) -> str:
        """What is modelled, and what would take its place."""
        return self.choice.exchange

    @property
    def remark(self) -> str:
        """The verdict with its reason."""
        return f"{self.verdict}: {self.reason}" if self.reason else str(self.verdict)

    @property
    def reason(self) -> str:
        """What the numbers of the answer do not show of a verdict, "" where they show it."""
        if self.is_spoiled:
            return f"{100 * self.spoiled.estimate:.0f} % more fail or reach a wall"
        if self.verdict is Verdict.DROP and not self.choice.simplifies:
            return "either will do"
        if self.verdict is not Verdict.OPEN or self.why_not:
            return self.why_not
        if self.needed is None:
            return "the effect is about the tolerance"
        return f"{counted(self.needed, 'realization')} would tell"


class Combination(NamedTuple):
    """Several choices, and what the scene without all of them has come to."""

    members: tuple[Choice, ...]
    screened: Screened


@dataclass(frozen=True, eq=False)
class Screening:
    """What the realizations of a scene tell of its choices.

    Parameters
    ----------
    scene
    own
        Its realizations.
    choices
        Each by itself.
    together
        What was tried of those at once that may be dropped.
    """

    scene: Scene
    own: Realizations
    choices: Sequence[Screened]
    together: Sequence[Combination] = ()

    @property
    def metres(self) -> float:
        """Change of mean and standard deviation in m that does not matter."""
        return wanted_accuracy(self.scene, self.own.mean)

    @property
    def ranked(self) -> list[Screened]:
        """The choices, the largest effect first and what was not run last."""
        return sorted(self.choices, key=lambda each: -each.share)

    @property
    def droppable(self) -> list[Screened]:
        """What may be dropped to model less, first what may change most of all numbers together."""
        found = [each for each in self.choices if each.verdict is Verdict.DROP and each.choice.simplifies]
        return sorted(found, key=lambda each: -sum(effect.reach for effect in each.effects))

    @property
    def simplified(self) -> Combination | None:
        """As many as may be dropped at once, as they were run and judged; None if nothing may."""
        alone = [Combination((each.choice,), each) for each in self.droppable[-1:]]
        sound = [each for each in self.together if each.screened.verdict is Verdict.DROP]
        return max(alone + sound, key=lambda each: len(each.members), default=None)

    @property
    def rows(self) -> list[Screened]:
        """The choices as they are ranked, and below them what was tried at once."""
        return [*self.ranked, *(each.screened for each in self.together)]

    def cost(self, each: Screened) -> float:
        """Return the particle-steps without a choice, relative to those of the scene; NaN where nothing was run."""
        return math.nan if each.realizations is None else each.realizations.seconds / self.own.seconds

    @property
    def tolerances(self) -> str:
        """How much does not matter."""
        return f"{self.metres:.2g} m of mean and standard deviation, {100 * POINTS:g} points of a probability"

    @property
    def advice(self) -> str:
        """What to keep and what to drop, in sentences."""
        told = [_sentence(verdict, self.ranked) for verdict in Verdict]
        return " ".join(filter(None, [*told, self.of_all, self._of_pairs, self._of_walls]))

    @property
    def of_all(self) -> str:
        """What becomes of the answer and its cost without all that may be dropped."""
        found = self.simplified
        if found is None:
            return "No simpler scene was found to be within the tolerances."
        mean, left = found.screened.effects[0], 100 * self.cost(found.screened)
        changed = "; ".join(each.exchange for each in found.members)
        return (
            f"The simplified scene ({changed}) changes the mean run-out by {mean.told} m, and a "
            f"realization takes {left:.2g} % of the particle-steps."
        )

    @property
    def _of_pairs(self) -> str:
        redrawn = [each.choice.name for each in self.choices if each.choice.redraws and each.effects]
        several = (
            f" Other random fields, of which pairs tell no more than independent samples: {listing(redrawn)}."
            if redrawn
            else ""
        )
        return f"Each choice is judged by itself, at {100 * self.scene.campaign.confidence:g} % confidence.{several}"

    @property
    def _of_walls(self) -> str:
        share = 100 * float(np.mean(self.own.is_spoiled))
        if not share:
            return ""
        return (
            f"{share:.0f} % of the scene's own realizations fail or reach a wall of the model: what these do is not "
            "compared, or only as the walls let them."
        )


def _sentence(verdict: Verdict, ranked: Sequence[Screened]) -> str:
    names = [each.choice.name for each in ranked if each.verdict is verdict]
    return f"{str(verdict).capitalize()}: {listing(names)}." if names else ""
