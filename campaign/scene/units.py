"""Text with a unit, such as "20 kPa", to a float in SI, as annotated types for pydantic models."""

import re
from functools import cache, partial
from math import inf, isfinite
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from pydantic import BeforeValidator

from campaign.scene.document import shown

if TYPE_CHECKING:
    import pint


class Kind(NamedTuple):
    """A physical dimension as a scene writes it."""

    name: str
    si_unit: str
    example: str
    least_unit: float = 0.0
    """Of the units in which it is written, in SI: milli is meant to be mega, and mega milli, beyond these."""
    largest_unit: float = inf


LENGTH = Kind("a length", "m", "2 m", largest_unit=1e5)
AREA = Kind("an area", "m^2", "0.25 m^2")
PRESSURE = Kind("a pressure", "Pa", "20 kPa", least_unit=0.1)
UNIT_WEIGHT = Kind("a unit weight", "N/m^3", "20 kN/m^3", least_unit=0.1)
ANGLE = Kind("an angle", "rad", "10 deg")
TIME = Kind("a time", "s", "10 s")
DENSITY = Kind("a density", "kg/m^3", "2000 kg/m^3")
NUMBER = Kind("a number without unit", "", "0.1")
PRESSURE_GRADIENT = Kind("a pressure per length", "Pa/m", "2 kPa/m", least_unit=0.1)
ANGLE_GRADIENT = Kind("an angle per length", "rad/m", "0.1 deg/m")
KINDS = (LENGTH, AREA, PRESSURE, UNIT_WEIGHT, ANGLE, TIME, DENSITY, NUMBER, ANGLE_GRADIENT)
"""Those by which a quantity in its wrong place is named; a pressure per length is a unit weight."""

OTHERS = {
    "[mass] * [length] / [time] ** 2": "a force",
    "[mass] / [time] ** 2": "a force per length",
    "[mass]": "a mass",
    "[length] ** 3": "a volume",
    "[length] / [time]": "a speed",
    "[length] / [time] ** 2": "an acceleration",
}
"""What else people write, by pint's dimension."""

QUANTITY = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*(\S.*?)?\s*", re.DOTALL)

NAME, POWER = r"(?:[A-Za-zµμ]+|°|%)", r"(?:(?:\^|\*\*)?(-?[1-9]))?"
UNIT = re.compile(rf"{NAME}{POWER}(?:\s*[*/·]\s*{NAME}{POWER})*")
"""A unit is names, each with a power of one digit or none, joined by signs of multiplication or division."""
FACTOR = re.compile(rf"([*/·]?)\s*({NAME}){POWER}")

STIFF = 1e7
"""Pressure in Pa from which on people write MPa."""

SMALLEST, LARGEST = 1e-15, 1e15
"""Magnitudes of a number in SI, other than 0; those of a soil are far within, and none overflows in a product."""


def si_value(text: Any, kind: Kind) -> float:
    """Read a number with its unit.

    Parameters
    ----------
    text
        For instance "20 kN/m^3"; "20 kN/m3" is understood too.
    kind
        The dimension it must have.

    Returns
    -------
    float
        The value in `kind.si_unit`.

    Raises
    ------
    ValueError
        For a bare number, an unknown unit, a wrong dimension or an absurd size, worded to follow "KEY is VALUE, but".
    """
    parts = QUANTITY.fullmatch(text) if isinstance(text, str) else None
    if isinstance(text, str) and parts is None:
        raise ValueError(f'{kind.name} is a number followed by a unit, for instance "{kind.example}"')
    if parts is None or parts[2] is None:
        raise ValueError(f'{kind.name} needs its unit and quotes, for instance "{kind.example}"')
    unit = _known_unit(parts[2], kind)
    if _root(unit) != _root(_registry().Unit(kind.si_unit)):
        raise ValueError(f'that is {_name(unit)}, and {kind.name} is needed, for instance "{kind.example}"')
    one = float(_registry().Quantity(1.0, unit).to(kind.si_unit).magnitude)
    if not kind.least_unit <= one <= kind.largest_unit:
        raise ValueError(
            f"{shown(parts[2])} is {one:g} {kind.si_unit}, and {kind.name} is not written so: m is milli, M is mega; "
            f'give for instance "{kind.example}"'
        )
    return of_a_size(float(_registry().Quantity(float(parts[1]), unit).to(kind.si_unit).magnitude), kind.si_unit)


def of_a_size(value: float, si_unit: str = "") -> float:
    """Return a number in SI if it is one that something can have.

    Raises
    ------
    ValueError
        For NaN, and for what is too large or too small, worded to follow "KEY is VALUE, but".
    """
    if isfinite(value) and value != 0.0 and not SMALLEST <= abs(value) <= LARGEST:
        unit = f" {si_unit}" if si_unit else ""
        raise ValueError(f"nothing is of that size; give 0, or from {SMALLEST:g}{unit} to {LARGEST:g}{unit}")
    return value


def shown_in_unit(value: float, kind: Kind) -> str:
    """Write a value given in SI in the unit in which people read it, that of the kind's example."""
    unit = "MPa" if kind is PRESSURE and abs(value) >= STIFF else kind.example.partition(" ")[2]
    return f"{_registry().Quantity(value, kind.si_unit).to(_known_unit(unit, kind)).magnitude:.6g} {unit}"


@cache
def _registry() -> "pint.UnitRegistry[float]":
    # Building the registry takes a quarter of a second, which only those who read a scene should pay.
    import pint

    return pint.UnitRegistry()


@cache
def _known_unit(text: str, kind: Kind) -> "pint.Unit":
    """Return the product of the units named in a text; pint looks each name up and evaluates nothing."""
    try:
        if UNIT.fullmatch(text) is None:
            raise ValueError("it does not follow the grammar")
        unit = _registry().Unit("")
        for sign, name, power in FACTOR.findall(text):
            unit *= _registry().Unit(name) ** (int(power or 1) * (-1 if sign == "/" else 1))
    except Exception as error:  # pint has many for a name that it does not know
        raise ValueError(
            f'{shown(text)} is not a unit; {kind.name} is written for instance "{kind.example}"'
        ) from error
    return unit


def _root(unit: "pint.Unit") -> Any:
    # Root units, not dimensions: to pint a degree, a percent and a bare number all are dimensionless.
    return _registry().get_root_units(unit)[1]


def _name(unit: "pint.Unit") -> str:
    same = [kind.name for kind in KINDS if _root(unit) == _root(_registry().Unit(kind.si_unit))]
    return next(iter(same), None) or OTHERS.get(f"{unit.dimensionality}") or f"of dimension {unit.dimensionality}"


Length = Annotated[float, BeforeValidator(partial(si_value, kind=LENGTH))]
Area = Annotated[float, BeforeValidator(partial(si_value, kind=AREA))]
Pressure = Annotated[float, BeforeValidator(partial(si_value, kind=PRESSURE))]
UnitWeight = Annotated[float, BeforeValidator(partial(si_value, kind=UNIT_WEIGHT))]
Angle = Annotated[float, BeforeValidator(partial(si_value, kind=ANGLE))]
Time = Annotated[float, BeforeValidator(partial(si_value, kind=TIME))]
PressureGradient = Annotated[float, BeforeValidator(partial(si_value, kind=PRESSURE_GRADIENT))]
AngleGradient = Annotated[float, BeforeValidator(partial(si_value, kind=ANGLE_GRADIENT))]
