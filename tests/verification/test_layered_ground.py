"""Layered ground: at rest, as one soil in two layers, and with a weak layer that draws the failure surface into it."""

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.scene import scene_of
from campaign.scene.document import read_document
from campaign.simulation.ground import prepare
from campaign.simulation.solver_model import model_of
from solver.constants import STANDARD_GRAVITY
from solver.in_situ import in_situ_state
from solver.surface import Surface

SHORT = ("numerics.end_time=3 s", "numerics.output_interval=0.5 s", "field.resolution=1 m")


def test_level_ground_of_two_layers_rests_under_its_overburden():
    """``s_yy = -sum gamma_k thickness_k`` and ``s_xx = nu_k / (1 - nu_k) s_yy``, of the layer a particle lies in."""
    heavy = 'layer=[{name="heavy", top="2 m", unit_weight="25 kN/m^3", poisson_ratio=0.2, young_modulus="300 MPa"}]'
    model = model_of(small_scene(heavy, "numerics.cell=1 m"))
    level = Surface(np.array([0.0, 6.0]), np.array([4.0, 4.0]))
    interface = Surface(np.array([0.0, 6.0]), np.array([2.0, 2.0]))
    ground = in_situ_state(model._replace(surface=level, interfaces=(interface,)))
    is_heavy = ground.y < 2.0
    np.testing.assert_array_equal(ground.material, is_heavy)
    weight = np.where(is_heavy, 2.0 * 20e3 + 25e3 * (2.0 - ground.y), 20e3 * (4.0 - ground.y))
    poisson_ratio = np.where(is_heavy, 0.2, 0.35)
    np.testing.assert_allclose(ground.stress_yy, -weight, atol=1e-3 * weight.max())
    expected = -poisson_ratio / (1.0 - poisson_ratio) * weight
    np.testing.assert_allclose(ground.stress_xx, expected, atol=1e-3 * weight.max())
    assert np.sum(ground.mass) == pytest.approx(6.0 * (2.0 * 20e3 + 2.0 * 25e3) / STANDARD_GRAVITY)


def test_a_realization_of_the_same_soil_in_two_layers_is_that_of_one():
    """Bit for bit where particles are concerned; sums over the ground are fused otherwise, so those to round-off."""
    one, two = (prepare(small_scene(*SHORT, *more)) for more in ((), ('layer=[{name="same", top="7 m"}]',)))
    assert set(two.lattice.material) == {0, 1}
    here, there = (ground.simulate(3).values for ground in (one, two))
    assert float(here["final_runout_mass"]) > 1.0
    for name in here.keys() - {"wall_time"}:
        expected = np.asarray(here[name], dtype=float)
        np.testing.assert_allclose(there[name], expected, rtol=1e-12, atol=1e-12, err_msg=name)
    assert two.raised_shares(3) == one.raised_shares(3)


def test_a_weak_layer_draws_the_failure_surface_into_it():
    """The slip zone of the mean strengths lies above the toe in one soil, and in the weak layer below it with one."""
    text = read_document("ma2023").text
    weak = '\n[[layer]]\nname = "weak"\ntop = "4 m"\ncohesion = {mean = "4 kPa", residual = "3 kPa"}\n'
    weak += 'friction_angle = {mean = "3 deg", residual = "2 deg"}\n'
    overrides = ["numerics.cell=1 m", "numerics.end_time=2 s", "field.resolution=1 m"]
    shares = []
    for layers in ("", weak):
        ground = prepare(scene_of(text + layers, overrides))
        seen = []
        ground.simulate(-1, observe=lambda march, seen=seen: seen.append(march.particles.plastic_strain.copy()))
        slip = seen[-1] * (ground.lattice.x < ground.toe_x)
        shares.append(float(slip[ground.lattice.y < 4.0].sum() / slip.sum()))
    assert shares[0] < 0.2 < 0.4 < shares[1]
