"""Made-up accounts of campaigns."""

import numpy as np

from campaign.record import RealizationSummary, Status
from campaign.statistics.outcomes import outcomes_of
from campaign.statistics.stopping import StoppingRule
from campaign.statistics.tally import Tally

RULE = StoppingRule(
    mean_tolerance=0.05, variance_tolerance=0.5, confidence=0.95, minimum=20, block=10, slide_probability_tolerance=0.1
)
RUNOUTS = np.random.default_rng(1).normal(10, 0.5, 200)


def summary(realization, status=Status.slid):
    """Return the summary of a realization."""
    return summary_of(realization, RUNOUTS[realization], status)


def summary_of(realization, runout, status=Status.slid, wall_time=1.0):
    """Return the summary of a realization whose front, however measured, came so far."""
    return RealizationSummary(realization, status, runout, runout, wall_time)


def prefixes_of(summaries, front="mass"):
    """Return what became of the first, the first two, ..., each counted from the beginning."""
    return [outcomes_of(summaries[:count], front) for count in range(1, len(summaries) + 1)]


def filled(order, maximum=200, failing=()):
    """Return a tally of realizations in this order of arrival."""
    tally = Tally(maximum, RULE, max_failed_fraction=0.1, front="mass")
    for k in order:
        tally.add(summary(k, Status.crashed if k in failing else Status.slid))
    return tally
