"""Water that stands above the ground, as a lake over the toe of a slope: Archimedes' lift of what is below its level.

The pressure of standing water, ``gamma_w (z - y)``, acts on the surface of the ground and in its pores alike. Stresses
and pore pressures of particles are in excess of it, so that the surface stays free, and what is left of it is its
gradient: each particle loses the weight of the water that it displaces. A particle that crosses the level is submerged
by the share of its domain below. Waves, and the drag of water on ground that moves through it, are left out.
"""

from solver._jit import inlined
from solver.water import DENSITY, GRAVITY, LEVEL, LIGHTENING


@inlined
def displaced_mass(particles, grid):
    """Return the mass in kg/m of the standing water in the place of particles."""
    share = (grid.lake[LEVEL] - particles.y) * (0.5 / (grid.half_length * grid.cell_size)) + 0.5
    return grid.lake[DENSITY] * particles.volume * min(max(share, 0.0), 1.0)


@inlined
def uplift_of(y, overburden, grid):
    """Return the weight in Pa of the standing water in the place of the ground above elevations ``y`` (m).

    That ground is as thick as its weight says, ``overburden`` in Pa, and counts up to the level of the lake.
    """
    depth = max(grid.lake[LEVEL] - y, 0.0)
    return min(grid.lake[LIGHTENING] * overburden, (grid.lake[DENSITY] * grid.lake[GRAVITY]) * depth)
