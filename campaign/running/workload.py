"""How long what follows the sampling will take: half the cell, the other release, and one input changed."""

from math import ceil

from campaign.record import UNHINDERED
from campaign.scene import Scene
from campaign.scene.cost import HALF_CELL_COST
from campaign.scene.inputs import inputs_of
from campaign.seeds import BASELINE
from campaign.statistics.changed_inputs import first_slides
from campaign.statistics.tally import Tally


def seconds_beyond_sampling(scene: Scene, ranks: int, tally: Tally, rate: float) -> float:
    """Return the time in s that the runs of `campaign.running.beyond_sampling` will take.

    They are made one kind after the other, so that with more ranks than runs of a kind some ranks wait. What does not
    slide is not repeated.

    Parameters
    ----------
    scene, tally
        Of the campaign.
    ranks
        Number of ranks.
    rate
        Realizations a second, of all ranks together.
    """
    pairs = scene.campaign.discretisation_pairs
    fine = len(first_slides(tally, pairs)) + _may_slide(tally, BASELINE) if pairs else 0
    release = min(1, pairs)
    changed = len(first_slides(tally, scene.campaign.sensitivity_pairs))
    rounds = HALF_CELL_COST * ceil(fine / ranks) + release + len(inputs_of(scene)) * ceil(changed / ranks)
    return rounds * ranks / rate


def _may_slide(tally: Tally, realization: int) -> bool:
    """Whether a realization has slid unhindered, or may still."""
    known = tally.summaries.get(realization)
    return known is None or known.status in UNHINDERED
