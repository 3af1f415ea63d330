"""The solver's view of a scene."""

import numpy as np
from numpy.typing import NDArray

from campaign.scene.ground_surface import surface_of
from campaign.scene.scene import Scene
from solver.basis import half_length_in_cells
from solver.constants import STANDARD_GRAVITY
from solver.grid import whole_cells
from solver.internal_length import coarse_rate_factor
from solver.model import Model, make_soil
from solver.slide import Slide
from solver.step import LOCKING, STRESS_UPDATES, Scheme

Array = NDArray[np.float64]


def model_of(scene: Scene) -> Model:
    """Return the solver's view of a scene."""
    soil, numerics = scene.soil, scene.numerics
    half_length = half_length_in_cells(numerics.basis, numerics.particles_per_cell)
    internal_length = soil.softening.internal_length or 0.0
    rate = soil.softening.rate_at(numerics.cell)
    return Model(
        surface=surface_of(scene.geometry),
        density=soil.unit_weight / STANDARD_GRAVITY,
        poisson_ratio=soil.poisson_ratio,
        soil=make_soil(
            soil.young_modulus,
            soil.poisson_ratio,
            soil.dilation_angle,
            soil.cohesion.residual,
            soil.friction_angle.residual,
            rate * coarse_rate_factor(internal_length, numerics.cell, half_length),
            soil.softening.law == "linear",
            internal_length,
        ),
        cell_size=numerics.cell,
        particles_per_cell=numerics.particles_per_cell,
        half_length=half_length,
        scheme=Scheme(STRESS_UPDATES[numerics.stress_update], numerics.flip, 0.0, LOCKING[numerics.locking]),
        courant=numerics.courant,
        ramp_time=numerics.ramp_time if numerics.gravity == "ramp" else 0.0,
        slide=Slide(scene.slide.displaced, scene.slide.failed, scene.slide.front_area),
    )


def output_times(end_time: float, interval: float) -> Array:
    """Return the times 0, `interval`, ... and `end_time`, in s."""
    times = interval * np.arange(np.ceil(end_time / interval - 1e-9))
    return np.append(times, end_time)


def column_edges(model: Model) -> Array:
    """Return the edges in m of the columns, one cell wide, of the deposit surface."""
    return model.cell_size * np.arange(whole_cells(model.surface.width, model.cell_size) + 1.0)
