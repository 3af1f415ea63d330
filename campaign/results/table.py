"""All realizations below each other: from the blocks in which records are kept to one array for each quantity."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.record import FAILED, Quantity, fill_of
from campaign.results.walls import REACHED_BEHIND, told_apart
from campaign.storage.columns import Columns


class Total(NamedTuple):
    """The sum of a quantity over the realizations without failure that hold it, and their number."""

    sum: NDArray[np.float64]
    n: int


class Table(NamedTuple):
    """The records of realizations 0, 1, 2, ...

    Attributes
    ----------
    statuses, reasons : arrays (realization,)
    values : dict
        By the name of the quantity, an array (realization, ...); NaN, or 0 for integers, where a record lacks it.
    totals : dict
        By the name of the quantity, of those that enter the dataset as an average.
    """

    statuses: NDArray[np.int8]
    reasons: NDArray[np.object_]
    values: dict[str, NDArray[Any]]
    totals: dict[str, Total]

    @property
    def n(self) -> int:
        """Number of realizations."""
        return len(self.statuses)


def gather(
    blocks: Iterable[Columns], count: int, quantities: Mapping[str, Quantity], sizes: Mapping[str, int]
) -> Table:
    """Put the records of realizations 0 to `count` - 1 below each other; `sizes` maps dimension to length.

    A quantity that is not asked for stays in the record.

    Raises
    ------
    ValueError
        When the blocks do not hold each of the realizations once.
    """
    table = _empty(count, quantities, sizes)
    seen = np.zeros(count, dtype=np.int64)
    for block in blocks:
        rows = block.realizations
        seen[rows] += 1
        table.statuses[rows], table.reasons[rows] = block.statuses, block.reasons
        for name in table.values.keys() & block.values.keys():
            table.values[name][rows] = block.values[name]
        if REACHED_BEHIND in table.values.keys() - block.values.keys():
            settled = block.values.get("settle_time", np.full(len(block), np.nan))
            table.statuses[rows], table.values[REACHED_BEHIND][rows] = told_apart(
                block.statuses, block.reasons, settled
            )
        for name in table.totals.keys() & block.values.keys():
            table.totals[name] = _with(table.totals[name], block, name)
    if (seen != 1).any():
        raise ValueError(f"Of realization {np.argmax(seen != 1)} there are {seen[seen != 1][0]} records, not one.")
    return table


def _empty(count: int, quantities: Mapping[str, Quantity], sizes: Mapping[str, int]) -> Table:
    shapes = {name: [sizes[dim] for dim in quantity.dims] for name, quantity in quantities.items()}
    values = {
        name: np.full([count, *shapes[name]], fill_of(quantity.dtype), quantity.dtype)
        for name, quantity in quantities.items()
        if quantity.average is None
    }
    totals = {name: Total(np.zeros(shapes[name]), 0) for name in shapes.keys() - values.keys()}
    return Table(np.zeros(count, dtype=np.int8), np.full(count, "", dtype=object), values, totals)


def _with(total: Total, block: Columns, name: str) -> Total:
    finished = block.values[name][~np.isin(block.statuses, list(FAILED))]
    return Total(total.sum + finished.sum(axis=0, dtype=np.float64), total.n + len(finished))
