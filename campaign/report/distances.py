"""The probability of a run-out beyond any distance, as a curve that figures, tables and the page's script read."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.report import estimates
from campaign.results.results import Results
from campaign.simulation.solver_model import Array
from campaign.statistics.intervals import Interval
from campaign.statistics.wording import chances, estimated_chance

ROWS = 8
"""About so many distances in the table."""


class Curve(NamedTuple):
    """Probabilities of a longer run-out: each holds from its distance to the next one; every array is (k,).

    Attributes
    ----------
    distance : ndarray
        In m from the toe; 0 and the run-outs of the slides.
    estimate, lower, upper : ndarray
        With its interval.
    is_least : bool ndarray
        Whether slides that were cut short may add to the estimate.
    n : int
        Realizations behind them.
    """

    distance: Array
    estimate: Array
    lower: Array
    upper: Array
    is_least: NDArray[np.bool_]
    n: int

    def at(self, distance: float) -> Interval:
        """Return the probability of a run-out beyond a distance (m)."""
        k = max(0, int(np.searchsorted(self.distance, distance, side="right")) - 1)
        return Interval(
            float(self.estimate[k]), float(self.lower[k]), float(self.upper[k]), self.n, bool(self.is_least[k])
        )

    def words(self, distance: float) -> str:
        """Return the probability of a run-out beyond a distance (m) with its interval."""
        share = self.at(distance)
        return f"{estimated_chance(share)} ({chances(share)})"


class Curves(NamedTuple):
    """The curve of all realizations, and that of the slides alone; thousands of intervals, so it is made once."""

    all: Curve
    given_sliding: Curve


class Row(NamedTuple):
    """A line of the table of distances; the last two are the probabilities in words."""

    distance: str
    beyond: str
    given_sliding: str


def curves_of(results: Results) -> Curves:
    """Return both curves of a campaign."""
    return Curves(exceedance_curve(results), exceedance_curve(results, given_sliding=True))


def exceedance_curve(results: Results, given_sliding: bool = False) -> Curve:
    """Return the curve of all realizations, where no slide is a run-out of zero, or of the slides alone."""
    probability = estimates.exceedance_given_sliding if given_sliding else estimates.exceedance
    distances = np.concatenate([[0.0], np.unique(results.slide_runouts)])
    shares = [probability(results, distance) for distance in distances]
    estimate, lower, upper = np.array([share[:3] for share in shares]).T
    return Curve(distances, estimate, lower, upper, np.array([share.is_least for share in shares]), shares[0].n)


def table(curves: Curves) -> list[Row]:
    """Return the probabilities of a run-out beyond round distances; without a slide there is none."""
    curve, given = curves
    if given.n == 0:
        return []
    return [Row(f"{distance:g} m", curve.words(distance), given.words(distance)) for distance in _round(curve)]


def data(curves: Curves) -> dict[str, list[float] | list[str]]:
    """Return both curves for the page's script: probabilities in the words of the table."""
    shares = {"all": curves.all, "sliding": curves.given_sliding}
    words = {name: [curve.words(distance) for distance in curve.distance] for name, curve in shares.items()}
    return {"distance": np.round(curves.all.distance, 3).tolist()} | words


def round_step(least: float) -> float:
    """Return the least of 1, 2 and 5 times a power of ten that is not below a length."""
    power = 10.0 ** np.floor(np.log10(least))
    return float(power * next(each for each in (1, 2, 5, 10) if each * power >= least * (1 - 1e-9)))


def _round(curve: Curve) -> Array:
    """Return round distances (m) from before the shortest run-out to beyond the longest."""
    low, high = curve.distance[min(1, curve.distance.size - 1)], curve.distance[-1]
    step = round_step(max(high - low, 0.1 * high, 1e-3) / (ROWS - 2))
    first, last = np.floor(low / step), np.ceil(high / step)
    return np.asarray(np.round(step * np.arange(first, last + 1), 9))
