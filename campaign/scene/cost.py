"""What a campaign will cost in time and memory, from its scene alone."""

from math import ceil

from campaign.scene import Scene
from campaign.scene.ground_surface import surface_of
from campaign.scene.inputs import inputs_of
from campaign.scene.sections import Soil
from solver.constants import STANDARD_GRAVITY
from solver.elastic import bulk_modulus, p_wave_speed, shear_modulus
from solver.timestep import stable_step

PARTICLE_STEPS = 25e6
"""Particle-steps a second on an ordinary core, as the benchmark in tests/benchmarks counts them."""

CELL_AVERAGE_COST = 1.4
"""Of a step with cell averages against locking, relative to one without."""

INTERNAL_LENGTH_COST = 1.15
"""Of a step with averaged plastic strain, relative to one without."""

HALF_CELL_COST = 8
"""Of a realization with half the cell, relative to one: four times the particles, twice the steps."""

PARTICLE_BYTES = 1000
"""Of memory a particle takes while a realization runs: 750 measured with the grid under it, and room for records."""

SERIES, RECEPTOR_SERIES = 6, 1
"""Numbers of a record that there are at every time, and those of a receptor, in double precision."""

SUMMARY_BYTES = 2000
"""Of a record's single numbers and the coarse map of its field; a byte a particle says whether it has moved."""

RANK_BYTES = 300e6
"""Of memory a rank takes without any particle, for Python and its libraries."""


def core_seconds(scene: Scene) -> float:
    """Return the estimated CPU time of the whole campaign [s]; at most, since slides rest before the end."""
    repeated = HALF_CELL_COST * pairs(scene) + with_more_of_an_input(scene)
    return realization_seconds(scene) * (scene.campaign.realizations + repeated)


def pairs(scene: Scene) -> int:
    """Return how many slides are repeated with half the cell, at most."""
    return min(scene.campaign.discretisation_pairs, scene.campaign.realizations)


def with_more_of_an_input(scene: Scene) -> int:
    """Return how many slides are repeated with one input changed, if so many slide."""
    return len(inputs_of(scene)) * min(scene.campaign.sensitivity_pairs, scene.campaign.realizations)


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


def step_count(scene: Scene) -> int:
    """Return the approximate number of time steps until the end; every output interval takes whole steps."""
    return output_count(scene) * ceil(scene.numerics.output_interval / time_step(scene))


def output_count(scene: Scene) -> int:
    """Return the number of output intervals until the end."""
    return ceil(scene.numerics.end_time / scene.numerics.output_interval)


def time_step(scene: Scene) -> float:
    """Return the longest stable time step of ground at rest [s]; waves are fastest in the stiffest layer."""
    fastest = max(_wave_speed(soil) for soil in scene.soils)
    return stable_step(scene.numerics.courant, scene.numerics.cell, fastest, 0.0)


def _wave_speed(soil: Soil) -> float:
    constants = soil.young_modulus, soil.poisson_ratio
    return p_wave_speed(bulk_modulus(*constants), shear_modulus(*constants), soil.unit_weight / STANDARD_GRAVITY)


def rank_bytes(scene: Scene) -> float:
    """Return the memory that a rank takes [bytes], without its random field."""
    return RANK_BYTES + PARTICLE_BYTES * particle_count(scene)


def dataset_bytes(scene: Scene) -> float:
    """Return the size of the results [bytes], all of which rank 0 holds when it writes them."""
    return float(scene.campaign.realizations * record_bytes(scene))


def record_bytes(scene: Scene) -> int:
    """Return the size of one record [bytes], roughly."""
    columns = ceil(surface_of(scene.geometry).width / scene.numerics.cell)
    series = SERIES + RECEPTOR_SERIES * len(scene.receptor)
    return 8 * (series * (1 + output_count(scene)) + columns) + SUMMARY_BYTES + particle_count(scene)
