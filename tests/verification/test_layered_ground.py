"""Layered ground: at rest, as one soil in two layers, and with a weak layer that draws the failure surface into it."""

import h5py
import numpy as np
import pytest
from small_campaign import run, small_scene

from campaign import open_results
from campaign.report.figures.section import section_of
from campaign.report.figures.strengths import strengths
from campaign.report.snapshots import slide_of
from campaign.results.replay import replay
from campaign.scene import scene_of
from campaign.scene.document import read_document
from campaign.simulation.ground import prepare
from campaign.simulation.solver_model import model_of
from solver.constants import STANDARD_GRAVITY
from solver.in_situ import in_situ_state
from solver.surface import Surface

SHORT = ("numerics.end_time=3 s", "numerics.output_interval=0.5 s", "field.resolution=1 m")


@pytest.mark.parametrize(
    ("more", "own", "k0"),
    [
        ((), "", (0.35 / 0.65, 0.2 / 0.8)),
        (("soil.k0=0.8",), ", k0=1.3", (0.8, 1.3)),
        (("soil.k0=0.4",), "", (0.4, 0.4)),
    ],
)
def test_level_ground_of_two_layers_rests_under_its_overburden(more, own, k0):
    """``s_yy = -sum gamma_k thickness_k`` and ``s_xx = s_zz = K_0 s_yy``, ``nu / (1 - nu)``, of a particle's layer."""
    soil = 'unit_weight="25 kN/m^3", poisson_ratio=0.2, young_modulus="300 MPa"'
    model = model_of(small_scene(f'layer=[{{name="heavy", top="2 m", {soil}{own}}}]', "numerics.cell=1 m", *more))
    level = Surface(np.array([0.0, 6.0]), np.array([4.0, 4.0]))
    interface = Surface(np.array([0.0, 6.0]), np.array([2.0, 2.0]))
    ground = in_situ_state(model._replace(surface=level, interfaces=(interface,)))
    is_heavy = ground.y < 2.0
    np.testing.assert_array_equal(ground.material, is_heavy)
    weight = np.where(is_heavy, 2.0 * 20e3 + 25e3 * (2.0 - ground.y), 20e3 * (4.0 - ground.y))
    np.testing.assert_allclose(ground.stress_yy, -weight, atol=1e-3 * weight.max())
    expected = -np.where(is_heavy, k0[1], k0[0]) * weight
    np.testing.assert_allclose(ground.stress_xx, expected, atol=1e-3 * weight.max())
    np.testing.assert_allclose(ground.stress_zz, expected, atol=1e-3 * weight.max())
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


@pytest.fixture(scope="module")
def layered_campaign(tmp_path_factory):
    """Two realizations of sand over undrained clay, in cells of 2 m."""
    directory = tmp_path_factory.mktemp("layered")
    clay = 'layer=[{name="clay", top="8 m", law="tresca", cohesion={mean="25 kPa"}, field="own"}]'
    return directory, *run(directory, small_scene("campaign.realizations=2", "field.resolution=1 m", clay))


def test_the_dataset_names_the_layers_and_tells_where_they_are(layered_campaign):
    directory, ground, _ = layered_campaign
    data = open_results(directory)
    assert data["layer"].values.tolist() == ["soil", "clay"]
    np.testing.assert_array_equal(data["particle_layer"] == 1, data["particle_y"] < 8.0)
    is_clay = data["particle_layer"].values == 1
    released = ground.released(0)
    assert (released.friction_angle[is_clay] == 0.0).all()
    assert (released.friction_angle[~is_clay] > 0.0).all()


def test_a_replay_is_the_same_and_shows_the_layers(layered_campaign, capsys):
    directory, ground, _ = layered_campaign
    path = replay(directory, 1)
    assert "is the recorded one, bit for bit" in capsys.readouterr().out
    with h5py.File(path) as file:
        np.testing.assert_array_equal(file["VTKHDF/PointData/layer"], ground.lattice.material)


def test_the_soil_of_a_layered_realization_is_drawn_where_it_is_random(layered_campaign):
    """And correlated within layers: cohesion and friction angle of the sand alone, by -0.5 in the long run."""
    _, ground, records = layered_campaign
    slide = slide_of(ground, records[1], ())
    drawn = strengths(section_of(ground.scene, [5.0]), ground, slide)
    assert "Grey: not random in that layer" in drawn.caption
    is_sand = ground.lattice.material == 0
    pairs = [slide.soil[name][is_sand] for name in ("cohesion", "friction_angle")]
    assert f"are correlated by {np.corrcoef(*pairs)[0, 1]:.2f} within the layers" in drawn.caption
