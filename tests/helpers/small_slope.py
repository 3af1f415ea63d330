"""A slope of a few hundred particles that slides within seconds of simulated time."""

import numpy as np

from solver.filling import ground_of
from solver.laws.mohr_coulomb import mohr_coulomb
from solver.laws.registry import Constants
from solver.march import march_to_rest
from solver.materials import Material
from solver.method import Method
from solver.model import Model
from solver.softening import Softening
from solver.surface import slope_surface

COHESION, FRICTION_ANGLE = 4e3, np.radians(8.0)
RESIDUAL_COHESION, RESIDUAL_FRICTION_ANGLE = 1e3, np.radians(4.0)


def small_model(height=3.0, plain=9.0, courant=0.5, ramp_time=0.0, stress_update="musl"):
    """Return a 45 degree slope in soft soil; with these strengths it fails at once."""
    law = mohr_coulomb(Constants(5e6, 0.3, 0.0, Softening(2.0, is_linear=False)))
    return Model(
        surface=slope_surface(height, np.radians(45.0), 3.0, plain, 1.0),
        materials=(Material(2000.0, 0.3, law),),
        cell_size=0.5,
        particles_per_cell=4,
        method=Method(stress_update=stress_update),
        courant=courant,
        ramp_time=ramp_time,
    )


def with_strength(particles, cohesion=COHESION, friction_angle=FRICTION_ANGLE, residual=RESIDUAL_COHESION):
    """Return the particles with one strength everywhere; ``cohesion`` softens to ``residual`` (Pa)."""
    strengths = {
        "cohesion": cohesion,
        "friction_angle": friction_angle,
        "cohesion_residual": residual,
        "friction_angle_residual": RESIDUAL_FRICTION_ANGLE,
    }
    return particles._replace(**{name: np.full(particles.x.size, value) for name, value in strengths.items()})


def fails_from(place):
    """Return whether the march breaks off if a particle lies at ``place`` (m). A process of its own can import this."""
    model = small_model()
    bad = with_strength(ground_of(model), residual=2e3)
    bad.x[57] = place
    return march_to_rest(model, bad, np.linspace(0.0, 1.0, 11)).has_failed
