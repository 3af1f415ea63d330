"""The ground of a realization, with residual strength that is random as well."""

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.fields.properties import PROPERTIES
from campaign.simulation.ground import prepare
from solver.particles import Particles

SCATTERED = (
    "soil.cohesion.residual_cov=0.4",
    "soil.friction_angle.residual_cov=0.3",
    "field.pairs.cohesion.cohesion_residual=0.5",
)


@pytest.fixture(scope="module")
def constant():
    return prepare(small_scene())


@pytest.fixture(scope="module")
def scattered():
    return prepare(small_scene(*SCATTERED))


def test_every_property_has_an_array_of_the_particles():
    assert {row.particle_array for row in PROPERTIES} <= set(Particles._fields)


def test_constant_residual_strength_is_that_of_the_scene(constant):
    released = constant.released(4)
    assert np.unique(released.cohesion_residual).tolist() == [10e3]
    assert np.unique(released.friction_angle_residual).tolist() == [constant.scene.soil.friction_angle.residual]


def test_random_residual_strength_leaves_the_peak_field_as_it_is(constant, scattered):
    """Bit for bit, on the reference grid; at the particles where peak is not raised to residual."""
    one, other = constant.draw(4), scattered.draw(4)
    assert one.names == ("cohesion", "friction_angle")
    for name in one.names:
        assert np.array_equal(one[name], other[name])
    here, there = constant.released(4), scattered.released(4)
    raised = there.cohesion == there.cohesion_residual
    assert np.array_equal(here.cohesion[~raised], there.cohesion[~raised])
    assert there.cohesion_residual.std() > 0.1 * there.cohesion_residual.mean()


def test_peak_is_nowhere_below_residual_and_the_raised_are_counted(scattered):
    released, shares = scattered.released(4), scattered.raised_shares(4)
    assert np.all(released.cohesion >= released.cohesion_residual)
    assert np.all(released.friction_angle >= released.friction_angle_residual)
    assert shares.keys() == {"cohesion", "friction_angle"}
    assert shares["cohesion"] == np.mean(released.cohesion == released.cohesion_residual) > 0.0
    assert shares["friction_angle"] == np.mean(released.friction_angle == released.friction_angle_residual) > 0.0


def test_the_runout_responds_to_random_residual_strength(constant, scattered):
    """The same peak strength, so that all of the change is the residual's; the deterministic run stays bit for bit."""
    one, other = (ground.simulate(4).values["final_runout_mass"] for ground in (constant, scattered))
    assert abs(one - other) > 0.05
    one, other = (ground.simulate_mean().values["runout"] for ground in (constant, scattered))
    assert np.array_equal(one, other)


def test_the_runout_is_that_of_constant_residual_strength_as_scatter_vanishes(constant):
    """A scatter of 1e-6 changes the run-out by less than 1 cm."""
    still = prepare(small_scene("soil.cohesion.residual_cov=1e-6", "soil.friction_angle.residual_cov=1e-6"))
    one, other = (ground.simulate(4).values["final_runout_mass"] for ground in (constant, still))
    assert one == pytest.approx(other, abs=0.01)
    assert not np.array_equal(still.released(4).cohesion_residual, constant.released(4).cohesion_residual)


def test_a_property_without_variation_is_its_mean_and_leaves_the_others_as_they_are(constant):
    certain = prepare(small_scene("soil.cohesion.cov=0"))
    assert certain.draw(4).names == ("friction_angle",)
    here, there = certain.released(4), constant.released(4)
    assert np.unique(here.cohesion).tolist() == [certain.scene.soil.cohesion.mean]
    assert np.array_equal(here.friction_angle, there.friction_angle)


def test_a_peak_without_variation_is_raised_to_random_residual_strength():
    ground = prepare(small_scene("soil.cohesion.cov=0", "soil.cohesion.residual_cov=0.9"))
    released = ground.released(4)
    assert np.array_equal(released.cohesion, np.maximum(ground.scene.soil.cohesion.mean, released.cohesion_residual))
    assert ground.raised_shares(4)["cohesion"] == np.mean(released.cohesion > ground.scene.soil.cohesion.mean) > 0.0


def test_a_campaign_in_which_nothing_is_random_has_the_same_realization_again():
    ground = prepare(small_scene("soil.cohesion.cov=0", "soil.friction_angle.cov=0"))
    assert "property" not in ground.coordinates
    assert "field_map" not in ground.quantities
    one, other, mean = ground.simulate(0).values, ground.simulate(4).values, ground.simulate_mean().values
    assert np.array_equal(one["runout"], other["runout"])
    assert np.array_equal(one["runout"], mean["runout"])
