"""The softening rate belongs to a law, and to a cell or an internal length; a slip to residual says it as well."""

from math import log, sqrt
from pathlib import Path

import pytest
from scene_complaints import complaint, written

from campaign.scene import load_scene
from campaign.scene.softening import softening_rate, softening_words


def test_softening_needs_a_rate_only_if_it_has_a_law(tmp_path: Path) -> None:
    without = written(tmp_path, ("rate = 0.189 ", "# rate = 0.189 "))
    assert "is not given, but the exponential law needs it" in complaint(source=without)
    assert softening_rate(load_scene(without, ["soil.softening.law=none"])) == 0.0


def test_the_softening_rate_grows_with_the_cell() -> None:
    half_metre, metre = (load_scene("ma2023-printed", [f"numerics.cell={cell} m"]) for cell in (0.5, 1.0))
    assert softening_rate(half_metre) == half_metre.soil.softening.rate
    assert softening_rate(metre) == 2.0 * softening_rate(half_metre)


def test_an_internal_length_takes_the_place_of_the_reference_cell(tmp_path: Path) -> None:
    coarse, fine, finer = (load_scene("ma2023", [f"numerics.cell={cell} m"]) for cell in (1.0, 0.5, 0.25))
    assert softening_rate(finer) == softening_rate(fine) == fine.soil.softening.rate
    assert softening_rate(coarse) > softening_rate(fine)  # bands of these cells are thicker
    assert "leave out one of the two" in complaint("soil.softening.reference_cell=1 m")
    assert 'or internal_length = "1 m"' in complaint(source=written(tmp_path, ("internal_length = ", "# ")))


RATE = "rate = 0.189 "


@pytest.mark.parametrize(("law", "rate"), [("exponential", sqrt(3.0) * 1.25 * log(20.0) / 0.3), ("linear", 7.2169)])
def test_a_slip_to_residual_is_a_rate_over_the_internal_length(tmp_path: Path, law: str, rate: float) -> None:
    """Square root of 3 times length over slip, times ln 20 where 5 % is left; 1.25 m and 0.3 m."""
    lines = (RATE, 'slip_to_residual = "30 cm" # '), ('law = "exponential" ', f'law = "{law}" ')
    scene = load_scene(written(tmp_path, *lines), ["numerics.cell=0.25 m"])
    assert softening_rate(scene) == pytest.approx(rate, rel=1e-4)
    assert "after 0.3 m of slip" in softening_words(scene.soil.softening)


def test_slip_or_rate_is_given_and_not_both(tmp_path: Path) -> None:
    both = written(tmp_path, (RATE, 'slip_to_residual = "30 cm"\nrate = 0.189 '))
    assert "leave out one of the two" in complaint(source=both)
    assert 'or slip_to_residual = "0.3 m"' in complaint(source=written(tmp_path, (RATE, "# ")))


def test_an_override_of_one_replaces_the_other() -> None:
    by_slip = load_scene("ma2023", ["soil.softening.slip_to_residual=0.3 m"]).soil.softening
    assert (by_slip.rate, by_slip.slip_to_residual) == (None, 0.3)
    again = load_scene("ma2023", ["soil.softening.slip_to_residual=0.3 m", "soil.softening.rate=0.2"]).soil.softening
    assert (again.rate, again.slip_to_residual) == (0.2, None)


def test_slip_needs_a_band_of_known_thickness(tmp_path: Path) -> None:
    """Local bands are 1 to 4.4 cells thick."""
    local = (RATE, 'slip_to_residual = "0.3 m" # '), ('internal_length = "1.25 m" ', 'reference_cell = "0.5 m" ')
    assert "give an internal_length instead of the reference_cell" in complaint(source=written(tmp_path, *local))


def test_the_calibrated_rates_are_far_from_laboratory_slips() -> None:
    """exp(-0.189 u / (sqrt(3) 1.25 m)) = 0.05 at u = 34 m; a measured 0.1 to 0.5 m is a rate of 13 to 65."""
    assert "95 % of the drop from peak to residual strength is lost after 34 m" in softening_words(
        load_scene("ma2023").soil.softening
    )
    printed = softening_words(load_scene("ma2023-printed").soil.softening)
    assert "after 16 m of slip in bands 2.1 cells thick" in printed
    assert "after 33 m in bands of 4.4 cells" in printed
    assert softening_words(load_scene("bui2008").soil.softening) == "none"
