"""How many realizations each model should run: the least cost at which the mean is known well enough."""

import math
from collections.abc import Sequence
from itertools import accumulate

HALVINGS = 40
"""Of the interval in which the common factor of the numbers lies, to a millionth of a millionth."""


def allocation(
    scatter: Sequence[float], cost: Sequence[float], variance: float, least: Sequence[int]
) -> tuple[int, ...]:
    """Return how many realizations each of some nested models should run.

    The variance of the mean is the sum of V_m / n_m, its cost that of c_m n_m. Least cost at a given variance makes n_m
    proportional to sqrt(V_m / c_m) (Giles 2015, equation 1.9); models that have run more than that count with what they
    have run, and no model runs more than a cheaper one.

    Parameters
    ----------
    scatter : V_m >= 0
        As `NestedMean` tells them, of the asked-for model first.
    cost : c_m > 0
        Of a realization.
    variance : float
        Wanted of the mean, above 0.
    least : int
        Realizations run already, which never decrease from one model to the next.
    """

    def numbers(factor: float) -> tuple[int, ...]:
        wanted = (
            max(done, math.ceil(factor * math.sqrt(v / c))) for v, c, done in zip(scatter, cost, least, strict=True)
        )
        return tuple(accumulate(wanted, max))

    def suffices(factor: float) -> bool:
        return math.fsum(v / n for v, n in zip(scatter, numbers(factor), strict=True)) <= variance

    lower, upper = 0.0, 1.0
    while not suffices(upper):
        upper *= 2
    for _ in range(HALVINGS):
        middle = (lower + upper) / 2
        lower, upper = (lower, middle) if suffices(middle) else (middle, upper)
    return numbers(upper)
