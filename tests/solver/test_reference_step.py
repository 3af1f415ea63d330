"""One step of the fused kernels is one step of the plain reference, whatever the method."""

import itertools

import numpy as np
import pytest
from reference_step import StepChoices, reference_step
from small_slope import small_model, with_strength

from solver.constants import STANDARD_GRAVITY
from solver.in_situ import in_situ_state
from solver.laws.registry import update_stress
from solver.march import March
from solver.method import Method
from solver.operations import GRAVITY_WORK, INTERNAL_WORK
from solver.particles import copy_particles
from solver.scheme import STRESS_UPDATES, scheme_of
from solver.softening import Strength
from solver.step import advance, allocate_workspace
from solver.water import NO_WATER, Water

MODEL = small_model()
MID_SLIDE = 0.6  # s
DT = 2e-3  # s
LAKE = 2.2  # m, of standing water, above the toe and below the crest
INTERNAL_LENGTH = 2.0  # m: four cells, of which pooling and the band supply 2.4
TOLERANCE = 1e-12  # of the largest magnitude of a field
BASES = ("linear", "gimp", "bspline")


@pytest.fixture(scope="module")
def mid_slide():
    """Return the slope while it slides, yields and softens, with a strength and a dilation of its own everywhere."""
    start = with_strength(in_situ_state(MODEL))
    rng = np.random.default_rng(11)
    start.cohesion[:] *= rng.uniform(0.7, 1.3, start.x.size)
    start.friction_angle[:] *= rng.uniform(0.7, 1.3, start.x.size)
    start.cohesion_residual[:] *= rng.uniform(0.7, 1.3, start.x.size)
    start.friction_angle_residual[:] *= rng.uniform(0.7, 1.3, start.x.size)
    march = March(MODEL, start)
    assert march.advance_to(MID_SLIDE) is None
    assert np.hypot(march.particles.velocity_x, march.particles.velocity_y).max() > 1.0
    assert np.mean(march.particles.plastic_strain > 0.01) > 0.2
    return march.particles


def model_with(basis, step, internal_length, start):
    """Return the slope's model with this basis and way to take a step, and with water if ``start`` has any."""
    method = Method(basis, step.stress_update, "cell-average" if step.has_cell_averages else "none", step.flip_fraction)
    water = Water(ratio=0.5, level=LAKE) if start.pore_pressure.any() else NO_WATER
    return MODEL._replace(method=method, internal_length=internal_length, water=water)


def fused_step(start, basis, step, gravity, rate, steps=1):
    """Return particles, nodes and energy ledger after one call of ``advance``."""
    particles, work = copy_particles(start), allocate_workspace(start.x.size)
    model = model_with(basis, step, INTERNAL_LENGTH if step.has_internal_length else 0.0, start)
    grid, scheme = model.allocate_grid(), scheme_of(model.method, step.damping, step.has_internal_length)
    assert advance(particles, grid, work, model.laws, scheme, gravity, rate, DT, steps) == steps
    return particles, grid, work.ledger


def plain_step(start, basis, step, gravity, rate):
    law = MODEL.laws[0]

    def point_law(p, stress, strain, plastic_strain):
        strength = Strength(*(getattr(start, name)[p] for name in Strength._fields))
        return update_stress(law, stress, strain, plastic_strain, strength, DT)

    grid = model_with(basis, step, INTERNAL_LENGTH, start).allocate_grid()
    return reference_step(start, grid, point_law, step, gravity, rate, DT)


def by_node(field):
    """Return a vector field ``(rows, 2, columns)`` as ``(nodes, 2)``."""
    return np.moveaxis(field, 1, 2).reshape(-1, 2)


def deviation(found, expected):
    """Return the largest difference over the largest magnitude; absolute where nothing but 0 is expected."""
    return np.abs(found - expected).max() / (np.abs(expected).max() or 1.0)


