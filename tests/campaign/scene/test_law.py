"""The constitutive law of a scene: which strengths it reads, and that the others are refused."""

from pathlib import Path

import numpy as np
import pytest
from scene_complaints import FRICTION, UNDRAINED, complaint, complaints, written

from campaign.report.choices import modelling_choices
from campaign.scene import load_scene
from campaign.simulation.ground import prepare
from campaign.simulation.solver_model import model_of
from solver.in_situ import loading_model
from solver.laws.mohr_coulomb import MohrCoulomb
from solver.laws.registry import NO_CUTOFF

COARSE = ("numerics.cell=2 m", "numerics.end_time=1 s")


def test_undrained_ground_has_no_friction_angle(tmp_path: Path) -> None:
    scene = load_scene(written(tmp_path, *UNDRAINED))
    assert scene.soil.law == "tresca"
    assert scene.soil.friction_angle is None
    assert modelling_choices(scene)["Soil law"] == "tresca"
    assert modelling_choices(scene)["Cross-correlation"] == "none"


def test_a_friction_angle_given_with_undrained_strength_is_refused() -> None:
    messages = complaints("soil.law=tresca")
    assert len(messages) == 2
    assert "soil.friction_angle.mean" in messages[0]
    assert "knows undrained strength alone, which is the cohesion; remove the friction_angle" in messages[0]
    assert "with nothing to be correlated to; use 0" in messages[1]


@pytest.mark.parametrize("law", ["mohr-coulomb", "drucker-prager"])
def test_the_other_laws_need_one(tmp_path: Path, law: str) -> None:
    message = complaint(f"soil.law={law}", source=written(tmp_path, (FRICTION, "")))
    assert message.startswith("soil.friction_angle")
    assert f'is not given, but the law "{law}" needs it; add a section [soil.friction_angle]' in message


def test_undrained_ground_does_not_dilate(tmp_path: Path) -> None:
    message = complaint("soil.dilation_angle=1 deg", source=written(tmp_path, *UNDRAINED))
    assert "undrained soil keeps its volume; use 0 deg" in message


def test_a_cutoff_of_tension_belongs_to_mohr_coulomb(tmp_path: Path) -> None:
    cracked = load_scene("ma2023", ["soil.tension_cutoff=0 kPa"])
    assert model_of(cracked).laws[0].tension_cutoff == 0.0
    assert modelling_choices(cracked)["Soil law"] == "mohr-coulomb, tension up to 0 kPa"
    assert type(model_of(load_scene("ma2023")).laws[0]) is MohrCoulomb
    refused = complaint("soil.law=drucker-prager", "soil.tension_cutoff=5 kPa")
    assert 'only the law "mohr-coulomb" has one; leave it out' in refused
    assert "must not be negative" in complaint("soil.tension_cutoff=-1 kPa")
    clay = 'layer=[{name="clay", top="3 m", law="tresca"}, {name="sand", top="2 m"}]'
    crust, undrained, sand = load_scene("ma2023", ["soil.tension_cutoff=2 kPa", clay]).soils
    assert (crust.tension_cutoff, undrained.tension_cutoff, sand.tension_cutoff) == (2e3, None, 2e3)


def test_the_ground_at_rest_bears_any_tension() -> None:
    """It is elastic, the same with a cut-off and without."""
    models = (model_of(load_scene("ma2023", more)) for more in ([], ["soil.tension_cutoff=0 kPa"]))
    laws = [loading_model(model).laws[0] for model in models]
    assert laws[1].tension_cutoff == NO_CUTOFF
    assert laws[0].bulk_modulus == laws[1].bulk_modulus


def test_a_scene_from_before_the_law_was_a_key_is_the_same_scene(tmp_path: Path) -> None:
    older = written(tmp_path, ('law = "mohr-coulomb"           # paper, section 2.2\n', ""))
    assert "mohr-coulomb" not in older.read_text("utf-8")
    assert load_scene(older).digest() == load_scene("ma2023").digest()
    assert load_scene("ma2023", ["soil.law=drucker-prager"]).digest() != load_scene("ma2023").digest()


def test_undrained_strength_is_random_and_slides(tmp_path: Path) -> None:
    """The lognormal cohesion is the undrained strength; with 20 kPa the slope of 15 m fails."""
    ground = prepare(load_scene(written(tmp_path, *UNDRAINED), COARSE))
    start = ground.released(3)
    assert np.all(start.friction_angle == 0.0)
    assert np.std(start.cohesion) > 500.0
    assert list(ground.strengths(3)) == ["cohesion"]
    assert ground.simulate(3).values["max_displacement"][-1] > 0.1


def test_drucker_prager_ground_is_about_as_strong_as_mohr_coulomb_ground() -> None:
    """Matched at collapse in plane strain; on the way there the out-of-plane stress is another."""
    moved = [
        prepare(load_scene("ma2023", [*COARSE, f"soil.law={law}"])).simulate_mean().values["max_displacement"][-1]
        for law in ("mohr-coulomb", "drucker-prager")
    ]
    assert moved[1] == pytest.approx(moved[0], rel=0.1)


def test_what_an_answer_rests_on_knows_beds_trends_and_borings() -> None:
    """An angle above 0 turns the horizontal axis towards the right, where the slope falls: the beds dip into it."""
    boring = 'boring=[{name="B1", x="10 m", cohesion=[["2 m", "30 kPa"]]}]'
    told = modelling_choices(load_scene("ma2023", ["field.angle=20 deg", "soil.cohesion.gradient=1 kPa/m", boring]))
    assert told["Correlation"].endswith("2 m across the bedding, which dips into the slope at 20 degrees")
    assert told["Strength"].startswith("The mean peak cohesion grows by 1 kPa per metre of depth")
    assert told["Borings"].startswith("1, with 1 of peak cohesion")
    out = modelling_choices(load_scene("ma2023", ["field.angle=-20 deg"]))["Correlation"]
    assert out.endswith("which falls with the slope at 20 degrees")
