"""Reasons not to trust the run-outs or their intervals.

Ground that has come apart from the slide is not its front, and a few runaway realizations can carry the variance.
Before the first of them has appeared no formula can know: with 3 % of runaways, 95 % intervals of the variance from 30
realizations hold in 60 % of the campaigns.
"""

import numpy as np

from campaign.record import Front
from campaign.statistics.intervals import Sample, kurtosis
from campaign.terminal import counted, rounded_up

# A normal sample of 1000 has kurtosis 3.0 +- 0.15, and its largest value makes 1 % of the variance.
HEAVY_KURTOSIS = 10.0
HEAVY_SHARE = 0.2

# In a sample of 10 even a harmless value makes 20 % of the variance: it must also exceed so many fair shares 1/n.
HEAVY_FACTOR = 20


def doubts(values: Sample) -> list[str]:
    """Collect the reasons to doubt the mean and the variance, as sentences; empty if there is none.

    Parameters
    ----------
    values : array (realization,)
        Final run-out of realization 0, 1, 2, ... [m], NaN where it is not usable.
    """
    runouts = values[np.isfinite(values)]
    if len(runouts) < 2:
        return []
    if np.ptp(runouts) == 0:
        return [f"All {len(runouts)} run-outs are equal: what is random, if anything is, does not reach the run-out."]
    return heavy_tail(runouts) + heavy_realization(values)


def heavy_tail(runouts: Sample) -> list[str]:
    """Doubt a variance whose own uncertainty is decided by a few extreme values."""
    tail = kurtosis(runouts)
    if not tail > HEAVY_KURTOSIS:
        return []
    return [
        f"A few extreme slides decide how far run-outs scatter (their kurtosis is {tail:.0f}, normal is 3), so that "
        "the interval of the scatter may be too narrow. Look at the longest run-outs and compute more realizations."
    ]


def heavy_realization(values: Sample) -> list[str]:
    """Doubt a variance that rests on one realization."""
    squares = (values - np.nanmean(values)) ** 2
    largest = int(np.nanargmax(squares))
    share = squares[largest] / np.nansum(squares)
    if share <= max(HEAVY_SHARE, HEAVY_FACTOR / np.count_nonzero(np.isfinite(values))):
        return []
    return [
        f"Realization {largest} alone, with a run-out of {values[largest]:.4g} m, makes {100 * share:.0f} % of the "
        "variance. Replay it before the variance is used."
    ]


def detached_fronts(volumes: Sample, mass_runouts: Sample, front_area: float, front: Front) -> list[str]:
    """Doubt run-outs that single pieces decide, ahead of the slide and no longer joined to it.

    Parameters
    ----------
    volumes, mass_runouts : array (n,)
        What has come apart in the slides [m3/m], and their `final_runout_mass` [m].
    front_area : float
        What `final_runout_mass` leaves ahead of it [m2]; from that much debris on it is measured in debris, too.
    front : "mass" or "tip"
        Whose run-out statistics are of.
    """
    apart, beyond = (int(np.count_nonzero(which)) for which in (volumes > 0.0, volumes >= front_area))
    if front == "tip" and apart:
        return [
            f"In {apart:,} of {counted(len(volumes), 'slide')} the front-most ground has come apart, too far for it to "
            'be held back: the run-out is that of this debris. Use slide.front = "mass" '
            f"({mass_runouts.mean():.2f} m on average){_too_much(volumes, beyond)}."
        ]
    if beyond:
        return [
            f"In {beyond:,} of {counted(len(volumes), 'slide')} more ground than slide.front_area has come apart: the "
            f"run-out is that of this debris. Use {_larger(volumes)}."
        ]
    return []


def _larger(volumes: Sample) -> str:
    """Name an area that no slide has in debris alone."""
    return (
        f'slide.front_area = "{rounded_up(1.01 * float(volumes.max()))} m^2", more than has come apart in any of them'
    )


def _too_much(volumes: Sample, slides: int) -> str:
    return f" and {_larger(volumes)}: in {slides} there is more debris than the front leaves ahead" if slides else ""
