"""The boundaries of the stability atlas, each against theory."""

import law_cases
import numpy as np
import pytest
import space
import spectrum
import time_step
from bodies import BASES, crossing_bar, displacement_error, flying_block, still_block
from driver import SCHEMES

from solver.timestep import LARGEST_COURANT

ALLOWED = {pair: largest for pair, largest in LARGEST_COURANT.items() if largest > 0.0}


@pytest.mark.parametrize(("pair", "courant"), ALLOWED.items())
def test_the_largest_courant_number_of_a_scene_is_safe(pair, courant):
    """No tenth of the vibration energy is created with crossing, and nothing explodes in place."""
    assert flying_block(*pair, courant) < 0.1
    assert crossing_bar(*pair, courant) < 0.1
    assert all(still_block(*pair, courant, offset) < time_step.EXPLODED for offset in time_step.OFFSETS)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("particles_per_cell", [9, 16])
def test_it_is_safe_with_more_particles_in_a_cell(particles_per_cell, scheme):
    """uGIMP domains shrink with their number, and in place update-stress-last loses its stability sooner."""
    courant = LARGEST_COURANT["gimp", scheme]
    assert flying_block("gimp", scheme, courant, particles_per_cell) < 0.1
    for offset in time_step.OFFSETS:
        gained = still_block("gimp", scheme, courant, offset, particles_per_cell=particles_per_cell)
        assert gained < time_step.EXPLODED


@pytest.mark.parametrize("courant", [0.1, 0.3, 0.6])
def test_linear_mpm_with_usl_has_no_safe_step(courant):
    assert not flying_block("linear", "usl", courant) < 1.0


@pytest.mark.parametrize("place", [0.5, 0.2, 0.05, 0.01])
def test_the_limit_of_one_linear_particle_vanishes_at_the_node(place):
    measured, expected = time_step.limit_of_particle(place)
    assert measured == pytest.approx(expected, abs=0.003)


@pytest.mark.parametrize("pair", [("gimp", "usl"), ("gimp", "musl"), ("linear", "musl"), ("bspline", "usl")])
def test_the_step_in_place_has_the_limit_of_the_linearised_one(pair):
    """To 5 % and the resolution of the search."""
    measured = time_step.limit_of_block(*pair)
    assert not spectrum.is_unstable(*pair, 0.95 * measured - 0.01)
    assert spectrum.is_unstable(*pair, 1.05 * measured + 0.01)


def test_linear_mpm_does_not_converge_where_particles_cross_cells():
    assert displacement_error("linear", 25) > 2.0 * displacement_error("linear", 12)
    assert displacement_error("gimp", 25) < 0.03


@pytest.mark.parametrize("basis", BASES)
def test_one_particle_in_the_middle_of_a_cell_does_not_feel_a_chessboard(basis):
    assert law_cases.chessboard_felt(basis, 0.5) == pytest.approx(0.0, abs=1e-12)


def test_one_of_four_particles_feels_a_quarter_of_it():
    """Weights 3/4 and 1/4 in each direction: (3/4 - 1/4)^2."""
    assert law_cases.chessboard_felt("gimp", 0.25) == pytest.approx(0.25)


@pytest.mark.parametrize("basis", BASES)
def test_a_stretched_row_breaks_when_the_supports_no_longer_meet(basis):
    np.testing.assert_allclose(space.fracture(basis), space.expected_fracture(basis), atol=0.03)


@pytest.mark.parametrize("basis", BASES)
def test_a_strip_is_flagged_before_its_nodes_tear_it(basis):
    """At twice its length, as soil has cracked by then."""
    assert space.stretch_flagged(basis) == pytest.approx(2.0, abs=0.05)
    assert space.expected_fracture(basis)[0] >= 2.0


def test_local_softening_depends_on_the_mesh_unless_the_rate_is_scaled():
    """Twice the cell, twice the slip: 2 without scaling (within 10 %: the band is not exactly a cell), 1 with it."""
    assert space.mesh_dependence(is_scaled=False) == pytest.approx(2.0, rel=0.1)
    assert space.mesh_dependence(is_scaled=True) == pytest.approx(1.0, rel=0.05)


@pytest.mark.parametrize("basis", BASES)
def test_pic_is_a_viscosity(basis):
    assert law_cases.pic_constant(basis) == pytest.approx(law_cases.expected_pic_constant(basis), rel=0.02)


@pytest.mark.parametrize("steps", [200, 2000])
def test_first_order_spin_grows_as_predicted(steps):
    assert law_cases.first_order_growth(steps) == pytest.approx(np.exp(8.0 * np.pi**2 / steps), rel=1e-3)
    assert law_cases.cayley_growth(steps) == pytest.approx(1.0, abs=1e-11)


def test_squared_exponential_has_no_cholesky_factor_on_a_fine_grid():
    assert law_cases.has_cholesky_factor(0.3)
    assert not law_cases.has_cholesky_factor(0.15)


def test_chi_square_intervals_do_not_hold_where_bonetts_do():
    """False alarms: the standard error of a coverage from 2000 campaigns is 1 %, four of them are allowed."""
    chi_square, bonett = law_cases.coverages()
    assert chi_square == pytest.approx(0.74, abs=0.04)
    assert bonett > 0.88


@pytest.mark.slow
@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_energy_created_grows_with_the_courant_number_to_explosion(basis, scheme):
    """Twice the largest step a scene may have is worse than the step itself; 3 explodes with every scheme."""
    largest = max(LARGEST_COURANT[basis, scheme], 0.1)
    assert not flying_block(basis, scheme, 2.0 * largest) < flying_block(basis, scheme, largest)
    assert not flying_block(basis, scheme, 3.0) < 1.0
