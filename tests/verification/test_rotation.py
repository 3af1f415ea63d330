"""Rigid rotation: of a stressed body by prescribed velocities, and of a free elastic disc.

A step takes the velocity gradient at the places of its start. Velocities ``v = Omega x r`` give no strain, but the
particles go along tangents and ``det(1 + L dt) = 1 + (Omega dt)^2``; velocities along the chords of a true rotation
keep the volume, but have the strain ``cos(Omega dt) - 1``. A turn in n steps costs an area strain of ``4 pi^2 / n``
in either case, by which a spinning body expands.
"""

import numpy as np
import pytest
from driver import (
    MUSL,
    UGIMP,
    Row,
    elastic_soil,
    grid_without_walls,
    lattice,
    node_indices,
    observed_orders,
    orders_row,
)
from parts_of_a_step import deform

from solver.elastic import p_wave_speed
from solver.particles import allocate_particles
from solver.sorting import fill_tiles, read_tiles
from solver.step import advance, allocate_workspace
from solver.tiles import MOVED_X, MOVED_Y, USED, X, Y

DENSITY, RADIUS, CENTRE = 1000.0, 0.5, 1.0  # kg/m3, m, m
SOIL = elastic_soil(1000.0, 0.3)
SPEED = p_wave_speed(SOIL.bulk_modulus, SOIL.shear_modulus, DENSITY)


def disc(cell):
    """Return a disc of radius 0.5 m in the middle of a square of 2 m, and a grid."""
    x, y = lattice(2.0 * CENTRE, 2.0 * CENTRE, cell / 2.0)
    inside = np.hypot(x - CENTRE, y - CENTRE) < RADIUS
    return (
        allocate_particles(x[inside], y[inside], cell**2 / 4.0, DENSITY),
        grid_without_walls(2.0 * CENTRE, 2.0 * CENTRE, cell, UGIMP),
    )


def turned_once(steps, along_chords):
    """Return the stressed disc after a turn by prescribed velocities, along chords or along tangents."""
    body, grid = disc(0.1)
    body.stress_xx[:], body.stress_yy[:], body.stress_xy[:] = -100.0, -250.0, 30.0
    i, j = node_indices(grid)
    x, y = 0.1 * i - CENTRE, 0.1 * j - CENTRE
    angle = 2.0 * np.pi / steps
    stretch, spin = (np.cos(angle) - 1.0, np.sin(angle)) if along_chords else (0.0, angle)
    velocity = np.stack([stretch * x - spin * y, spin * x + stretch * y], axis=1)  # dt = 1 s
    work = allocate_workspace(body.x.size)
    for _ in range(steps):
        tiles = fill_tiles(body, grid, work.tiles)
        grid.remapped[:] = velocity
        used = tiles.blocks[: tiles.counts[USED]]
        x_p, y_p = used[:, X] - CENTRE, used[:, Y] - CENTRE
        used[:, MOVED_X] = CENTRE + np.cos(angle) * x_p - np.sin(angle) * y_p
        used[:, MOVED_Y] = CENTRE + np.sin(angle) * x_p + np.cos(angle) * y_p
        assert deform(tiles, grid, work, (SOIL,), MUSL, 0.0, 1.0)
        read_tiles(tiles, body)
    return body


def test_a_turn_along_tangents_keeps_the_invariants_of_stress():
    body = turned_once(500, along_chords=False)
    np.testing.assert_allclose(body.stress_xx + body.stress_yy, -350.0, rtol=1e-10)
    np.testing.assert_allclose(np.hypot(body.stress_xx - body.stress_yy, 2.0 * body.stress_xy), 161.55494, rtol=1e-7)
    np.testing.assert_allclose(body.volume / 0.1**2 * 4.0 - 1.0, 4.0 * np.pi**2 / 500, rtol=0.05)


def test_a_turn_along_chords_keeps_the_volume_and_compresses_with_first_order():
    """``2 (K + G / 3) (cos - 1)`` a step in the in-plane mean stress."""
    body = turned_once(500, along_chords=True)
    np.testing.assert_allclose(body.volume, 0.1**2 / 4.0, rtol=1e-10)
    strain = 500 * (1.0 - np.cos(2.0 * np.pi / 500))
    pressure = 2.0 * (SOIL.bulk_modulus + SOIL.shear_modulus / 3.0) * strain
    np.testing.assert_allclose(0.5 * (body.stress_xx + body.stress_yy), -175.0 - pressure, rtol=1e-6)


def spin(cells, duration, courant=0.3):
    """Return relative change of angular momentum and area of a free disc after ``duration`` s at 0.1 rad/s."""
    cell = 1.0 / cells
    body, grid = disc(cell)
    body.velocity_x[:], body.velocity_y[:] = -0.1 * (body.y - CENTRE), 0.1 * (body.x - CENTRE)

    def angular_momentum():
        return np.sum(body.mass * ((body.x - CENTRE) * body.velocity_y - (body.y - CENTRE) * body.velocity_x))

    before, area = angular_momentum(), body.volume.sum()
    steps = int(np.ceil(duration * SPEED / (courant * cell)))
    work = allocate_workspace(body.x.size)
    assert advance(body, grid, work, (SOIL,), MUSL, 0.0, 0.0, duration / steps, steps) == steps
    return angular_momentum() / before - 1.0, body.volume.sum() / area - 1.0, steps


def test_a_free_disc_loses_less_than_two_percent_of_its_angular_momentum():
    """In the time a wave takes over 80 cells, at 12 cells across; lumping the mass matrix costs it."""
    assert -0.02 < spin(12, 80.0 / 12.0 / SPEED)[0] < 0.0


def test_loss_of_angular_momentum_falls_with_the_square_of_the_cell():
    losses = [spin(cells, 15.0)[0] for cells in (6, 12, 24)]
    assert observed_orders(losses).min() > 1.5


def test_a_free_disc_expands_by_four_pi_squared_over_the_steps_of_a_turn():
    _, growth, steps = spin(24, 2.0 * np.pi / 0.1, courant=0.6)
    assert growth == pytest.approx(4.0 * np.pi**2 / steps, rel=0.1)


def rows():
    body = turned_once(500, along_chords=False)
    drift = np.abs(body.stress_xx + body.stress_yy + 350.0).max() / 350.0
    loss = spin(12, 80.0 / 12.0 / SPEED)[0]
    losses = [spin(cells, 15.0)[0] for cells in (6, 12, 24)]
    _, growth, steps = spin(24, 2.0 * np.pi / 0.1, courant=0.6)
    expected_growth = 4.0 * np.pi**2 / steps
    return [
        Row(
            "Rotation of a stressed disc, one turn in 500 steps", "invariants 1e-10", "", f"{drift:.0e}", drift < 1e-10
        ),
        Row(
            "Spinning free disc, 12 cells, 80 h / c",
            "angular momentum within 2 %",
            "",
            f"{loss:+.2%}",
            abs(loss) < 0.02,
        ),
        orders_row("Spinning free disc, angular momentum", 2, 1.5, np.abs(losses), "24 cells across"),
        Row(
            f"Spinning free disc, area after a turn in n = {steps} steps",
            f"4 pi^2 / n = {expected_growth:+.2%} within a tenth",
            f"{growth:+.2%}",
            f"{growth / expected_growth - 1.0:+.0%} of it",
            abs(growth / expected_growth - 1.0) < 0.1,
        ),
    ]
