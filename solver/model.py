"""What defines a simulation besides the strength of its particles."""

from typing import NamedTuple

from solver.domain import half_length_in_cells
from solver.grid import Grid, allocate_grid, particle_spacing
from solver.internal_length import smoothing_weights
from solver.laws.registry import Law
from solver.materials import Material
from solver.method import Filling, Method
from solver.scheme import AnyScheme, scheme_of
from solver.slide import PAPER, SlideCriteria
from solver.surface import Surface
from solver.water import NO_WATER, Water, lake_of

HEADROOM_IN_CELLS = 2  # space above the highest ground


class Model(NamedTuple):
    """Geometry, materials and numerics of one scene, in SI units."""

    surface: Surface
    materials: tuple[Material, ...]  # from the surface down
    cell_size: float  # m
    particles_per_cell: int
    courant: float
    method: Method = Method()
    internal_length: float = 0.0  # m over which plastic strain is averaged; 0: softening is local
    ramp_time: float = 0.0  # s over which gravity grows with plasticity active; 0 releases a loaded slope at once
    criteria: SlideCriteria = PAPER
    filling: Filling = "lattice"
    interfaces: tuple[Surface, ...] = ()  # the k-th is the top of the material k + 1
    water: Water = NO_WATER

    @property
    def laws(self) -> tuple[Law, ...]:
        """Parameters of the law of each material, as kernels take them."""
        return tuple(material.law for material in self.materials)

    @property
    def wave_speed(self) -> float:
        """P-wave speed in m/s, of the fastest material."""
        return max(material.wave_speed for material in self.materials)

    @property
    def slowest_period(self) -> float:
        """Longest period in s in which the ground swings on its base: a shear wave goes up and down twice."""
        return 4.0 * self.surface.top / min(material.shear_wave_speed for material in self.materials)

    @property
    def particle_spacing(self) -> float:
        """Distance in m between particles on their lattice."""
        return particle_spacing(self.cell_size, self.particles_per_cell)

    @property
    def half_length(self) -> float:
        """Half length of a particle's domain over the cell size."""
        return half_length_in_cells(self.method.basis, self.particles_per_cell)

    @property
    def scheme(self) -> AnyScheme:
        """The method as kernels take it, without damping."""
        return scheme_of(self.method, averages_plastic_strain=self.internal_length > 0.0)

    def allocate_grid(self) -> Grid:
        """Return an empty grid for the scene."""
        height = self.surface.top + HEADROOM_IN_CELLS * self.cell_size
        smoothing = smoothing_weights(self.internal_length, self.cell_size, self.half_length)
        has_water = self.water != NO_WATER
        lake = lake_of(self.water, max(each.density_under_water for each in self.materials))
        return allocate_grid(self.surface.width, height, self.cell_size, self.half_length, smoothing, has_water, lake)
