"""Several materials in one ground: each particle obeys its own law, and the same law twice is one law."""

import numpy as np
import pytest
from pointwise import law_of
from small_slope import small_model, with_strength

from solver._jit import kernel
from solver.filling import ground_of
from solver.in_situ import in_situ_state
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.march import march_to_rest
from solver.materials import Material, deformed, mobilised_strength
from solver.overburden import overburden
from solver.particles import Particles, allocate_particles, assign_material
from solver.softening import Softening
from solver.surface import Surface

MODEL = small_model()
INTERFACE = Surface(np.array([0.0, 15.0]), np.array([2.6, 0.3]))  # cuts the slope and crops out below its toe
TWICE = MODEL._replace(materials=MODEL.materials * 2, interfaces=(INTERFACE,))
FIELDS = [name for name in Particles._fields if name != "material"]


def test_a_ground_of_the_same_material_twice_slides_as_a_ground_of_one():
    """Pieces of blocks end elsewhere, so sums may be fused otherwise: the same to round-off, grown over a second."""
    times = np.linspace(0.0, 1.0, 11)
    one, two = (march_to_rest(model, with_strength(in_situ_state(model)), times) for model in (MODEL, TWICE))
    assert set(two.particles.material) == {0, 1}
    assert one.max_displacement[-1] > 0.5
    for name in FIELDS:
        expected = getattr(one.particles, name)
        np.testing.assert_allclose(getattr(two.particles, name), expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())


@kernel
def update(particles, increment, laws, dt):
    """Deform the particles (n,) by an increment (4, n), one by one; return the work of their stresses."""
    work = 0.0
    for p in range(particles.x.size):
        one = Particles(
            particles.x[p], particles.y[p], particles.velocity_x[p], particles.velocity_y[p], particles.mass[p],
            particles.volume[p], particles.stress_xx[p], particles.stress_yy[p], particles.stress_zz[p],
            particles.stress_xy[p], particles.plastic_strain[p], particles.cohesion[p], particles.friction_angle[p],
            particles.cohesion_residual[p], particles.friction_angle_residual[p], particles.pore_area[p],
            particles.pore_pressure[p], float(particles.material[p]),
        )  # fmt: skip
        l_p = increment[0, p], increment[1, p], increment[2, p], increment[3, p]
        new = deformed(one, l_p, laws, dt)
        particles.stress_xx[p], particles.stress_yy[p], particles.stress_zz[p] = (
            new.stress_xx,
            new.stress_yy,
            new.stress_zz,
        )
        particles.stress_xy[p], particles.plastic_strain[p] = new.stress_xy, new.plastic_strain
        particles.volume[p] = new.volume
        work += new.work
    return work


def stressed_particles(n, rng):
    """Return particles of which a strain increment lets some yield, and the increment (4, n)."""
    particles = allocate_particles(rng.uniform(size=n), rng.uniform(size=n), 0.05, 2000.0)
    for name in ("stress_xx", "stress_yy", "stress_zz", "stress_xy"):
        getattr(particles, name)[:] = rng.normal(-2e4, 2e4, n)
    particles.cohesion[:] = rng.uniform(5e3, 4e4, n)
    particles.friction_angle[:] = rng.uniform(0.1, 0.6, n)
    return particles, rng.normal(0.0, 5e-4, (4, n))


@pytest.mark.parametrize("names", [("mohr-coulomb", "tresca"), ("tresca", "drucker-prager", "mohr-coulomb")])
def test_each_particle_obeys_the_law_of_its_material(names):
    """As in separate runs of the particles of each material, and the work of the stresses is the sum of theirs."""
    rng = np.random.default_rng(41)
    laws = tuple(law_of(name, psi=4.0 * k, rate=2.0) for k, name in enumerate(names))
    particles, increment = stressed_particles(100, rng)
    particles.material[:] = rng.integers(0, len(laws), 100)
    before = [array.copy() for array in particles]
    work = update(particles, increment, laws, 1.0)
    works = []
    for number, law in enumerate(laws):
        is_here = particles.material == number
        alone = Particles(*(array[is_here] for array in before))
        works.append(update(alone, np.ascontiguousarray(increment[:, is_here]), (law,), 1.0))
        assert np.any(alone.plastic_strain > 0.0)
        for name in FIELDS:
            expected = getattr(alone, name)
            np.testing.assert_allclose(
                getattr(particles, name)[is_here], expected, rtol=0.0, atol=1e-14 * np.abs(expected).max()
            )
    assert work == pytest.approx(sum(works), rel=1e-12)


def test_density_weight_and_wave_speed_come_from_the_materials():
    heavy = MODEL.materials[0]._replace(density=2500.0)
    stiff = Material(2000.0, 0.3, mohr_coulomb(Constants(20e6, 0.3, 0.0, Softening(0.0, is_linear=False))))
    model = MODEL._replace(materials=(heavy, stiff), interfaces=(INTERFACE,))
    ground = ground_of(model)
    np.testing.assert_array_equal(ground.material, ground.y < INTERFACE.height_at(ground.x))
    np.testing.assert_allclose(ground.mass / ground.volume, np.where(ground.material == 0, 2500.0, 2000.0))
    assert model.wave_speed == stiff.wave_speed == pytest.approx(2.0 * MODEL.wave_speed)
    assert heavy.unit_weight == pytest.approx(2500.0 * 9.81)


def test_the_weight_above_is_that_of_the_layers():
    """``sum gamma thickness``: 1 m of one soil over another, and no weight of a layer that has cropped out."""
    level = Surface(np.array([0.0, 10.0]), np.array([4.0, 4.0]))
    tops = Surface(np.array([0.0, 10.0]), np.array([3.0, 5.0]))
    heavy = MODEL.materials[0]._replace(density=2500.0)
    model = MODEL._replace(surface=level, materials=(MODEL.materials[0], heavy), interfaces=(tops,))
    found = overburden(model, np.array([0.0, 0.0, 0.0, 9.0]), np.array([3.5, 3.0, 1.0, 1.0]))
    np.testing.assert_allclose(found, 9.81 * np.array([1000.0, 2000.0, 7000.0, 7500.0]))


def test_mobilised_strength_softens_by_the_material():
    particles = allocate_particles(np.zeros(2), np.zeros(2), 1.0, 2000.0)
    assign_material(particles, np.array([False, True]), 1, 2500.0)
    particles.plastic_strain[:] = 0.5
    particles.cohesion[:], particles.cohesion_residual[:] = 20e3, 10e3
    particles.friction_angle[:], particles.friction_angle_residual[:] = 0.4, 0.2
    materials = tuple(Material(2000.0, 0.3, law_of("mohr-coulomb", rate=rate, is_linear=True)) for rate in (0.0, 1.0))
    cohesion, friction_angle = mobilised_strength(particles, materials)
    np.testing.assert_allclose(cohesion, [20e3, 15e3])
    np.testing.assert_allclose(friction_angle, [0.4, 0.3])
