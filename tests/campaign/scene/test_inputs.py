"""An input is changed alone, and the ground is the same but for it."""

import numpy as np
import pytest

from campaign.errors import RefusalError
from campaign.fields.properties import PROPERTIES, RESIDUALS
from campaign.scene import load_scene
from campaign.scene.cost import core_seconds, with_more_of_an_input
from campaign.scene.inputs import BY_KEY, INPUTS, inputs_of, raised, with_more
from campaign.simulation.ground import strengths_of

MA2023 = load_scene("ma2023", ["numerics.cell=2 m"])


def keys(scene):
    return [row.key for row in inputs_of(scene)]


def test_a_scene_has_the_inputs_that_count_in_it():
    others = ["soil.softening.slip_to_residual", "soil.softening.reference_cell"]
    of_other_ground = [row.share_key for row in RESIDUALS] + [row.gradient_key for row in PROPERTIES]
    of_other_ground += ["soil.k0", "soil.tension_cutoff", "water.r_u"]
    assert [row.key for row in INPUTS if row.key not in keys(MA2023)] == [*others, *of_other_ground]
    assert "water.r_u" in keys(load_scene("ma2023", ["water.r_u=0.2"]))
    by_slip = keys(load_scene("ma2023", ["soil.softening.slip_to_residual=2 m"]))
    assert by_slip[0] == "soil.softening.slip_to_residual"
    assert "soil.softening.internal_length" not in by_slip
    assert "soil.softening.reference_cell" in keys(load_scene("ma2023-printed"))
    hard = load_scene("ma2023", ['soil.softening={law = "none"}'])
    assert not [key for key in keys(hard) if "softening" in key or "residual" in key]
    share = keys(load_scene("ma2023", ["soil.cohesion.residual_share=0.5"]))
    assert [key for key in share if "cohesion" in key] == ["soil.cohesion.mean", "soil.cohesion.residual_share"]
    assert "soil.cohesion.residual" not in keys(load_scene("ma2023", ["soil.cohesion.residual=0 kPa"]))


@pytest.mark.parametrize("key", keys(MA2023))
def test_ten_per_cent_more_of_one_input_changes_nothing_else(key):
    here, there = MA2023.identity(), with_more(MA2023, BY_KEY[key]).identity()
    assert {name for name in here if here[name] != there[name]} == {key}
    assert there[key] == pytest.approx(1.1 * here[key], rel=1e-12)


def test_more_mean_strength_is_more_everywhere_in_the_same_field():
    other = with_more(MA2023, BY_KEY["soil.cohesion.mean"])
    here, there = (strengths_of(scene, 3) for scene in (MA2023, other))
    np.testing.assert_allclose(there["cohesion"], 1.1 * here["cohesion"], rtol=1e-12)
    np.testing.assert_array_equal(there["friction_angle"], here["friction_angle"])


def test_the_campaign_of_a_changed_scene_is_that_of_its_own():
    scene = MA2023.model_copy(update={"campaign": MA2023.campaign.model_copy(update={"seed": 5})})
    assert with_more(scene, BY_KEY["soil.unit_weight"]).campaign == scene.campaign


def test_more_of_what_cannot_be_more_is_refused():
    scene = load_scene("ma2023", ["soil.cohesion.residual=19 kPa", "soil.cohesion.cov=0.01"])
    with pytest.raises(RefusalError, match=r"^--set soil.cohesion.residual is .* must not exceed the mean peak"):
        with_more(scene, BY_KEY["soil.cohesion.residual"])


def test_repeated_slides_cost_what_they_are():
    none = load_scene(MA2023, ["campaign.sensitivity_pairs=0"])
    assert (with_more_of_an_input(MA2023), with_more_of_an_input(none)) == (4 * 8, 0)
    assert core_seconds(MA2023) / core_seconds(none) == pytest.approx((1000 + 64 + 32) / (1000 + 64))
    assert raised(MA2023, BY_KEY["soil.unit_weight"]) == pytest.approx(22e3)


def test_wet_ground_is_heavier_when_moist_ground_is():
    """Alone, 10 % more of the moist unit weight would exceed the saturated one."""
    scene = load_scene("drawdown")
    heavier = with_more(scene, BY_KEY["soil.unit_weight"]).soil
    assert heavier.unit_weight == pytest.approx(1.1 * scene.soil.unit_weight)
    assert heavier.saturated_unit_weight == pytest.approx(1.1 * scene.soil.saturated_unit_weight)
