"""`campaign screen` from the first choice to the last, whoever computes."""

from collections.abc import Callable, Sequence
from pathlib import Path

from campaign.errors import RefusalError
from campaign.running.campaign_directory import CampaignDirectory
from campaign.running.means import Lead
from campaign.running.side_run import Means
from campaign.running.study import Outcome, Study, leading, together
from campaign.scene import Scene
from campaign.screening.choices import Choice, choices_of
from campaign.screening.effects import Realizations, effects_of, realizations_of, spoiled
from campaign.screening.screening import Combination, Screened, Screening
from campaign.screening.simplified import refuse_to_overwrite, write_simplified
from campaign.screening.table import write_screening
from campaign.screening.verdict import Verdict
from campaign.simulation.contract import Prepare
from campaign.statistics.paired import FEWEST_PAIRS


def lead(budget: float, prepare: Prepare, simplified: Path | None = None) -> Lead:
    """Return what screens a directory's scene within a budget of core time [s], and writes a simplified scene."""

    def study(directory: CampaignDirectory, means: Means) -> str:
        if simplified is not None:
            refuse_to_overwrite(simplified)
        found = screen(directory.scene, directory.scene.campaign.realizations, budget, means)
        write_screening(found, directory.path)
        if simplified is not None:
            write_simplified(found, simplified)
        return found.advice

    return leading(prepare, study)


def screen(scene: Scene, realizations: int, budget: float, means: Means) -> Screening:
    """Run realizations 0, 1, ... of a scene, without each of its choices, and without all that it can do without.

    Parameters
    ----------
    scene
    realizations
        Number of random fields.
    budget
        Core time in s; what would exceed the rest of it is left out.
    means
        To compute with.

    Raises
    ------
    RefusalError
        If the scene itself gives nothing to compare with.
    Stopped
        If somebody asked for an end.
    """
    study = Study(scene, realizations, budget, means)
    outcome = study.run()
    if outcome.tally is None:
        raise RefusalError(f"The scene itself was not run: {outcome.why_not}. Give more --budget, or --realizations.")
    own = realizations_of(outcome, outcome.tally, means.home, realizations)
    if (usable := int(own.counts.sum())) < FEWEST_PAIRS:
        raise RefusalError(
            f"The scene itself gives nothing to compare with: {usable} of {realizations} realizations have a result. "
            "Give more --realizations."
        )

    def tried(choice: Choice) -> Screened:
        if choice.why_not:
            return Screened(choice, why_not=choice.why_not)
        return _screened(choice, study.run(*choice.changes), own, means.home)

    alone = Screening(scene, own, [tried(choice) for choice in choices_of(scene)])
    return Screening(scene, own, alone.choices, _at_once(alone.droppable, tried) if len(alone.droppable) > 1 else [])


def _screened(choice: Choice, outcome: Outcome, own: Realizations, home: Path) -> Screened:
    if outcome.tally is None:
        return Screened(choice, why_not=outcome.why_not.partition(";")[0])
    there, confidence = (
        realizations_of(outcome, outcome.tally, home, len(own.runouts)),
        outcome.scene.campaign.confidence,
    )
    return Screened(choice, there, effects_of(outcome.scene, own, there), spoiled(own, there, confidence))


def _at_once(droppable: Sequence[Screened], tried: Callable[[Choice], Screened]) -> list[Combination]:
    """Try all at once, and where that is too much one after the other, from the one that may change least."""

    def combined(name: str, members: Sequence[Choice]) -> Combination:
        changes, redraws = together([each.changes for each in members]), any(each.redraws for each in members)
        return Combination(tuple(members), tried(Choice(name, "", changes, redraws)))

    *rest, first = [each.choice for each in droppable]
    attempts = [combined("all that may drop", [*rest, first])]
    if attempts[0].screened.verdict is Verdict.DROP or len(rest) == 1:
        return attempts
    taken = [first]
    for choice in reversed(rest):
        attempts.append(
            combined(f"{taken[0].name if len(taken) == 1 else 'these'} and {choice.name}", [*taken, choice])
        )
        if attempts[-1].screened.verdict is Verdict.DROP:
            taken.append(choice)
    return attempts
