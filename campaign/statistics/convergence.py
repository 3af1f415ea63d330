"""The convergence history: what the first realizations say at every checkpoint of the stopping rule."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from campaign.statistics.forecast import predicted_stop
from campaign.statistics.intervals import Interval, Sample
from campaign.statistics.outcomes import Outcomes
from campaign.statistics.stopping import Checkpoint, StoppingRule, is_converged, is_regular
from campaign.statistics.verdict import stopping_verdict


@dataclass(frozen=True)
class ConvergenceHistory:
    """Estimates at every checkpoint, up to the one where the rule was satisfied, and the verdict.

    Attributes
    ----------
    realizations, n, n_slides : int arrays (checkpoint,)
        Realizations looked at, those of them with a result, and those that slid.
    slide_probability, exceedance, exceedance_given_sliding : arrays (checkpoint,)
        Probability of a slide, of a run-out above the threshold, and of that where the slope slides.
    mean, variance : arrays (checkpoint,)
        Of the run-out of the slides [m], [m2].
    slide_probability_ci, exceedance_ci, exceedance_given_sliding_ci, mean_ci, variance_ci : arrays (checkpoint, 2)
        Lower and upper bounds. NaN: not enough yet.
    predicted_n : array (checkpoint,)
        Realizations at which the rule would stop if the estimates stayed as they are.
    mean_is_bounded : bool
        Whether so few of the slides were cut short that the last mean has an upper bound.
    converged_at : int or None
        The number of realizations the rule asked for; realizations from this id on are not part of the result.
    verdict : str
        A sentence.
    """

    realizations: NDArray[np.int64]
    n: NDArray[np.int64]
    n_slides: NDArray[np.int64]
    slide_probability: Sample
    slide_probability_ci: Sample
    exceedance: Sample
    exceedance_ci: Sample
    exceedance_given_sliding: Sample
    exceedance_given_sliding_ci: Sample
    mean: Sample
    mean_ci: Sample
    variance: Sample
    variance_ci: Sample
    predicted_n: Sample
    mean_is_bounded: bool
    converged_at: int | None
    verdict: str


def convergence_history(prefixes: Iterable[Outcomes], rule: StoppingRule, threshold: float) -> ConvergenceHistory:
    """Apply the stopping rule to a campaign from its beginning.

    Parameters
    ----------
    prefixes
        What became of the first realization, the first two, ...; at least one.
    rule : StoppingRule
    threshold : float
        Run-out whose exceedance is estimated [m]; NaN if there is none.

    Returns
    -------
    ConvergenceHistory
        At least one row. Where the last realization is not at a checkpoint it has a row of its own, which reports but
        never satisfies the rule: it would make the verdict depend on when one looked.
    """
    looks: list[Checkpoint] = []
    for outcomes in prefixes:
        latest = Checkpoint(outcomes, rule.confidence, threshold)
        if is_look(latest, rule):
            looks.append(latest)
            if is_converged(looks, rule):
                break
    return history_of(looks, latest, rule)


def is_look(latest: Checkpoint, rule: StoppingRule) -> bool:
    """Whether the history has a row for these realizations however many have finished."""
    return is_regular(latest.realizations, rule) or latest.shows_stability(rule)


def history_of(looks: list[Checkpoint], latest: Checkpoint, rule: StoppingRule) -> ConvergenceHistory:
    """Turn looks, and the latest state if it is none of them, into arrays over checkpoints."""
    rows = looks if looks and looks[-1].realizations == latest.realizations else [*looks, latest]
    converged = is_converged(looks, rule)
    slide_probability, slide_probability_ci = _columns(each.slide_probability for each in rows)
    exceedance, exceedance_ci = _columns(each.exceedance for each in rows)
    given_sliding, given_sliding_ci = _columns(each.exceedance_given_sliding for each in rows)
    mean, mean_ci = _columns(each.mean for each in rows)
    variance, variance_ci = _columns(each.variance for each in rows)
    return ConvergenceHistory(
        realizations=np.array([each.realizations for each in rows]),
        n=np.array([each.outcomes.usable for each in rows]),
        n_slides=np.array([each.outcomes.slides for each in rows]),
        slide_probability=slide_probability,
        slide_probability_ci=slide_probability_ci,
        exceedance=exceedance,
        exceedance_ci=exceedance_ci,
        exceedance_given_sliding=given_sliding,
        exceedance_given_sliding_ci=given_sliding_ci,
        mean=mean,
        mean_ci=mean_ci,
        variance=variance,
        variance_ci=variance_ci,
        predicted_n=np.array([predicted_stop(each, rule) for each in rows]),
        mean_is_bounded=rows[-1].outcomes.bound_the_mean,
        converged_at=rows[-1].realizations if converged else None,
        verdict=stopping_verdict(rows[-1], rule, converged),
    )


def _columns(intervals: Iterable[Interval]) -> tuple[Sample, Sample]:
    """Return estimates (checkpoint,) and bounds (checkpoint, 2)."""
    rows = list(intervals)
    return np.array([each.estimate for each in rows]), np.array([(each.lower, each.upper) for each in rows])
