"""Ground that slides down an incline: a block without ends, with slip in its lowest cells.

Gravity is tilted by ``theta``, the base is fixed, and rows of nodes move as one, so the ground is infinitely long. A
block of weight per area ``rho H g cos(theta)`` slides with

    a = g (sin(theta) - mu cos(theta)) / (1 + mu tan(psi)),  at rest where tan(theta) < mu

What ``mu`` is follows from the flow rule. Once stress is steady the strain increments are plastic, and simple shear has
none along the base. With the dilation angle ``psi`` their principal axes lie at ``45 degrees - psi / 2`` to the base,
and so do those of the stress (isotropy). With ``t = s sin(phi)`` on the yield surface, base stresses
``s_n = s - t sin(psi)`` and ``tau = t cos(psi)``,

    mu = sin(phi) cos(psi) / (1 - sin(phi) sin(psi))    (Davis 1968)

so without dilation ``mu = sin(phi)``, and an incline between ``arctan(sin(phi))`` and ``phi`` does not hold. (The base
is a Mohr-Coulomb plane, with ``tan(phi)``, only on the way there or with ``psi = phi``.) Dilation lifts the block by
``a tan(psi)``, hence the denominator.

Slip gathers in the lowest cell, whose nodes see weight and strength of the same height: ``a`` has no error of the order
of the cell, unless what lies above cannot yield. Then the nodes between have to keep up with the block, whose velocity
is ``u``. At four particles a cell theirs is the mean of ``u`` (half of the mass) and of the particles below, which got
``3/4`` and ``1/4`` of the nodes' own ``int a dt``:  ``u = (u + (9/16 + 1/16) int a dt) / 2``, so ``int a dt = 1.6 u``.
The lowest cell moves with 1.6 times the momentum it should have, an inertia of ``0.3 rho h`` too much:

    a_h = a (H - h / 2) / (H - 0.2 h)
"""

from typing import NamedTuple

import numpy as np
import pytest
from driver import MUSL, UGIMP, Row, grid_without_walls, lattice, march, node_indices, wrap_around
from parts_of_a_step import accelerate, begin, deform, solve

from solver.constants import STANDARD_GRAVITY
from solver.elastic import p_wave_speed
from solver.grid import SMALLEST_MASS, allocate_grid
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.particles import allocate_particles
from solver.softening import NO_SOFTENING
from solver.sorting import read_tiles
from solver.step import allocate_workspace

HEIGHT, DENSITY, YOUNG_MODULUS, POISSON_RATIO, COURANT = 1.0, 2000.0, 1e8, 0.3, 0.4
DURATION, STEADY = 0.5, 0.25  # s; stress is steady in the second half
PHI = np.radians(20.0)


class Incline(NamedTuple):
    """Angles in rad, and how many cells of the ground above its base are frictional; what is above does not yield."""

    slope: float
    dilation: float = 0.0
    weak_cells: float = np.inf

    @property
    def friction(self):
        """Ratio of shear to normal stress on the base in steady slip."""
        return np.sin(PHI) * np.cos(self.dilation) / (1.0 - np.sin(PHI) * np.sin(self.dilation))

    @property
    def acceleration(self):
        driving = np.sin(self.slope) - self.friction * np.cos(self.slope)
        return STANDARD_GRAVITY * driving / (1.0 + self.friction * np.tan(self.dilation))


def share_in_rows(sums, grid):
    """Give the nodes of a row their share by mass of its sum, in place."""
    mass = grid.mass[:, None]
    sums[:] = mass * (sums.sum(axis=2) / np.maximum(mass.sum(axis=2), SMALLEST_MASS))[:, :, None]


def slide(particles, grid, soil, gravity_x, gravity_y, dt, steps):
    """March the strip, periodic along the base; return the mean velocity of its upper half (steps,) in m/s."""
    work, upper = allocate_workspace(particles.x.size), particles.y > 0.5 * HEIGHT
    velocity = np.empty(steps)
    for step in range(steps):
        tiles = begin(particles, grid, work, MUSL)
        share_in_rows(grid.momentum, grid)
        share_in_rows(grid.force, grid)
        grid.force[:, 0] += gravity_x * grid.mass
        solve(grid, gravity_y, MUSL.damping, dt)
        assert accelerate(tiles, grid, work, MUSL, 0.0, dt)
        grid.remapped[:] *= grid.mass[:, None]
        share_in_rows(grid.remapped, grid)
        grid.remapped[:] /= np.maximum(grid.mass, SMALLEST_MASS)[:, None]
        wrap_around(tiles, grid.width)
        assert deform(tiles, grid, work, (soil,), MUSL, 0.0, dt)
        read_tiles(tiles, particles)
        velocity[step] = particles.velocity_x[upper].mean()
    return velocity


def ground(incline, cells, length):
    """Return cohesionless ground of ``length`` m with the at-rest stress of level ground, and soil and time step."""
    cell = HEIGHT / cells
    soil = mohr_coulomb(Constants(YOUNG_MODULUS, POISSON_RATIO, incline.dilation, NO_SOFTENING))
    x, y = lattice(length, HEIGHT, 0.5 * cell)
    particles = allocate_particles(x, y, 0.25 * cell**2, DENSITY)
    is_weak = y < incline.weak_cells * cell
    particles.cohesion[is_weak], particles.friction_angle[is_weak] = 0.0, PHI
    particles.stress_yy[:] = -DENSITY * STANDARD_GRAVITY * np.cos(incline.slope) * (HEIGHT - y)
    particles.stress_xx[:] = particles.stress_zz[:] = POISSON_RATIO / (1.0 - POISSON_RATIO) * particles.stress_yy
    speed = p_wave_speed(soil.bulk_modulus, soil.shear_modulus, DENSITY)
    return particles, soil, DURATION / int(np.ceil(DURATION * speed / (COURANT * cell)))


