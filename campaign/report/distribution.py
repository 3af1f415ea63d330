"""Numbers of many realizations as lines of a table: median and 95 % quantile, each with its interval."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.report.wording import bounds, number
from campaign.statistics.intervals import Sample, quantile_interval
from campaign.statistics.receptors import QUANTILES
from campaign.statistics.wording import least


class Distribution(NamedTuple):
    """A line of a table: a quantity with its median and its 95 % quantile, each with an interval; a remark or ""."""

    name: str
    median: str
    median_interval: str
    far: str
    far_interval: str
    remark: str = ""


def distribution(
    name: str, values: Sample, unit: str, confidence: float, is_least: NDArray[np.bool_] | None = None
) -> Distribution:
    """Return median and 95 % quantile of the finite ones of some values, of which `is_least` marks lower bounds."""
    known = np.isfinite(values)
    finite, cut = values[known], np.zeros(np.count_nonzero(known), dtype=bool) if is_least is None else is_least[known]
    columns: list[str] = []
    for share in QUANTILES:
        interval = quantile_interval(finite, share, confidence, cut)
        columns += [f"{least(interval)}{number(interval.estimate, unit)}", bounds(interval, unit)]
    return Distribution(name, *columns)