def largest_deviation(start, basis, method, gravity=STANDARD_GRAVITY, rate=0.0):
    """Return the largest deviation of any quantity of a step, over its largest magnitude; NaN if there is one."""
    particles, grid, ledger = fused_step(start, basis, method, gravity, rate)
    plain = plain_step(start, basis, method, gravity, rate)
    mass = plain.mass[:, None]
    pairs = [
        *zip(particles, plain.particles, strict=True),
        (grid.mass.ravel(), plain.nodes.mass),
        (by_node(grid.momentum), plain.nodes.momentum),
        (by_node(grid.force), plain.nodes.force),
        (mass * by_node(grid.velocity), mass * plain.velocity),  # by mass: a nearly empty node moves nothing
        (mass * by_node(grid.acceleration), mass * plain.acceleration),
        (ledger[INTERNAL_WORK], plain.work_of_stresses),
        (ledger[GRAVITY_WORK], plain.work_of_gravity),
    ]
    return np.max([deviation(found, expected) for found, expected in pairs])


METHODS = [
    StepChoices(u, 1.0, 0.0, c, n) for u, c, n in itertools.product(STRESS_UPDATES, (False, True), (False, True))
]
IDS = [f"{method.stress_update}-{method.has_cell_averages}-{method.has_internal_length}" for method in METHODS]


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("method", METHODS, ids=IDS)
def test_a_step_is_that_of_the_box(mid_slide, basis, method):
    assert largest_deviation(mid_slide, basis, method) < TOLERANCE


@pytest.mark.parametrize("method", METHODS, ids=IDS)
def test_a_step_of_wet_ground_is_that_of_the_box(mid_slide, method):
    rng = np.random.default_rng(12)
    ratio, pressure = rng.uniform(0.0, 0.5, mid_slide.x.size), rng.uniform(0.0, 2e4, mid_slide.x.size)
    wet = mid_slide._replace(pore_area=ratio * mid_slide.volume, pore_pressure=pressure)
    assert largest_deviation(wet, "gimp", method) < TOLERANCE


@pytest.mark.parametrize("method", METHODS, ids=IDS)
def test_steps_that_follow_each_other_are_those_of_the_box(mid_slide, method):
    """What a step leaves in nodes and cells is nothing that the next one counts again; round-off grows a little."""
    found, steps = fused_step(mid_slide, "gimp", method, STANDARD_GRAVITY, 0.0, steps=4)[0], mid_slide
    for _ in range(4):
        steps = plain_step(steps, "gimp", method, STANDARD_GRAVITY, 0.0).particles
    assert max(deviation(*pair) for pair in zip(found, steps, strict=True)) < 10.0 * TOLERANCE


@pytest.mark.parametrize("stress_update", STRESS_UPDATES)
def test_sorting_particles_on_the_way_changes_nothing(mid_slide, stress_update):
    """Ten calls of ``advance`` sort ten times, one of as many steps twice; round-off grows by the step."""
    method, calls = StepChoices(stress_update, 1.0, 0.0, True, True), mid_slide
    found = fused_step(mid_slide, "gimp", method, STANDARD_GRAVITY, 0.0, steps=130)[0]
    for _ in range(10):
        calls = fused_step(calls, "gimp", method, STANDARD_GRAVITY, 0.0, steps=13)[0]
    assert max(deviation(*pair) for pair in zip(found, calls, strict=True)) < 1e-9


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("stress_update", STRESS_UPDATES)
def test_a_damped_step_with_a_share_of_pic_while_gravity_grows(mid_slide, basis, stress_update):
    method = StepChoices(stress_update, 0.9, 0.7, True, True)
    assert largest_deviation(mid_slide, basis, method, gravity=4.0, rate=3.0) < TOLERANCE


def test_the_step_under_test_yields_and_weakens_and_smooths(mid_slide):
    """Each part of the reference changes the result by far more than the tolerance, or it would test nothing."""
    plain = StepChoices("musl")
    base = plain_step(mid_slide, "gimp", plain, STANDARD_GRAVITY, 0.0).particles
    assert np.mean(base.plastic_strain > mid_slide.plastic_strain) > 0.2
    for change in (
        {"has_cell_averages": True},
        {"has_internal_length": True},
        {"flip_fraction": 0.9},
        {"damping": 0.7},
    ):
        other = plain_step(mid_slide, "gimp", plain._replace(**change), STANDARD_GRAVITY, 0.0).particles
        changed = ("velocity_x", "stress_xx", "plastic_strain")
        largest = max(deviation(getattr(other, name), getattr(base, name)) for name in changed)
        assert largest > 1e-6
