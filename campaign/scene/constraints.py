"""The values a scene may take: quantities and numbers with their bounds, as annotated types for pydantic models."""

from collections.abc import Callable, Iterable
from functools import partial
from itertools import pairwise
from math import inf, isfinite, radians
from typing import Annotated, Any, NamedTuple

from pydantic import AfterValidator, BeforeValidator, Field

from campaign.scene.units import (
    ANGLE,
    LENGTH,
    NUMBER,
    PRESSURE,
    Angle,
    AngleGradient,
    Area,
    Kind,
    Length,
    Pressure,
    PressureGradient,
    Time,
    of_a_size,
    si_value,
)

LARGEST_COV = 10.0
"""Beyond which a coefficient of variation is one in per cent."""

LARGEST_COUNT = 10**9
"""Of realizations, more than anybody has time for."""


def must(complaint: str, holds: Callable[[Any], bool]) -> AfterValidator:
    """Refuse a value for which `holds` is false; the complaint follows "KEY is VALUE, but it must"."""

    def check(value: Any) -> Any:
        if not holds(value):
            raise ValueError(f"it must {complaint}")
        return value

    return AfterValidator(check)


def one_of(names: Iterable[str]) -> AfterValidator:
    """Refuse a text that is none of the names in a table."""
    known = tuple(names)
    *first, last = (f'"{name}"' for name in known)
    return must(f"be {', '.join(first)} or {last}", known.__contains__)


