"""The verdict: a sentence on whether sampling has converged, and if not, what is missing."""

from campaign.statistics.outcomes import Outcomes
from campaign.statistics.proportions import results_to_bound
from campaign.statistics.stopping import LOOKS_IN_A_ROW, RARE, Checkpoint, StoppingRule
from campaign.statistics.wording import chance_of_slide, percent
from campaign.terminal import counted

CONVERGED = "sampling converged"
"""How the verdict on a campaign that satisfies its rule begins."""


def stopping_verdict(latest: Checkpoint, rule: StoppingRule, converged: bool) -> str:
    """Say in a sentence whether the rule is satisfied, and if not, what is missing."""
    outcomes, count = latest.outcomes, counted(latest.realizations, "realization")
    if converged:
        return f"{CONVERGED} at {count}: {_known(latest, rule)}, at {percent(rule.confidence)} confidence"
    if outcomes.slides == 0 and outcomes.usable:
        return f"not converged after {count}: none slid, {_shortfall_without_slides(latest, rule)}"
    if outcomes.usable < rule.minimum:
        return f"not enough yet: {counted(outcomes.usable, 'result')} in {count}, at least {rule.minimum} were asked"
    return f"not converged after {count}: {_shortfall(latest, rule)}"


def _known(latest: Checkpoint, rule: StoppingRule) -> str:
    outcomes, chance = latest.outcomes, f"the probability of a slide is {chance_of_slide(latest.slide_probability)}"
    if outcomes.slides == 0:
        return f"none slid, {chance}"
    if not latest.knows_runout(rule):
        return f"{outcomes.slides} slid, {chance}, and too few slide for a mean and a variance"
    if rule.nothing_varies:
        return f"{chance}; nothing is random, and all slides are the same"
    mean, variance = percent(latest.mean.precision), percent(latest.variance.precision)
    return f"{chance}, the mean run-out{_so_far(outcomes)} is known to {mean}, its variance to {variance}"


def _so_far(outcomes: Outcomes) -> str:
    """Say that a number is of run-outs that would have been longer, of more than a few; "" else."""
    return "" if outcomes.bound_the_mean else f", as far as slides came ({outcomes.cut_short:,} were cut short),"


def _shortfall_without_slides(latest: Checkpoint, rule: StoppingRule) -> str:
    """Name what is missing for the answer that a slope is stable; mean and variance are not asked of it."""
    known = f"so the probability of a slide is {chance_of_slide(latest.slide_probability)}"
    bound = min(RARE, 2.0 * rule.slide_probability_tolerance)
    needed = results_to_bound(bound, rule.confidence)
    if latest.outcomes.usable < needed:
        return f"{known}; {needed:,} without a slide bound it by {percent(bound)}, which is asked for"
    return f"{known}, as asked for; whether that is enough is decided every {counted(rule.block, 'realization')}"


def _shortfall(latest: Checkpoint, rule: StoppingRule) -> str:
    """Name what is not known well enough."""
    missed = []
    if not latest.knows_slide_probability(rule):
        known, asked = latest.slide_probability.half_width, rule.slide_probability_tolerance
        missed.append(f"the probability of a slide is known to ±{percent(known)}, ±{percent(asked)} was asked")
    if not latest.slides_are_rare:
        missed += _shortfall_of_runout(latest, rule)
    return "; ".join(missed) or f"all tolerances are met, but not yet at {LOOKS_IN_A_ROW} checkpoints in a row"


def _shortfall_of_runout(latest: Checkpoint, rule: StoppingRule) -> list[str]:
    slides = latest.outcomes.slides
    if slides < rule.minimum:
        return [f"{counted(slides, 'slide')}, at least {rule.minimum} were asked for mean and variance"]
    if not latest.variance.is_known:
        return [f"the {slides} slides give no interval for the variance"]
    asked = {
        "mean": (latest.mean.precision, rule.mean_tolerance),
        "variance": (latest.variance.precision, rule.variance_tolerance),
    }
    came = _so_far(latest.outcomes)
    return [
        f"the {name}{came} is known to {percent(precision)}, {percent(tolerance)} was asked"
        for name, (precision, tolerance) in asked.items()
        if precision > tolerance
    ]
