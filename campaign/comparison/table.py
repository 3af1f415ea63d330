"""A comparison as text for the terminal."""

import math
from collections.abc import Sequence
from textwrap import fill

from campaign.comparison.measures import Measure
from campaign.comparison.scenarios import Comparison
from campaign.statistics.paired import Difference
from campaign.terminal import counted

WIDTH = 110

UNITS = {"1": (100.0, "%", ".3g"), "m": (1.0, "m", ".2f"), "m3/m": (1.0, "m3/m", ".1f")}
"""By the unit of a measure: its factor, unit and format on the terminal."""


def as_text(given: Comparison, found: Sequence[Measure], doubts: Sequence[str]) -> str:
    """Return what is compared, a table for each scenario, and what has to be known of it."""
    tables = [line for other in range(1, len(given.names)) for line in _table(given, found, other)]
    return "\n".join([*tables, *(fill(f"Note: {sentence}", WIDTH) for sentence in doubts)])


def _table(given: Comparison, found: Sequence[Measure], other: int) -> list[str]:
    name, first = given.names[other], given.names[0]
    changes = given.changes(other)
    told = [f"  {each.key} is {each.other} instead of {each.first}" for each in changes]
    titles = ("", first, name, "difference", f"{100 * given.confidence:g} % interval", "paired", "unpaired")
    rows = [titles, *(_row(measure, measure.differences[other - 1], len(given.ids)) for measure in found)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(titles))]
    over = "standard error".rjust(sum(widths) + 2 * (len(widths) - 1))
    return [
        f"{name} against {first}, {counted(len(given.ids), 'realization')} of both",
        *(told or ["  The scenes do not differ."]),
        over,
        *(_line(row, widths) for row in rows),
        "",
    ]


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    name, *numbers = row
    cells = [name.ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(numbers, widths[1:], strict=True))]
    return "  ".join(cells).rstrip()


def _row(measure: Measure, found: Difference, pairs: int) -> tuple[str, ...]:
    factor, unit, digits = UNITS[measure.unit]
    points = "points" if measure.unit == "1" else unit

    def number(value: float, sign: str = "") -> str:
        return f"{factor * value:{sign}{digits}}"

    estimate, lower, upper, n, _ = found.interval
    is_least = found.first_is_least, found.other_is_least
    errors = (number(each) if each == each else "" for each in (found.paired_error, found.unpaired_error))
    estimates = (
        _as_bound(f"{number(each)} {unit}", each, least) if each == each else "none"
        for each, least in zip((found.first, found.other), is_least, strict=True)
    )
    bounds = {
        (False, False): f"{number(lower, '+')} to {number(upper, '+')}" if found.interval.is_known else "too few",
        (False, True): f"at least {number(lower, '+')}" if lower == lower else "too few",
        (True, False): f"at most {number(upper, '+')}" if upper == upper else "too few",
        (True, True): "open",
    }[lower == -math.inf, upper == math.inf]
    side = {(False, True): "at least ", (True, False): "at most "}.get(is_least, "")
    difference = f"{side}{number(estimate, '+')} {points}" if n else ""
    of_some = f", {n} pairs" if n < pairs else ""
    return (f"{measure.words}{of_some}", *estimates, difference, bounds, *errors)


def _as_bound(told: str, value: float, is_least: bool) -> str:
    """Return a number in words as a lower bound, if it is one."""
    if not is_least:
        return told
    return f"at least {told}" if value else f"{told} or more"
