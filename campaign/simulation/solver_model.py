"""The solver's view of a scene."""

import math
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

from campaign.scene.ground_surface import surface_of
from campaign.scene.ground_water import water_of
from campaign.scene.layers import interfaces_of, layer_scenes
from campaign.scene.scene import Scene
from campaign.scene.softening import softening_rate
from solver.constants import STANDARD_GRAVITY
from solver.grid import whole_cells
from solver.laws.registry import NO_CUTOFF, Constants, make_law
from solver.materials import Material
from solver.method import Method
from solver.model import Model
from solver.slide import SlideCriteria
from solver.softening import Softening

Array = NDArray[np.float64]

CUT_OFF = "mohr-coulomb-tension"
"""The law of soil with a cut-off of tension."""


def model_of(scene: Scene) -> Model:
    """Return the solver's view of a scene."""
    numerics, slide = scene.numerics, scene.slide
    return Model(
        surface=surface_of(scene.geometry),
        materials=tuple(material_of(layer) for layer in layer_scenes(scene)),
        cell_size=numerics.cell,
        particles_per_cell=numerics.particles_per_cell,
        courant=numerics.courant,
        method=Method(numerics.basis, numerics.stress_update, numerics.locking, numerics.flip),
        internal_length=scene.soil.softening.internal_length or 0.0,
        ramp_time=numerics.ramp_time if numerics.gravity == "ramp" else 0.0,
        criteria=SlideCriteria(slide.displaced, slide.failed, scene.front_area, slide.front),
        interfaces=interfaces_of(scene),
        filling=numerics.filling,
        water=water_of(scene),
    )


def material_of(scene: Scene) -> Material:
    """Return what the [soil] of a scene is made of."""
    soil = scene.soil
    softening = Softening(softening_rate(scene), soil.softening.law == "linear")
    cutoff = NO_CUTOFF if soil.tension_cutoff is None else soil.tension_cutoff
    constants = Constants(soil.young_modulus, soil.poisson_ratio, soil.dilation_angle, softening, cutoff)
    saturated = None if soil.saturated_unit_weight is None else soil.saturated_unit_weight / STANDARD_GRAVITY
    law = make_law(soil.law if soil.tension_cutoff is None else CUT_OFF, constants)
    return Material(soil.unit_weight / STANDARD_GRAVITY, soil.poisson_ratio, law, saturated, soil.k0)


def output_times(end_time: float, interval: float) -> Array:
    """Return the times 0, `interval`, ... and `end_time`, in s, so that 0.3 is found as 0.3 and not beside it."""
    step = Decimal(repr(float(interval)))
    times = [float(k * step) for k in range(math.ceil(end_time / interval - 1e-9))]
    return np.array([*times, end_time])


def column_edges(model: Model) -> Array:
    """Return the edges in m of the columns, one cell wide, of the deposit surface."""
    return model.cell_size * np.arange(whole_cells(model.surface.width, model.cell_size) + 1.0)
