"""Two elastic discs collide head-on and rebound (Sulsky, Chen and Schreyer 1994).

Radius 0.2 m, E = 1000 Pa, nu = 0.3, rho = 1000 kg/m3, velocities +-(0.1, 0.1) m/s: a tenth of the wave speed, so part
of the kinetic energy stays in the discs as vibration. The grid feels contact early: particles share a node up to a
distance of ``2 (h + l_p)`` along each axis, which leaves a gap of ``2 h`` between their edges.
"""

import numpy as np
import pytest
from driver import SCHEMES, Row, elastic_soil, grid_without_walls, lattice

from solver import observables
from solver.elastic import p_wave_speed
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

DENSITY, RADIUS, SPEED = 1000.0, 0.2, 0.1  # kg/m3, m, m/s along each axis
SOIL = elastic_soil(1000.0, 0.3)
WAVE_SPEED = p_wave_speed(SOIL.bulk_modulus, SOIL.shear_modulus, DENSITY)
LADDER = (0.1, 0.05, 0.025)  # m
END = 3.0  # s


def collide(cell, scheme):
    """Return rebound speed, kinetic and total energy (over initial), momentum (over a disc's) and gap at contact."""
    x, y = lattice(2.0, 2.0, cell / 2.0)
    left, right = (np.hypot(x - centre, y - centre) < RADIUS for centre in (0.7, 1.3))
    discs = allocate_particles(x[left | right], y[left | right], cell**2 / 4.0, DENSITY)
    of_left = discs.x < 1.0
    discs.velocity_x[:] = discs.velocity_y[:] = np.where(of_left, SPEED, -SPEED)
    grid, work = grid_without_walls(2.0, 2.0, cell), allocate_workspace(discs.x.size)
    initial, dt = observables.kinetic_energy(discs), 0.3 * cell / (WAVE_SPEED + SPEED * np.sqrt(2.0))
    gap = np.nan
    for step in range(int(END / dt)):
        advance(discs, grid, work, SOIL, scheme, 0.0, 0.0, dt, 1)
        if np.isnan(gap) and observables.kinetic_energy(discs) < 0.9999 * initial:
            gap = np.sqrt(2.0) * (0.6 - 2.0 * SPEED * (step + 1) * dt) - 2.0 * RADIUS
    disc_mass = discs.mass[of_left].sum()
    momentum = np.sum(discs.mass * discs.velocity_x) / (disc_mass * SPEED)
    rebound = -np.sum((discs.mass * discs.velocity_x)[of_left]) / (disc_mass * SPEED)
    kinetic = observables.kinetic_energy(discs) / initial
    return rebound, kinetic, kinetic + work.ledger[0] / initial, momentum, gap


@pytest.mark.parametrize("scheme", SCHEMES)
def test_momentum_of_both_discs_stays_zero(scheme):
    assert abs(collide(0.05, SCHEMES[scheme])[3]) < 1e-12


def test_musl_keeps_the_energy_of_the_collision():
    assert collide(0.05, SCHEMES["musl"])[2] == pytest.approx(1.0, abs=0.01)


def test_update_stress_last_loses_six_percent_of_it():
    assert 0.9 < collide(0.05, SCHEMES["usl"])[2] < 0.97


def test_rebound_grows_towards_the_speed_of_approach_as_the_grid_is_refined():
    rebounds = [collide(cell, SCHEMES["musl"])[0] for cell in LADDER]
    assert np.all(np.diff(rebounds) > 0.0)
    assert 0.92 < rebounds[-1] < 1.0


def test_contact_is_felt_at_most_two_cells_early_along_each_axis():
    for cell in LADDER[:2]:
        assert 0.0 < collide(cell, SCHEMES["musl"])[4] < 2.0 * np.sqrt(2.0) * cell


def rows():
    table = []
    for name, cell in (("musl", 0.05), ("musl", 0.025), ("usl", 0.05), ("usf", 0.05)):
        rebound, kinetic, energy, momentum, gap = collide(cell, SCHEMES[name])
        table.append(
            Row(
                f"Two discs, {2 * RADIUS / cell:.0f} cells across, {name.upper()}",
                "kinetic energy 97 %, contact within 1 h, momentum 0",
                f"rebound {rebound:.3f}, kinetic energy {kinetic:.1%}, contact at {gap / cell:.1f} h, momentum "
                f"{abs(momentum):.0e}",
                f"total energy {energy - 1.0:+.2%}",
            )
        )
    return table
