"""A slope of a few hundred particles that slides within seconds of simulated time."""

import numpy as np

from solver.filling import fill_ground
from solver.march import run
from solver.model import Model, make_soil
from solver.step import STRESS_UPDATES, Scheme
from solver.surface import slope_surface

COHESION, FRICTION_ANGLE = 4e3, np.radians(8.0)


def small_model(height=3.0, plain=9.0, residual=1e3, courant=0.5, ramp_time=0.0, stress_update="musl"):
    """Return a 45 degree slope in soft soil; with these strengths it fails at once."""
    return Model(
        surface=slope_surface(height, np.radians(45.0), 3.0, plain, 1.0),
        density=2000.0,
        poisson_ratio=0.3,
        soil=make_soil(5e6, 0.3, 0.0, residual, np.radians(4.0), 2.0, False),
        cell_size=0.5,
        particles_per_cell=4,
        half_length=0.25,
        scheme=Scheme(STRESS_UPDATES[stress_update], 1.0, 0.0),
        courant=courant,
        ramp_time=ramp_time,
    )


def with_strength(particles, cohesion=COHESION, friction_angle=FRICTION_ANGLE):
    """Return the particles with one strength everywhere."""
    return particles._replace(
        cohesion=np.full(particles.x.size, cohesion), friction_angle=np.full(particles.x.size, friction_angle)
    )


def fails_from(place):
    """Return whether the march breaks off if a particle lies at ``place`` (m). A process of its own can import this."""
    model = small_model(residual=2e3)
    bad = with_strength(fill_ground(model.surface, model.cell_size, model.particles_per_cell, model.density))
    bad.x[57] = place
    return run(model, bad, np.linspace(0.0, 1.0, 11)).has_failed
