"""The unbalanced force of nodes, and what particles feel of it."""

import numpy as np
import pytest
from parts_of_a_step import begin
from reference_step import StepChoices, solve, spread, weights_at
from small_slope import small_model

from solver.balance import felt_share, unbalanced_share
from solver.constants import STANDARD_GRAVITY
from solver.filling import ground_of
from solver.in_situ import lay_geostatic_stress
from solver.step import allocate_workspace

MODEL = small_model()


def test_particles_feel_the_acceleration_of_their_nodes():
    """``||m_p sum_i S_ip a_i|| / ||m_p g||``, with the weights and nodes of the step in plain NumPy."""
    ground = ground_of(MODEL)
    lay_geostatic_stress(ground, MODEL)
    grid = MODEL.allocate_grid()
    tiles = begin(ground, grid, allocate_workspace(ground.x.size), MODEL.scheme)
    choices = StepChoices("musl")
    acceleration, _ = solve(spread(ground, grid, choices, STANDARD_GRAVITY), grid, choices, STANDARD_GRAVITY, 1e-3)
    felt = ground.mass[:, None] * (weights_at(ground, grid).s.T @ acceleration)
    expected = np.linalg.norm(felt) / np.linalg.norm(ground.mass * STANDARD_GRAVITY)
    assert felt_share(tiles, grid, STANDARD_GRAVITY) == pytest.approx(expected, rel=1e-12)
    assert expected > 0.01


def test_ground_free_of_stress_feels_all_of_its_weight_but_for_what_its_base_holds():
    """In free fall every particle feels gravity; nodes on the base do not fall, and nor do particles among them."""
    ground = ground_of(MODEL)
    grid = MODEL.allocate_grid()
    tiles = begin(ground, grid, allocate_workspace(ground.x.size), MODEL.scheme)
    assert felt_share(tiles, grid, STANDARD_GRAVITY) < 1.0
    grid.free_y[:] = 1.0
    assert felt_share(tiles, grid, STANDARD_GRAVITY) == pytest.approx(1.0, rel=1e-12)
    assert unbalanced_share(grid, STANDARD_GRAVITY) == pytest.approx(1.0, rel=1e-12)
    assert felt_share(tiles, grid, 0.0) == 0.0
