"""Made-up accounts of campaigns."""

import numpy as np

from campaign.record import RealizationSummary, Status
from campaign.statistics.convergence import StoppingRule
from campaign.statistics.tally import Tally

RULE = StoppingRule(mean_tolerance=0.05, variance_tolerance=0.5, confidence=0.95, minimum=20, block=10)
RUNOUTS = np.random.default_rng(1).normal(10, 0.5, 200)


def summary(realization, status=Status.slid):
    """Return the summary of a realization."""
    return RealizationSummary(realization, status, RUNOUTS[realization], 1.0)


def filled(order, maximum=200, failing=()):
    """Return a tally of realizations in this order of arrival."""
    tally = Tally(maximum, RULE, max_failed_fraction=0.1)
    for k in order:
        tally.add(summary(k, Status.crashed if k in failing else Status.slid))
    return tally
