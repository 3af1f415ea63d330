"""Mass and momentum of soil that yields, softens and tumbles through the grid, to round-off.

No force acts from outside, so both components of the momentum stay what they were, whatever the law, the scheme, the
cure of locking and the share of PIC do; the nodes hold the mass and the momentum of the particles at every step.
"""

import numpy as np
import pytest
from driver import Row, grid_without_walls, lattice

from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.method import Method
from solver.particles import allocate_particles
from solver.scheme import STRESS_UPDATES, scheme_of
from solver.softening import Softening
from solver.step import advance, allocate_workspace

DENSITY, SIDE, SPACE, CELL = 2000.0, 4.0, 12.0, 0.5  # kg/m3, m
SOIL = mohr_coulomb(Constants(10e6, 0.3, np.radians(5.0), Softening(5.0, is_linear=False)))
CASES = [
    (update, locking, flip) for update in STRESS_UPDATES for locking in ("none", "cell-average") for flip in (1.0, 0.95)
]


def tumbling_block():
    """Return a block of random strength that turns, shears and flies, much faster than its strength can bear."""
    x, y = lattice(SIDE, SIDE, 0.5 * CELL)
    block = allocate_particles(x + 3.1, y + 3.3, 0.25 * CELL**2, DENSITY)
    rng = np.random.default_rng(4)
    block.cohesion[:] = rng.uniform(5e3, 20e3, x.size)
    block.friction_angle[:] = rng.uniform(0.1, 0.6, x.size)
    block.cohesion_residual[:] = 2e3
    block.friction_angle_residual[:] = np.radians(5.0)
    block.velocity_x[:] = 1.0 - 3.0 * (y - 0.5 * SIDE)
    block.velocity_y[:] = 0.7 + 2.0 * (x - 0.5 * SIDE)
    return block


def largest_drift(stress_update, locking, flip):
    """Return drifts of mass (nodes to particles) and momentum, over the sum of their magnitudes, after 400 steps."""
    block, grid = tumbling_block(), grid_without_walls(SPACE, SPACE, CELL)
    mass, size = block.mass.sum(), np.sum(block.mass * np.hypot(block.velocity_x, block.velocity_y))
    before = np.array([block.mass @ block.velocity_x, block.mass @ block.velocity_y])
    scheme = scheme_of(Method(stress_update=stress_update, flip_fraction=flip, locking=locking))
    steps = advance(block, grid, allocate_workspace(block.x.size), (SOIL,), scheme, 0.0, 0.0, 1e-3, 400)
    assert steps == 400
    assert np.median(block.plastic_strain) > 0.1
    after = np.array([block.mass @ block.velocity_x, block.mass @ block.velocity_y])
    on_nodes = np.abs(grid.momentum.sum(axis=(0, 2)) - after).max()
    return abs(grid.mass.sum() / mass - 1.0), max(np.abs(after - before).max(), on_nodes) / size


@pytest.mark.parametrize(("stress_update", "locking", "flip"), CASES)
def test_mass_and_momentum_are_conserved_to_round_off(stress_update, locking, flip):
    assert max(largest_drift(stress_update, locking, flip)) < 1e-12


def rows():
    drifts = np.max([largest_drift(*case) for case in CASES], axis=0)
    return [
        Row(
            f"Tumbling soil, 400 steps, worst of {len(CASES)} schemes: {name}",
            "1e-12",
            "",
            f"{drift:.0e}",
            drift < 1e-12,
        )
        for name, drift in zip(("mass", "momentum"), drifts, strict=True)
    ]
