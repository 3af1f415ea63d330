"""What defines a simulation besides the strength of its particles."""

import math
from typing import NamedTuple

from solver.constants import STANDARD_GRAVITY
from solver.elastic import bulk_modulus, p_wave_speed, shear_modulus
from solver.grid import Grid, allocate_grid
from solver.internal_length import smoothing_weights
from solver.mohr_coulomb import Soil
from solver.slide import PAPER, Slide
from solver.step import Scheme
from solver.surface import Surface

HEADROOM_IN_CELLS = 2  # space above the highest ground


class Model(NamedTuple):
    """Geometry, soil and numerics of one scene, in SI units."""

    surface: Surface
    density: float  # kg/m3
    poisson_ratio: float
    soil: Soil
    cell_size: float  # m
    particles_per_cell: int
    half_length: float  # of a particle's basis functions, over the cell size
    scheme: Scheme
    courant: float
    ramp_time: float  # s over which gravity grows with plasticity active; 0 releases a loaded slope at once
    slide: Slide = PAPER  # what counts as a slide

    @property
    def unit_weight(self) -> float:
        """Weight of a volume in N/m3."""
        return self.density * STANDARD_GRAVITY

    @property
    def wave_speed(self) -> float:
        """P-wave speed in m/s."""
        return p_wave_speed(self.soil.bulk_modulus, self.soil.shear_modulus, self.density)

    def allocate_grid(self) -> Grid:
        """Return an empty grid for the scene."""
        height = self.surface.top + HEADROOM_IN_CELLS * self.cell_size
        smoothing = smoothing_weights(self.soil.internal_length, self.cell_size, self.half_length)
        return allocate_grid(self.surface.width, height, self.cell_size, self.half_length, smoothing)


def make_soil(
    young_modulus: float,
    poisson_ratio: float,
    dilation_angle: float,
    cohesion_residual: float,
    friction_residual: float,
    softening_rate: float,
    softening_is_linear: bool,
    internal_length: float = 0.0,
) -> Soil:
    """Return the shared soil properties from engineering constants (Pa, rad and m)."""
    return Soil(
        bulk_modulus(young_modulus, poisson_ratio),
        shear_modulus(young_modulus, poisson_ratio),
        math.sin(dilation_angle),
        cohesion_residual,
        friction_residual,
        softening_rate,
        softening_is_linear,
        internal_length,
    )
