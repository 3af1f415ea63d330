"""What a campaign will cost, from its scene alone."""

import math

from campaign.durations import duration
from campaign.scene import Geometry, Scene
from solver.constants import STANDARD_GRAVITY
from solver.elastic import bulk_modulus, p_wave_speed, shear_modulus
from solver.timestep import stable_step

PARTICLE_STEPS = 10e6
"""Particle-steps a second on an ordinary core, as measured by the benchmark in tests/benchmarks."""

HALF_CELL_COST = 8
"""Of a realization with half the cell, relative to one: four times the particles, twice the steps."""


def cost(scene: Scene) -> str:
    """Return the estimated size and time of a scene's campaign; at most, since slides rest before the end."""
    particles = particle_count(scene)
    steps = scene.numerics.end_time / time_step(scene)
    seconds = realization_seconds(scene)
    wanted = scene.campaign
    total = seconds * (wanted.realizations + HALF_CELL_COST * wanted.discretisation_pairs)
    return (
        f"about {particles:,} particles and {steps:,.0f} steps: at most {duration(seconds)} a realization and "
        f"{total / 3600:.1f} core-hours for all {wanted.realizations}, with {wanted.discretisation_pairs} repeated at "
        f"half the cell, at {PARTICLE_STEPS / 1e6:g} million particle-steps a second"
    )


def realization_seconds(scene: Scene) -> float:
    """Return the estimated CPU time of a realization that moves until the end [s]."""
    return particle_count(scene) * scene.numerics.end_time / time_step(scene) / PARTICLE_STEPS


def particle_count(scene: Scene) -> int:
    """Return the approximate number of particles: the area of the ground over that of a particle."""
    return round(_area(scene.geometry) / scene.numerics.cell**2 * scene.numerics.particles_per_cell)


def time_step(scene: Scene) -> float:
    """Return the time step of ground at rest [s]."""
    constants = scene.soil.young_modulus, scene.soil.poisson_ratio
    density = scene.soil.unit_weight / STANDARD_GRAVITY
    speed = p_wave_speed(bulk_modulus(*constants), shear_modulus(*constants), density)
    return stable_step(scene.numerics.courant, scene.numerics.cell, speed, 0.0)


def _area(geometry: Geometry) -> float:
    if geometry.surface is not None:
        points = zip(geometry.surface, geometry.surface[1:], strict=False)
        return sum((x2 - x1) * (z1 + z2) / 2 for (x1, z1), (x2, z2) in points)
    slope = geometry.slope
    assert slope is not None
    run = slope.height / math.tan(slope.angle)
    return slope.foundation * (slope.crest + run + slope.plain) + slope.height * (slope.crest + run / 2)
