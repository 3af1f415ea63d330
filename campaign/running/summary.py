"""The last words of a campaign: the answer, how sure it is, and on what it rests."""

import numpy as np

from campaign.discretisation import Discretisation
from campaign.doubts import detached_fronts, doubts
from campaign.record import FAILED, Status
from campaign.running.progress import mean_text, std_text
from campaign.running.tally import Tally
from campaign.scene import Scene
from campaign.seeds import BASELINE
from campaign.statistics import failure_bounds, mean_interval, proportion_interval, std_interval

NOT_ESTIMATED = "not estimated by this campaign: give campaign.discretisation_pairs, or repeat it with half the cell"


def summary(scene: Scene, tally: Tally, verdict: str, discretisation: Discretisation | None) -> str:
    """Return the campaign's result and its error budget as text."""
    budget = _error_budget(scene, tally, discretisation)
    return "\n".join(["", f"{scene.title}: {verdict}", *_outcomes(tally), *_answer(scene, tally), *budget])


def _outcomes(tally: Tally) -> list[str]:
    counts = ", ".join(f"{count} {status.name}" for status, count in tally.by_status().items() if count)
    lines = [f"  outcomes       {counts or 'none'}"]
    if unsettled := tally.by_status()[Status.not_settled]:
        lines.append(f"  note           {unsettled} were still moving at end_time; their run-out is a lower bound.")
    if BASELINE in tally.outcomes and tally.outcomes[BASELINE].status in FAILED:
        lines.append("  note           The deterministic run failed; there is nothing to compare with.")
    return lines


def _answer(scene: Scene, tally: Tally) -> list[str]:
    runouts = tally.runouts()
    usable = runouts[~np.isnan(runouts)]
    if len(usable) == 0:
        return ["  run-out        no realization slid"]
    span = f"smallest {usable.min():.2f} m, largest {usable.max():.2f} m"
    lines = [f"  run-out        mean {np.mean(usable):.2f} m; {span}"]
    if np.isfinite(tally.threshold):
        lines.append(f"  deterministic  {tally.threshold:.2f} m; {_exceedance(usable, tally)}")
    reasons = [*doubts(runouts), *detached_fronts(tally.detached_volumes(), scene.slide.front_area)]
    return lines + [f"  doubt          {doubt}" for doubt in reasons]


def _exceedance(usable: np.ndarray[tuple[int], np.dtype[np.float64]], tally: Tally) -> str:
    exceeding = int(np.count_nonzero(usable > tally.threshold))
    share = proportion_interval(exceeding, len(usable), tally.rule.confidence)
    text = f"exceeded by {100 * share.estimate:.0f} % ({100 * share.lower:.0f} to {100 * share.upper:.0f} %)"
    if failed := tally.failed_in_prefix:
        lowest, highest = failure_bounds(exceeding, len(usable), failed)
        text += f"; between {100 * lowest:.0f} and {100 * highest:.0f} % whatever the {failed} failed would have done"
    return text


def _error_budget(scene: Scene, tally: Tally, discretisation: Discretisation | None) -> list[str]:
    return [
        f"Error budget at {100 * tally.rule.confidence:g} % confidence",
        f"  sampling       {_sampling(tally)}",
        f"  discretisation {discretisation or NOT_ESTIMATED}",
        f"  modelling      {_choices(scene)}",
    ]


def _sampling(tally: Tally) -> str:
    runouts = tally.runouts()
    usable = runouts[~np.isnan(runouts)]
    if len(usable) < 2:
        return "not enough yet"
    confidence = tally.rule.confidence
    mean, std = mean_interval(usable, confidence), std_interval(usable, confidence)
    return f"mean {mean_text(mean)}, std {std_text(std)}, from {len(usable)} usable run-outs"


def _choices(scene: Scene) -> str:
    softening, numerics = scene.soil.softening, scene.numerics
    rate = "no softening"
    if softening.law != "none":
        scale = f"at a cell of {softening.reference_cell} m"
        if softening.internal_length is not None:
            scale = f"over {softening.internal_length} m"
        rate = f"{softening.law} softening, rate {softening.rate} {scale}"
    gravity, locking = f"gravity {numerics.gravity}", f"locking treatment {numerics.locking}"
    return f"{gravity}; {rate}; {locking}; {scene.field.correlation} correlation"
