"""Laws are found by name, chosen by the class of their parameters, and are plain Python outside kernels."""

from typing import NamedTuple, get_args

import numpy as np
import pytest
from pointwise import COHESION, drive, law_of, strength_of

from campaign.scene.sections import Soil
from campaign.simulation.solver_model import CUT_OFF
from solver._jit import kernel
from solver.laws.registry import Constants, constitutive_law, law_names, make_law, update_stress
from solver.softening import NO_SOFTENING, Softening

LAWS = law_names()  # before this module adds its own
STRESS, STRAIN = (-50e3, -100e3, -60e3, 5e3), (2e-4, -3e-4, 1e-3)


def test_a_scene_knows_every_law():
    assert sorted([*get_args(Soil.model_fields["law"].annotation), CUT_OFF]) == LAWS


@pytest.mark.parametrize("name", LAWS)
def test_a_law_is_the_same_in_python_and_in_a_kernel(name):
    """The kernel is compiled with sums reordered and fused, so it agrees to round-off; the point yields."""
    law, strength = law_of(name, psi=2.0, rate=3.0), strength_of(COHESION, np.radians(10.0))
    plain = update_stress(law, STRESS, STRAIN, 0.1, strength, 1.0)
    assert plain[4] > 0.1
    np.testing.assert_allclose(compiled_update(law, STRESS, STRAIN, 0.1, strength, 1.0), plain, rtol=1e-13)


@kernel
def compiled_update(law, stress, strain, plastic_strain, strength, dt):
    return update_stress(law, stress, strain, plastic_strain, strength, dt)


@pytest.mark.parametrize("name", LAWS)
def test_unyielding_ground_is_elastic_with_every_law(name):
    """``s = D e`` in plane strain, from engineering constants."""
    law = make_law(name, Constants(10e6, 0.3, 0.0, NO_SOFTENING))
    xx, yy, zz, xy, plastic_strain = drive(law, np.zeros(4), np.array([1e-4, -2e-4, 3e-4]), 1, strength_of(1e15, 0.2))
    assert plastic_strain == 0.0
    factor = 10e6 / (1.3 * 0.4)
    expected = factor * np.array([0.7e-4 - 0.6e-4, 0.3e-4 - 1.4e-4, -0.3e-4, 0.4 * 3e-4])
    np.testing.assert_allclose([xx, yy, zz, xy], expected, rtol=1e-12)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("place", range(5))
def test_nan_is_not_taken_for_strength(name, place):
    """A stress or a cohesion that is not a number must spread to the stress, where the march detects it."""
    values = np.array([-100e3, -300e3, -100e3, 80e3, COHESION])
    values[place] = np.nan
    found = drive(law_of(name), values[:4], np.zeros(3), 1, strength_of(values[4], 0.2))
    assert np.isnan(found).any()


class Viscous(NamedTuple):
    """A law of a test: the stress is that of a fluid, which only a law that knows the time step can have."""

    bulk_modulus: float
    shear_modulus: float
    softening: Softening
    viscosity: float


@constitutive_law("viscous", Viscous, lambda constants: Viscous(1.0, 1.0, constants.softening, 3.0))
def update_viscous(law, stress, strain, plastic_strain, strength, dt):
    twice = 2.0 * law.viscosity / dt
    return twice * strain[0], twice * strain[1], 0.0, twice * strain[2], plastic_strain


def test_a_new_law_is_a_class_and_a_function_and_knows_the_time_step():
    law = make_law("viscous", Constants(1.0, 0.0, 0.0, NO_SOFTENING))
    found = compiled_update(law, STRESS, STRAIN, 0.0, strength_of(0.0, 0.0), 0.5)
    np.testing.assert_allclose(found, [12.0 * 2e-4, -12.0 * 3e-4, 0.0, 12.0 * 1e-3, 0.0], rtol=1e-14)
