"""A particle has the strength of its layer, whatever cell of the field's grid it lies in."""

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.accuracy.field_control import deviations
from campaign.errors import SamplerError
from campaign.scene.ground_surface import surface_of
from campaign.seeds import BASELINE
from campaign.simulation.field_summary import box_map
from campaign.simulation.ground import strengths_of

COARSE = "field.resolution=1 m"
SAME = 'layer=[{name="same", top="7.3 m"}]'
STIFF = 'layer=[{name="stiff", top="7.3 m", cohesion={mean="50 kPa", cov=0.4}, friction_angle={mean="20 deg"}}]'
UNDRAINED = 'layer=[{name="clay", top="7.3 m", law="tresca", cohesion={mean="30 kPa"}}]'


CREST = slice(0, 20)
"""Columns where there is ground above and below the interface."""


def of_crest(field):
    """Return the properties below the crest by name, and the rows below the interface."""
    return {name: field[name][:, CREST] for name in field.names}, field.grid.y < 7.3


def gaussian(values, mean, cov):
    variance = np.log1p(cov**2)
    return (np.log(values) - (np.log(mean) - variance / 2.0)) / np.sqrt(variance)


def test_layers_of_one_soil_have_the_field_of_one_soil_bit_for_bit():
    one, two = (strengths_of(small_scene(COARSE, *more), 3) for more in ((), (SAME,)))
    np.testing.assert_array_equal(one.values, two.values)
    x, y = np.array([3.0, 12.0, 30.0]), np.array([7.2, 7.4, 1.0])
    for name, values in one.at(x, y).items():
        np.testing.assert_array_equal(two.at(x, y, np.array([1, 0, 1]))[name], values)


def test_a_shared_field_goes_on_across_layers_and_each_has_its_marginals():
    one, two = (strengths_of(small_scene(COARSE, *more), 3) for more in ((), (STIFF,)))
    (one, _), (two, below) = of_crest(one), of_crest(two)
    for name, own, other in (("cohesion", (20e3, 0.1), (50e3, 0.4)), ("friction_angle", (10.0, 0.1), (20.0, 0.1))):
        unit = 1.0 if name == "cohesion" else np.pi / 180.0
        expected = gaussian(one[name] / unit, *own)
        np.testing.assert_allclose(gaussian(two[name][below] / unit, *other), expected[below], atol=1e-9)
        np.testing.assert_array_equal(two[name][~below], one[name][~below])


def test_a_particle_reads_its_layer_and_not_that_of_the_middle_of_its_cell():
    """The cell from 7 to 8 m has its middle above the interface at 7.3 m."""
    one, two = (strengths_of(small_scene(COARSE, *more), 3) for more in ((), (STIFF,)))
    x, y = np.array([5.0, 5.0]), np.array([7.2, 7.4])
    above, below = one.at(x, y)["cohesion"][0], two.at(x, y, np.array([1, 0]))["cohesion"]
    assert below[1] == above
    assert gaussian(below[0], 50e3, 0.4) == pytest.approx(gaussian(above, 20e3, 0.1))


def test_a_field_of_its_own_is_another_one_of_the_same_correlation():
    scene = small_scene(COARSE, SAME, "layer.1.field=own")
    shared, own = strengths_of(small_scene(COARSE, SAME), 3), strengths_of(scene, 3)
    above = own.grid.y > 7.3
    np.testing.assert_array_equal(own.values[:, above], shared.values[:, above])
    z = gaussian(np.array([strengths_of(scene, k)["cohesion"] for k in range(200)]), 20e3, 0.1)
    near, across = (np.corrcoef(z[:, row, 10], z[:, 7, 10])[0, 1] for row in (8, 6))
    assert near == pytest.approx(np.exp(-0.5), abs=4.0 * (1.0 - np.exp(-1.0)) / np.sqrt(200.0))
    assert abs(across) < 4.0 / np.sqrt(200.0)  # 4 standard errors


def test_mean_strengths_are_those_of_each_layer():
    field, below = of_crest(strengths_of(small_scene(COARSE, STIFF), BASELINE))
    np.testing.assert_allclose(field["cohesion"][below], 50e3)
    np.testing.assert_allclose(field["cohesion"][~below], 20e3)


def test_a_property_that_a_layer_does_not_have_is_not_random_there():
    field = strengths_of(small_scene(COARSE, UNDRAINED), 3)
    drawn, below = of_crest(field)
    assert np.isnan(drawn["friction_angle"][below]).all()
    assert np.isfinite(drawn["friction_angle"][~below]).all()
    assert np.isfinite(drawn["cohesion"]).all()
    x, y = np.array([5.0, 5.0]), np.array([7.2, 7.4])
    assert field.at(x, y, np.array([1, 0]))["friction_angle"][0] == 0.0


def test_only_what_is_read_of_a_layer_may_reach_a_limit():
    """A friction angle that is beyond 90 deg at the largest value of the field, and below it in the deep layer."""
    deep = 'layer=[{name="deep", top="2.5 m"}]'
    drawn = strengths_of(small_scene(COARSE, deep), 3)
    z = gaussian(drawn["friction_angle"], np.radians(10.0), 0.1)
    deepest, largest = z[:3].max(), z.max()
    assert largest > deepest + 0.1
    scene, sigma = small_scene(COARSE, deep), np.sqrt(np.log1p(0.5**2))
    for at_limit, is_refused in ((0.5 * (deepest + largest), False), (deepest - 0.1, True)):
        mean = np.radians(90.0) * np.exp(sigma**2 / 2.0 - sigma * at_limit)
        friction_angle = scene.soil.friction_angle.model_copy(update={"mean": mean, "cov": 0.5})
        layer = scene.layer[0].model_copy(update={"friction_angle": friction_angle})
        layer.model_fields_set.add("friction_angle")
        wild = scene.model_copy(update={"layer": (layer,)})
        if is_refused:
            with pytest.raises(
                SamplerError, match=r"lower layer\.1\.friction_angle\.mean or layer\.1\.friction_angle\.cov"
            ):
                strengths_of(wild, 3)
        else:
            assert strengths_of(wild, 3).names == drawn.names


@pytest.mark.parametrize("layers", [STIFF, UNDRAINED])
def test_maps_deviate_from_the_means_of_the_layers_in_each_box(layers):
    """Their mean over many realizations is 0 in every box, also where an interface cuts it."""
    scene = small_scene(COARSE, layers)
    surface = surface_of(scene.geometry)
    fields = [strengths_of(scene, k) for k in range(60)]
    boxes = box_map(surface, fields[0].grid)
    found = deviations(np.array([boxes.means(field) for field in fields]), scene)
    assert np.isfinite(found).all()
    error = found.std(axis=0, ddof=1) / np.sqrt(60.0)
    assert np.max(np.abs(found.mean(axis=0)) / error) < 5.0
