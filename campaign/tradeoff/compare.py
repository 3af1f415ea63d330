"""`campaign tradeoff` from the first setting to the last, whoever computes."""

from campaign.errors import RefusalError
from campaign.running.campaign_directory import CampaignDirectory
from campaign.running.means import Lead
from campaign.running.side_run import Means
from campaign.running.study import Study, leading, together
from campaign.scene import Scene
from campaign.simulation.contract import Prepare
from campaign.tradeoff.settings import finer, settings
from campaign.tradeoff.table import write_tradeoff
from campaign.tradeoff.trials import Tradeoff, Trial, trial_of


def lead(budget: float, prepare: Prepare) -> Lead:
    """Return what compares the settings of a directory's scene within a budget of core time [s]."""

    def study(directory: CampaignDirectory, means: Means) -> str:
        scene = directory.scene
        found = compare(scene, scene.campaign.realizations, budget, means)
        write_tradeoff(found, directory.path)
        return found.advice

    return leading(prepare, study)


def compare(scene: Scene, realizations: int, budget: float, means: Means) -> Tradeoff:
    """Run realizations 0, 1, ... of a scene in each of its settings, and in what is good of them together.

    Parameters
    ----------
    scene
    realizations
        Number of random fields.
    budget
        Core time in s; what would exceed the rest of it is left out; half the cell comes first.
    means
        To compute with.

    Raises
    ------
    RefusalError
        If the scene itself gives too few run-outs to compare with.
    Stopped
        If somebody asked for an end.
    """
    study = Study(scene, realizations, budget, means)

    def tried(*changes: str) -> Trial:
        return trial_of(study.run(*changes), realizations)

    own = tried()
    if not own.is_sound:
        raise RefusalError(
            f"The scene itself gives no run-outs to compare with: {own.remark}. "
            "It takes slides without a failure; give more --realizations, or --budget."
        )
    half = tried(*finer(scene))
    trials = [own, half, *(tried(*changes) for changes in settings(scene))]
    found = Tradeoff(scene, trials, half if half.is_sound else own)
    if good := found.harmless:
        trials += [tried(*together(changes)) for changes in (good, [*good, half.changes]) if len(changes) > 1]
    return Tradeoff(scene, trials, found.reference)
