"""Quantities with units become SI floats, and everything else is refused with a remedy."""

import subprocess
import sys
from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from campaign.scene.units import ANGLE, LENGTH, PRESSURE, TIME, UNIT_WEIGHT, Kind, shown_in_unit, si_value


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("20 kPa", PRESSURE, 20e3),
        ("100 MPa", PRESSURE, 100e6),
        ("0.02 N/mm^2", PRESSURE, 20e3),
        ("250 mm", LENGTH, 0.25),
        (" 1.5e1m ", LENGTH, 15.0),
        ("-.5 m", LENGTH, -0.5),
        ("45 deg", ANGLE, pi / 4.0),
        ("45°", ANGLE, pi / 4.0),
        ("0.5 rad", ANGLE, 0.5),
        ("20 kN/m^3", UNIT_WEIGHT, 20e3),
        ("20 kN/m3", UNIT_WEIGHT, 20e3),
        ("20 kN/m**3", UNIT_WEIGHT, 20e3),
        ("20 kN·m^-3", UNIT_WEIGHT, 20e3),
        ("20 N / m / m", PRESSURE, 20.0),
        ("0 kPa", PRESSURE, 0.0),
        ("1 h", TIME, 3600.0),
        ("100 ms", TIME, 0.1),
    ],
)
def test_quantities_become_si(text: str, kind: Kind, value: float) -> None:
    assert si_value(text, kind) == pytest.approx(value, rel=1e-15)


@given(st.floats(min_value=1e-15, max_value=1e15))
def test_a_value_in_si_is_kept_to_the_last_bit(value: float) -> None:
    assert si_value(f"{value!r} m", LENGTH) == value


@pytest.mark.parametrize(
    ("text", "kind", "complaint"),
    [
        (20, PRESSURE, 'a pressure needs its unit and quotes, for instance "20 kPa"'),
        (True, LENGTH, "a length needs its unit"),
        ("20", PRESSURE, "a pressure needs its unit"),
        ("", PRESSURE, "a pressure is a number followed by a unit"),
        ("m", LENGTH, "a length is a number followed by a unit"),
        ("nan m", LENGTH, "a length is a number followed by a unit"),
        ("20 kpa", PRESSURE, '"kpa" is not a unit; a pressure is written for instance "20 kPa"'),
        ("1 m + 2 m", LENGTH, '"m \\+ 2 m" is not a unit'),
        ("20 m", PRESSURE, "that is a length, and a pressure is needed"),
        ("2000 kg/m^3", UNIT_WEIGHT, "that is a density, and a unit weight is needed"),
        ("10 %", ANGLE, "that is a number without unit, and an angle is needed"),
        ("3 kN", LENGTH, "that is a force, and a length is needed"),
        ("3 m*deg", LENGTH, "that is of dimension"),
        ("1 degC", LENGTH, "that is of dimension"),
        ("60 mPa", PRESSURE, '"mPa" is 0.001 Pa, and a pressure is not written so: m is milli, M is mega'),
        ("20 mN/m^3", UNIT_WEIGHT, "a unit weight is not written so: m is milli"),
        ("15 Mm", LENGTH, r'"Mm" is 1e\+06 m, and a length is not written so'),
        ("1e301 m", LENGTH, "nothing is of that size; give 0, or from 1e-15 m to 1e\\+15 m"),
        ("1e-16 Pa", PRESSURE, "nothing is of that size"),
        ("-1e16 m", LENGTH, "nothing is of that size"),
    ],
)
def test_what_is_not_such_a_quantity_is_refused_with_its_remedy(text: object, kind: Kind, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        si_value(text, kind)


NO_UNITS = """m**9**9**9 | m**1000 | kPa**1000 | m^10 | m^0 | m^1.5 | m? | m~ | m # kPa | m\0 | m m | m deg | (m) | m//s
 | /m | m/ | m* | m^ | 2*m | m+m | m-1*m**2**3 | kilo m | nan | inf | __import__ | m²"""


@pytest.mark.parametrize("unit", NO_UNITS.split(" | "))
def test_what_is_not_in_the_grammar_is_no_unit(unit: str) -> None:
    """Nothing is evaluated: m**9**9**9 would not end."""
    with pytest.raises(ValueError, match="is not a unit; a length is written for instance"):
        si_value(f"1 {unit}", LENGTH)


@given(st.text(max_size=12))
def test_any_text_is_a_quantity_or_a_sentence(text: str) -> None:
    def answer() -> str:
        try:
            return "for instance" if 1e-15 <= si_value(f"1 {text}", LENGTH) <= 1e15 else "nothing"
        except ValueError as error:
            return str(error)

    assert "for instance" in answer() or "nothing is of that size" in answer()


@pytest.mark.parametrize(
    ("value", "kind", "text"),
    [
        (25e3, PRESSURE, "25 kPa"),
        (110e6, PRESSURE, "110 MPa"),
        (pi / 18.0, ANGLE, "10 deg"),
        (20e3, UNIT_WEIGHT, "20 kN/m^3"),
        (0.5, LENGTH, "0.5 m"),
    ],
)
def test_a_value_is_shown_in_the_unit_of_people(value: float, kind: Kind, text: str) -> None:
    assert shown_in_unit(value, kind) == text


def test_importing_the_scene_does_not_load_pint() -> None:
    """Pint and its registry take a quarter of a second; workers that are handed a scene never need them."""
    check = "import sys, campaign.scene.sections; sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", check], check=False).returncode == 0