def _goes_forward(points: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
    """Refuse points of which one lies to the left of the one before, and name it."""
    for number, ((left, _), (right, _)) in enumerate(pairwise(points), start=2):
        if right < left:
            raise ValueError(
                f"it must go from left to right, and point {number}, x = {right:g} m, lies to the left of the one "
                f"before, x = {left:g} m"
            )
    return points


def _descends(points: tuple[tuple[float, float], ...]) -> bool:
    return any(left > right for (_, left), (_, right) in pairwise(points))


def _stretch(written: Any, kind: Kind) -> tuple[float, float]:
    """Read a place, which is a stretch without length, or the two ends of a stretch [m]."""
    ends = written if isinstance(written, list) else [written, written]
    if len(ends) != 2:
        raise ValueError('it must be a place, for instance "42 m", or both ends of a range, as ["40 m", "46 m"]')
    near, far = (si_value(end, kind) for end in ends)
    if not (isfinite(near) and isfinite(far)):
        raise ValueError("a finite number is needed")
    if isinstance(written, list) and near >= far:
        raise ValueError("the range must increase; write its left end first, or a single place without brackets")
    return near, far


class Tolerance(NamedTuple):
    """How far off a mean may be: in m, or as a share of it."""

    value: float
    is_relative: bool

    def metres(self, mean: float) -> float:
        """Return it in m for a mean in m."""
        return self.value * mean if self.is_relative else self.value


def tolerance(text: str) -> Tolerance:
    """Read a share, "3 %", or a length, "0.3 m".

    Raises
    ------
    ValueError
        For what is neither, and for a share of 0 or of 100 % or more, worded to follow "KEY is VALUE, but".
    """
    kind = NUMBER if isinstance(text, str) and "%" in text else LENGTH
    value = si_value(text, kind)
    if value <= 0.0 or (kind is NUMBER and value >= 1.0):
        raise ValueError("it must be above 0, and a share below 100 %")
    return Tolerance(value, kind is NUMBER)


def _tolerable(written: Any) -> Any:
    if not isinstance(written, str):
        raise ValueError('it must be a share or a length of the mean run-out, for instance "3 %" or "0.3 m"')
    tolerance(written)
    return written


def listed(header: str, each: str) -> BeforeValidator:
    """Refuse what is no array of tables, each of which has a header with two brackets."""

    def check(written: Any) -> Any:
        if not isinstance(written, list):
            raise ValueError(f"it must be written under a line [[{header}]], with two brackets, once for each {each}")
        return written

    return BeforeValidator(check)


def _top(written: Any, kind: Kind) -> tuple[tuple[float, float], ...]:
    """Read the top of a layer, points (x, elevation) [m] from left to right; a level one is a single point at x = 0."""
    if isinstance(written, list):
        if len(written) < 2 or not all(isinstance(point, list) and len(point) == 2 for point in written):
            raise ValueError(
                'it must be an elevation, for instance "5 m", or two points or more, each of x and elevation, for '
                'instance [["0 m", "6 m"], ["80 m", "4 m"]]'
            )
        x_and_y = tuple((si_value(x, kind), si_value(y, kind)) for x, y in written)
        points = _goes_forward(x_and_y)
    else:
        points = ((0.0, si_value(written, kind)),)
    if min(y for _, y in points) < 0.0 or max(y for _, y in points) == 0.0:
        raise ValueError("it must lie above the base, which is at elevation 0")
    return points


def _soundings(written: Any, of: Kind, limit: float = inf) -> tuple[tuple[float, float], ...]:
    """Read values of a property at places, pairs of a length [m] and a value of a kind below a limit."""
    if not isinstance(written, list) or not all(isinstance(pair, list) and len(pair) == 2 for pair in written):
        example = f'[["1 m", "{of.example}"], ["3 m", "{of.example}"]]'
        raise ValueError(f"it must be pairs of a depth or an elevation and a value, for instance {example}")
    pairs = tuple((si_value(place, LENGTH), si_value(value, of)) for place, value in written)
    if any(not isfinite(place) or not 0.0 < value < limit for place, value in pairs):
        most = "" if limit == inf else " and below 90 deg"
        raise ValueError(f"each value must be above 0{most}; leave out what was not found")
    return pairs


POSITIVE = must("be greater than zero", lambda value: value > 0.0)
NOT_NEGATIVE = must("not be negative", lambda value: value >= 0.0)

PositiveLength = Annotated[Length, POSITIVE]
PositiveArea = Annotated[Area, POSITIVE]
PositivePressure = Annotated[Pressure, POSITIVE]
PositiveTime = Annotated[Time, POSITIVE]
AcuteAngle = Annotated[Angle, must("lie between 0 deg and 90 deg", lambda angle: 0.0 < angle < radians(90.0))]
RightAngle = Annotated[Angle, must("lie between -90 deg and 90 deg", lambda angle: abs(angle) <= radians(90.0))]

OF_A_SIZE = AfterValidator(of_a_size)
NOT_ENDLESS = must(f"be at most {LARGEST_COUNT:,}", lambda count: count <= LARGEST_COUNT)

PositiveNumber = Annotated[float, POSITIVE, OF_A_SIZE]
PositiveCount = Annotated[int, must("be 1 or more", lambda count: count >= 1), NOT_ENDLESS]
Count = Annotated[int, NOT_NEGATIVE, NOT_ENDLESS]
Seed = Annotated[int, NOT_NEGATIVE, must("be below 2^63", lambda seed: seed < 2**63)]
Line = Annotated[str, must("be a line of text without control characters", str.isprintable)]
A_SHARE = must(
    "be the standard deviation over the mean, at most 10; 30 % is written 0.3", lambda cov: cov <= LARGEST_COV
)
Cov = Annotated[float, NOT_NEGATIVE, OF_A_SIZE, A_SHARE]
# None is left out of a scene's identity, so that 0 is the same scene as no key at all.
OR_NONE = AfterValidator(lambda value: value or None)
OptionalCov = Annotated[float, NOT_NEGATIVE, OF_A_SIZE, A_SHARE, OR_NONE] | None
GROWS = must("not be negative; ground that is weaker below is a layer of its own", lambda value: value >= 0.0)
PressureGrowth = Annotated[PressureGradient, GROWS, OR_NONE] | None
AngleGrowth = Annotated[AngleGradient, GROWS, OR_NONE] | None
Fraction = Annotated[float, must("lie between 0 and 1", lambda value: 0.0 <= value <= 1.0)]
OpenFraction = Annotated[
    float, must("lie between 0 and 1, both excluded; 95 % is written 0.95", lambda value: 0.0 < value < 1.0)
]
SmallFraction = Annotated[
    float, must("lie between 0 and 0.5, both excluded; 10 % is written 0.1", lambda value: 0.0 < value < 0.5)
]

# Strict validation would refuse the lists that TOML gives.
Point = Annotated[tuple[Length, Length], Field(strict=False)]
Profile = Annotated[
    tuple[Point, ...],
    Field(strict=False),
    must("have two points or more", lambda points: len(points) >= 2),
    must("start at x = 0: take its first x off all x, of toe and receptors too", lambda points: points[0][0] == 0.0),
    AfterValidator(_goes_forward),
    must("stay above the base, which is at elevation 0", lambda points: min(y for _, y in points) >= 0.0),
    must("have a width; its last x must be greater than 0", lambda points: points[-1][0] > 0.0),
    must("descend to the right somewhere, because slides go there; mirror it", _descends),
]

Name = Annotated[str, must("be a line of text", lambda text: bool(text.strip()) and text.isprintable())]
Stretch = Annotated[tuple[float, float], BeforeValidator(partial(_stretch, kind=LENGTH))]
ToleranceText = Annotated[str, BeforeValidator(_tolerable)]
Pairs = tuple[tuple[float, float], ...]
Pressures = Annotated[Pairs, BeforeValidator(partial(_soundings, of=PRESSURE))]
Angles = Annotated[Pairs, BeforeValidator(partial(_soundings, of=ANGLE, limit=radians(90.0)))]
Top = Annotated[tuple[tuple[float, float], ...], BeforeValidator(partial(_top, kind=LENGTH))]
