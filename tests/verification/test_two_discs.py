"""Two elastic discs collide head-on and rebound (Sulsky, Chen and Schreyer 1994).

Radius 0.2 m, E = 1000 Pa, nu = 0.3, rho = 1000 kg/m3, velocities +-(0.1, 0.1) m/s: an eighth of the wave speed, so a
sixth of the energy stays in the discs as vibration. Finite elements (``disc_on_wall``) tell how much: the discs rebound
with 0.907 of their speed and keep 91.4 % of their kinetic energy, not all of it.

The grid feels contact early. Along each axis two particles share a node for sure up to a distance of ``h + 2 l_p`` and
at most up to ``2 (h + l_p)``, which leaves gaps of ``h`` and ``2 h`` between the edges of their domains; along the
diagonal, on which the discs approach, gaps of ``sqrt(2) h`` to ``2 sqrt(2) h``. So the rebound has an error of first
order.
"""

import numpy as np
import pytest
from disc_on_wall import throw
from driver import SCHEMES, Row, elastic_soil, grid_without_walls, lattice, orders_row

from solver import observables
from solver.elastic import p_wave_speed
from solver.particles import allocate_particles
from solver.step import advance, allocate_workspace

DENSITY, RADIUS, SPEED = 1000.0, 0.2, 0.1  # kg/m3, m, m/s along each axis
SOIL = elastic_soil(1000.0, 0.3)
WAVE_SPEED = p_wave_speed(SOIL.bulk_modulus, SOIL.shear_modulus, DENSITY)
LADDER = (0.025, 0.0125, 0.00625)  # m: 16, 32, 64 cells across
END, APART = 4.0, 2.8  # s
SURE_GAP, LARGEST_GAP = np.sqrt(2.0), 2.0 * np.sqrt(2.0)  # cells


def collide(cell, scheme):
    """Return rebound speed, kinetic energy after and total energy (over initial), momentum (over a disc's), first gap.

    The kinetic energy is its mean over the vibrations after the discs have parted.
    """
    x, y = lattice(2.0, 2.0, cell / 2.0)
    left, right = (np.hypot(x - centre, y - centre) < RADIUS for centre in (0.7, 1.3))
    discs = allocate_particles(x[left | right], y[left | right], cell**2 / 4.0, DENSITY)
    of_left = discs.x < 1.0
    discs.velocity_x[:] = discs.velocity_y[:] = np.where(of_left, SPEED, -SPEED)
    grid, work = grid_without_walls(2.0, 2.0, cell), allocate_workspace(discs.x.size)
    initial, dt = observables.kinetic_energy(discs), 0.3 * cell / (WAVE_SPEED + SPEED * np.sqrt(2.0))
    kinetic = np.empty(int(END / dt))
    for step in range(kinetic.size):
        advance(discs, grid, work, (SOIL,), scheme, 0.0, 0.0, dt, 1)
        kinetic[step] = observables.kinetic_energy(discs) / initial
    disc_mass = discs.mass[of_left].sum()
    momentum = np.sum(discs.mass * discs.velocity_x) / (disc_mass * SPEED)
    rebound = -np.sum((discs.mass * discs.velocity_x)[of_left]) / (disc_mass * SPEED)
    felt = dt * (np.argmax(kinetic < 0.9999) + 1)
    gap = np.sqrt(2.0) * (0.6 - 2.0 * SPEED * felt) - 2.0 * RADIUS
    return rebound, kinetic[int(APART / dt) :].mean(), kinetic[-1] + work.ledger[0] / initial, momentum, gap


def rebound_and_kinetic_energy_of_finite_elements(rings=16):
    G = SOIL.shear_modulus
    return throw(rings, RADIUS, SPEED * np.sqrt(2.0), DENSITY, SOIL.bulk_modulus - 2.0 * G / 3.0, G, end=3.0)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_momentum_of_both_discs_stays_zero(scheme):
    assert abs(collide(0.05, SCHEMES[scheme])[3]) < 1e-12


def test_musl_keeps_the_energy_of_the_collision():
    assert collide(0.05, SCHEMES["musl"])[2] == pytest.approx(1.0, abs=0.01)


def test_update_stress_last_loses_six_percent_of_it():
    assert 0.9 < collide(0.05, SCHEMES["usl"])[2] < 0.97


def test_rebound_is_that_of_finite_elements():
    rebound, kinetic = rebound_and_kinetic_energy_of_finite_elements(rings=8)
    found = collide(LADDER[0], SCHEMES["musl"])
    assert found[0] == pytest.approx(rebound, rel=0.05)
    assert found[1] == pytest.approx(kinetic, rel=0.05)


@pytest.mark.slow
def test_rebound_converges_with_first_order():
    rebound, _ = rebound_and_kinetic_energy_of_finite_elements()
    errors = [collide(cell, SCHEMES["musl"])[0] / rebound - 1.0 for cell in LADDER[1:]]
    assert errors[1] < 0.015
    assert np.log2(errors[0] / errors[1]) > 0.8


def test_contact_is_felt_where_particles_come_to_share_nodes():
    for cell in (0.05, 0.025):
        assert SURE_GAP < collide(cell, SCHEMES["musl"])[4] / cell < LARGEST_GAP


def rows():
    exact = np.array(rebound_and_kinetic_energy_of_finite_elements())
    ladder = [collide(cell, SCHEMES["musl"]) for cell in LADDER]
    errors = np.array([found[:2] for found in ladder]) / exact - 1.0
    schemes = {name: collide(0.05, scheme) for name, scheme in SCHEMES.items()}
    gaps = [found[4] / cell for cell, found in zip(LADDER, ladder, strict=True)]
    return [
        orders_row(f"Two discs, rebound (finite elements: {exact[0]:.3f})", 1, 0.8, errors[:, 0], "64 cells across"),
        orders_row(f"Two discs, kinetic energy (f. e.: {exact[1]:.1%})", 1, 0.8, errors[:, 1], "64 cells across"),
        Row(
            "Two discs, gap at which contact is felt",
            f"{SURE_GAP:.1f} to {LARGEST_GAP:.1f} h, where particles share nodes",
            f"{', '.join(f'{gap:.1f}' for gap in gaps)} h at 16, 32, 64 cells across",
            "",
            all(SURE_GAP < gap < LARGEST_GAP for gap in gaps),
        ),
        *(
            Row(
                f"Two discs, 8 cells across, {name.upper()}",
                "energy within 1 %, momentum 0",
                f"momentum {abs(momentum):.0e}",
                f"energy {energy - 1.0:+.2%}",
                abs(energy - 1.0) < 0.01 and abs(momentum) < 1e-12,
            )
            for name, (_, _, energy, momentum, _) in schemes.items()
        ),
    ]
