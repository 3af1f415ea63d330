"""What a campaign will cost, from its scene alone."""

from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.terminal import duration
from solver.constants import STANDARD_GRAVITY
from solver.elastic import bulk_modulus, p_wave_speed, shear_modulus
from solver.timestep import stable_step

PARTICLE_STEPS = 10e6
"""Particle-steps a second on an ordinary core, as the benchmark in tests/benchmarks counts them."""

CELL_AVERAGE_COST = 1.6
"""Of a step with cell averages against locking, relative to one without."""

INTERNAL_LENGTH_COST = 1.25
"""Of a step with averaged plastic strain, relative to one without."""

HALF_CELL_COST = 8
"""Of a realization with half the cell, relative to one: four times the particles, twice the steps."""


def cost(scene: Scene) -> str:
    """Return the estimated size and time of a scene's campaign; at most, since slides rest before the end."""
    particles, steps = particle_count(scene), step_count(scene)
    seconds = realization_seconds(scene)
    wanted = scene.campaign
    total = seconds * (wanted.realizations + HALF_CELL_COST * wanted.discretisation_pairs)
    return (
        f"about {particles:,} particles and {steps:,.0f} steps: at most {duration(seconds)} a realization and "
        f"{total / 3600:.1f} core-hours for all {wanted.realizations}, with {wanted.discretisation_pairs} repeated at "
        f"half the cell, at {speed(scene) / 1e6:.2g} million particle-steps a second"
    )


def realization_seconds(scene: Scene) -> float:
    """Return the estimated CPU time of a realization that moves until the end [s]."""
    return particle_count(scene) * step_count(scene) / speed(scene)


def speed(scene: Scene) -> float:
    """Return the expected particle-steps a second of the scene's method."""
    locking = CELL_AVERAGE_COST if scene.numerics.locking == "cell-average" else 1.0
    softening = INTERNAL_LENGTH_COST if scene.soil.softening.internal_length is not None else 1.0
    return PARTICLE_STEPS / (locking * softening)


def particle_count(scene: Scene) -> int:
    """Return the approximate number of particles: the area of the ground over that of a particle."""
    return round(surface_of(scene.geometry).area / scene.numerics.cell**2 * scene.numerics.particles_per_cell)


def step_count(scene: Scene) -> float:
    """Return the approximate number of time steps until the end."""
    return scene.numerics.end_time / time_step(scene)


def time_step(scene: Scene) -> float:
    """Return the time step of ground at rest [s]."""
    constants = scene.soil.young_modulus, scene.soil.poisson_ratio
    density = scene.soil.unit_weight / STANDARD_GRAVITY
    wave_speed = p_wave_speed(bulk_modulus(*constants), shear_modulus(*constants), density)
    return stable_step(scene.numerics.courant, scene.numerics.cell, wave_speed, 0.0)
