"""Numbers with their intervals, as the page writes them."""

import math
import re

from campaign.statistics.intervals import Interval

SHOWN = {"Pa": ("kPa", 1e-3), "N/m": ("kN/m", 1e-3), "m3/m": ("m³/m", 1.0)}
"""Units in which numbers are read more easily, and how many of them the SI unit is."""

NUMBER_AND_UNIT = re.compile(r"(?<=\d) (?=%|(?:mm|m|s|kPa|kN/m|m/s|m³/m)\b)")


def unbroken(text: str) -> str:
    """Keep numbers and their units on one line."""
    return NUMBER_AND_UNIT.sub("\u00a0", text)


def number(value: float, unit: str) -> str:
    """Write an estimate in the unit in which it is shown, or a dash where there is none."""
    shown, factor = SHOWN.get(unit, (unit, 1.0))
    return f"{_digits(factor * value)} {shown}" if math.isfinite(value) else "–"


def bounds(interval: Interval, unit: str, form: str = "") -> str:
    """Write the bounds of an interval, as far as the sample suffices for them."""
    shown, factor = SHOWN.get(unit, (unit, 1.0))
    low, high = (_digits(factor * bound, form) for bound in (interval.lower, interval.upper))
    if interval.is_known:
        return f"{low} to {high} {shown}"
    if math.isfinite(interval.lower):
        return f"at least {low} {shown}"
    if math.isfinite(interval.upper):
        return f"at most {high} {shown}"
    return "too few slides for an interval"


def _digits(value: float, form: str = "") -> str:
    """Write a number in a form, or with three digits and all before the decimal point."""
    if form:
        return f"{value:{form}}"
    return f"{value:#.3g}".rstrip(".") if abs(value) < 1000 else f"{value:.0f}"