def velocity_of_infinite_slope(incline, cells):
    """Return times (s) and mean velocities (m/s) down the slope."""
    width = 2.0 * HEIGHT / cells
    particles, soil, dt = ground(incline, cells, width)
    grid = allocate_grid(width, 2.0 * HEIGHT, HEIGHT / cells, UGIMP)
    grid.free_x[:] = grid.free_y  # no side walls
    gravity = STANDARD_GRAVITY * np.sin(incline.slope), STANDARD_GRAVITY * np.cos(incline.slope)
    velocity = slide(particles, grid, soil, *gravity, dt, round(DURATION / dt))
    return dt * np.arange(1, velocity.size + 1), velocity


def velocity_of_block(incline, cells, length=4.0):
    """Return the same for a block with ends that rests on the base with its lowest, frictional cells."""
    block, soil, dt = ground(incline, cells, length)
    block.x[:] += 1.0
    grid = grid_without_walls(length + 2.0, 2.0 * HEIGHT, HEIGHT / cells)
    grid.free_x[:] = grid.free_y[:] = node_indices(grid)[1] > 0
    tilted = STANDARD_GRAVITY * np.sin(incline.slope), -STANDARD_GRAVITY * np.cos(incline.slope)
    gravity = tuple(np.full(block.x.size, component) for component in tilted)
    upper, times, velocities = block.y > 0.5 * HEIGHT, [], []

    def observe(t):
        times.append(t)
        velocities.append(block.velocity_x[upper].mean())

    march(block, grid, soil, MUSL, dt, round(DURATION / dt), lambda t: gravity, observe)
    return np.array(times), np.array(velocities)


def steady_acceleration(times, velocities):
    """Return the slope of the line through the velocities of the second half."""
    return np.polyfit(times[times > STEADY], velocities[times > STEADY], 1)[0]


@pytest.mark.parametrize("cells", [4, 8])
def test_a_block_slides_with_the_sine_of_the_friction_angle(cells):
    incline = Incline(np.radians(30.0))
    assert steady_acceleration(*velocity_of_infinite_slope(incline, cells)) == pytest.approx(
        incline.acceleration, rel=1e-3
    )


def test_an_incline_between_arctan_sin_phi_and_phi_does_not_hold():
    """With ``tan(phi)`` it would stay: 19.5 degrees under ground of 20."""
    incline = Incline(np.radians(19.5))
    assert steady_acceleration(*velocity_of_infinite_slope(incline, 8)) == pytest.approx(incline.acceleration, rel=0.02)


def test_ground_on_a_gentler_incline_stays():
    """It slips by 0.3 mm while the suddenly tilted gravity swings it, where the steeper one slides by 250 mm."""
    times, velocities = velocity_of_infinite_slope(Incline(np.radians(15.0)), 8)
    assert abs(velocities.sum() * times[0]) < 1e-3
    assert abs(steady_acceleration(times, velocities)) < 0.01


def test_a_strong_block_slides_on_a_weak_layer():
    incline = Incline(np.radians(30.0), weak_cells=2)
    assert steady_acceleration(*velocity_of_infinite_slope(incline, 8)) == pytest.approx(incline.acceleration, rel=2e-3)


def test_a_strong_block_on_a_single_weak_cell_has_too_much_inertia():
    incline, cells = Incline(np.radians(30.0), weak_cells=1), 4
    expected = incline.acceleration * (cells - 0.5) / (cells - 0.2)
    assert steady_acceleration(*velocity_of_infinite_slope(incline, cells)) == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize("dilation", [5.0, 20.0])
def test_dilation_adds_friction_and_inertia(dilation):
    incline = Incline(np.radians(30.0), np.radians(dilation))
    assert steady_acceleration(*velocity_of_infinite_slope(incline, 8)) == pytest.approx(incline.acceleration, rel=0.01)


def rows():
    steep = np.radians(30.0)
    cases = (
        ("Infinite slope of 30 degrees, phi = 20 degrees", Incline(steep), velocity_of_infinite_slope),
        ("Infinite slope of 19.5 degrees, phi = 20 degrees", Incline(np.radians(19.5)), velocity_of_infinite_slope),
        ("The same at 30 degrees with a dilation of 20", Incline(steep, PHI), velocity_of_infinite_slope),
        ("Strong ground on two weak cells, 30 degrees", Incline(steep, 0.0, 2), velocity_of_infinite_slope),
        ("Strong ground on one weak cell, 30 degrees", Incline(steep, 0.0, 1), velocity_of_infinite_slope),
        ("Strong block with ends on one weak cell, 30 degrees", Incline(steep, 0.0, 1), velocity_of_block),
    )
    table = []
    for name, incline, velocity in cases:
        found = np.array([steady_acceleration(*velocity(incline, cells)) for cells in (4, 8, 16)])
        error = found[-1] / incline.acceleration - 1.0
        table.append(
            Row(
                name,
                f"a = {incline.acceleration:.4f} m/s2 within 2 %",
                f"{', '.join(f'{a:.4f}' for a in found)} m/s2 with 4, 8, 16 cells",
                f"{error:+.2%}",
                abs(error) < 0.02,
            )
        )
    times, velocities = velocity_of_infinite_slope(Incline(np.radians(15.0)), 8)
    slip = velocities.sum() * times[0]
    table.append(
        Row(
            "Infinite slope of 15 degrees, phi = 20 degrees",
            "stays (less than 1 mm)",
            f"{1e3 * slip:.2f} mm",
            "",
            abs(slip) < 1e-3,
        )
    )
    return table
