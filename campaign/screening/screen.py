"""`campaign screen` from the first choice to the last, whoever computes."""

from collections.abc import Callable
from pathlib import Path

from campaign.errors import RefusalError
from campaign.running.campaign_directory import CampaignDirectory
from campaign.running.means import Lead
from campaign.running.side_run import Means
from campaign.running.study import Outcome, Study, leading, together
from campaign.scene import Scene
from campaign.screening.choices import Choice, choices_of
from campaign.screening.effects import Realizations, effects_of, realizations_of, spoiled
from campaign.screening.screening import Screened, Screening
from campaign.screening.simplified import refuse_to_overwrite, write_simplified
from campaign.screening.table import write_screening
from campaign.screening.verdict import Verdict
from campaign.simulation.contract import Prepare
from campaign.statistics.paired import FEWEST_PAIRS
from campaign.terminal import listing


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
        core time in s; what would exceed the rest of it is left out.
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
    return Screening(scene, own, alone.choices, _at_once(alone.droppable, tried))


def _screened(choice: Choice, outcome: Outcome, own: Realizations, home: Path) -> Screened:
    if outcome.tally is None:
        return Screened(choice, why_not=outcome.why_not.partition(";")[0])
    there, confidence = (
        realizations_of(outcome, outcome.tally, home, len(own.runouts)),
        outcome.scene.campaign.confidence,
    )
    return Screened(choice, there, effects_of(outcome.scene, own, there), spoiled(own, there, confidence))


def _at_once(droppable: list[Screened], tried: Callable[[Choice], Screened]) -> list[Screened]:
    """Try all at once; while that is too much, without the one that may change most."""
    attempts: list[Screened] = []
    for first in range(len(droppable) - 1):
        left, taken = [each.choice for each in droppable[:first]], [each.choice for each in droppable[first:]]
        name = f"all that may drop{f' but {listing([each.name for each in left])}' if left else ''}"
        changes = together([each.changes for each in taken])
        attempts.append(tried(Choice(name, "at once", changes, any(each.redraws for each in taken))))
        if attempts[-1].verdict is Verdict.DROP or attempts[-1].why_not:
            break
    return attempts
