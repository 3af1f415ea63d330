"""A free elastic block that breathes while it flies across the grid: the ledgers of energy and momentum.

Twelve cells a side, four particles a cell, nu = 0.35, a strain of one percent, carried at 5 % of the wave speed for
the time a wave takes over eighty cells. Errors of energy are over the energy of the vibration.
"""

import numpy as np
import pytest
from driver import SCHEMES, Row, elastic_soil, grid_without_walls, lattice

from solver import observables
from solver.elastic import p_wave_speed
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

SIDE, SPACE, DENSITY, STRAIN = 12.0, 22.0, 1.0, 0.01  # cells of 1 m
SOIL = elastic_soil(100.0, 0.35)
SPEED = p_wave_speed(SOIL.bulk_modulus, SOIL.shear_modulus, DENSITY)
DURATION = 80.0 / SPEED


def breathe(scheme, courant):
    """Return relative error of energy and change of momentum (over the block's) at the end."""
    x, y = lattice(SIDE, SIDE, 0.5)
    block = allocate_particles(x + 3.0, y + 3.0, 0.25, DENSITY)
    amplitude = STRAIN * SPEED
    block.velocity_x[:] = amplitude * np.sin(np.pi * (x / SIDE - 0.5))
    block.velocity_y[:] = amplitude * np.sin(np.pi * (y / SIDE - 0.5))
    vibration = observables.kinetic_energy(block)
    for velocity in (block.velocity_x, block.velocity_y):
        velocity += 0.05 * SPEED
    initial, momentum = observables.kinetic_energy(block), np.sum(block.mass * block.velocity_x)
    grid, work = grid_without_walls(SPACE, SPACE, 1.0), allocate_workspace(x.size)
    steps = int(np.ceil(DURATION * SPEED / courant))
    advance(block, grid, work, (SOIL,), scheme, 0.0, 0.0, DURATION / steps, steps)
    energy = observables.kinetic_energy(block) + work.ledger[0]
    drift = np.abs([np.sum(block.mass * v) / momentum - 1.0 for v in (block.velocity_x, block.velocity_y)]).max()
    return (energy - initial) / vibration, drift


@pytest.mark.parametrize("scheme", SCHEMES)
def test_momentum_is_conserved_to_round_off(scheme):
    assert breathe(SCHEMES[scheme], 0.5)[1] < 1e-12


@pytest.mark.parametrize("courant", [0.2, 0.5])
def test_musl_and_usf_conserve_energy(courant):
    for name in ("musl", "usf"):
        assert breathe(SCHEMES[name], courant)[0] == pytest.approx(0.0, abs=0.05)


def test_usl_dissipates_a_third_of_the_vibration_and_then_explodes():
    assert -0.5 < breathe(SCHEMES["usl"], 0.2)[0] < -0.2
    assert not breathe(SCHEMES["usl"], 0.8)[0] < 1.0


def rows():
    table = []
    for name, scheme in SCHEMES.items():
        for courant in (0.2, 0.5, 0.8):
            energy_error, drift = breathe(scheme, courant)
            table.append(
                Row(
                    f"Breathing free block, {name.upper()}, Courant {courant}",
                    "momentum 1e-12, energy within 5 %",
                    f"momentum {drift:.0e}",
                    f"energy {energy_error:+.1%}",
                    drift < 1e-12 and abs(energy_error) < 0.05,
                )
            )
    return table
