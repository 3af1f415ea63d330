"""The softening rate belongs to a law, and to a cell or an internal length."""

from pathlib import Path

from scene_complaints import complaint, written

from campaign.scene import load_scene
from campaign.simulation.solver_model import softening_rate


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
