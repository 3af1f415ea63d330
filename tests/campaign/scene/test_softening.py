"""The softening rate belongs to a law, and to a cell or an internal length."""

from pathlib import Path

from scene_complaints import complaint, written

from campaign.scene import load_scene


def test_softening_needs_a_rate_only_if_it_has_a_law(tmp_path: Path) -> None:
    without = written(tmp_path, ("rate = 0.189 ", "# rate = 0.189 "))
    assert "is not given, but the exponential law needs it" in complaint(source=without)
    assert load_scene(without, ["soil.softening.law=none"]).soil.softening.rate_at(1.0) == 0.0


def test_the_softening_rate_grows_with_the_cell() -> None:
    softening = load_scene("ma2023-printed").soil.softening
    assert softening.rate_at(0.5) == softening.rate
    assert softening.rate_at(1.0) == 2.0 * softening.rate_at(0.5)


def test_an_internal_length_takes_the_place_of_the_reference_cell(tmp_path: Path) -> None:
    softening = load_scene("ma2023").soil.softening
    assert softening.rate_at(0.5) == softening.rate_at(1.0) == softening.rate
    assert "leave out one of the two" in complaint("soil.softening.reference_cell=1 m")
    assert 'or internal_length = "1 m"' in complaint(source=written(tmp_path, ("internal_length = ", "# ")))
