"""Numbers and intervals as text, for verdict, progress, answer and report alike."""

import math

from campaign.record import LOWER_BOUND, RealizationSummary, Record
from campaign.statistics.intervals import Interval
from campaign.statistics.outcomes import Outcomes


def percent(share: float) -> str:
    """Write a share in per cent, with three digits or all before the decimal point."""
    return f"{100 * share:.3g} %" if share < 1 else f"{100 * share:.0f} %"


def chance(probability: float) -> str:
    """Write a probability in per cent, whole where it is neither small nor near 1: "7.1 %", "35 %", "97.6 %"."""
    if 0.1 <= probability <= 0.9:
        return f"{100 * probability:.0f} %"
    return f"{100 * probability:.{2 if probability < 0.1 else 3}g} %"


def least(number: Interval) -> str:
    """Return what to put before an estimate: "at least " where slides that were cut short would make it larger."""
    return "at least " if number.is_least else ""


def is_open(probability: Interval) -> bool:
    """Whether nothing bounds a probability from above, as all were cut short that did not get so far."""
    return probability.is_least and probability.upper >= 1


def estimated_chance(probability: Interval) -> str:
    """Write the estimate of a probability: "35 %", "at least 62 %" where slides that were cut short may add to it.

    "At least nothing" tells nothing, so it is then what may be at most.
    """
    if probability.estimate > 0 or not probability.is_least:
        return f"{least(probability)}{chance(probability.estimate)}"
    return "not known" if is_open(probability) else f"at most {chance(probability.upper)}"


def chances(interval: Interval) -> str:
    """Write the bounds of a probability in per cent, "35 to 55 %"; without an upper one "at least 35 %"."""
    if not interval.is_known:
        return "not enough realizations"
    if is_open(interval) and interval.lower > 0:
        return f"at least {chance(interval.lower)}"
    return f"{chance(interval.lower).removesuffix(' %')} to {chance(interval.upper)}"


def metres(interval: Interval) -> str:
    """Write the bounds of a length in m, "10.61 to 11.02 m"; without an upper one "at least 10.61 m"."""
    if math.isinf(interval.upper):
        return f"at least {interval.lower:.2f} m"
    return f"{interval.lower:.2f} to {interval.upper:.2f} m" if interval.is_known else "not enough slides"


def at_least(run: RealizationSummary | Record) -> str:
    """Return what to put before the run-out of a run: "at least " where that was cut short."""
    return "at least " if run.status in LOWER_BOUND else ""


def so_far(outcomes: Outcomes) -> str:
    """Return what follows a number of the slides' run-outs where more than a few were cut short, "" else."""
    return "" if outcomes.bound_the_mean else ", as far as they came"


def chance_of_slide(probability: Interval) -> str:
    """Say how probable a slide is, to follow "the probability of a slide is": "at most 7.1 %", "35 to 55 %"."""
    if probability.estimate == 0 and not probability.is_least:
        return f"at most {chance(probability.upper)}"
    if probability.estimate == 1:
        return f"at least {chance(probability.lower)}"
    return chances(probability)
