"""The mesh must see the slope, the scheme be stable, and the times follow each other."""

from campaign.scene.ground_surface import surface_through
from campaign.scene.rules.measures import Points
from campaign.scene.rules.rule import Rules
from solver.method import Basis, StressUpdate
from solver.timestep import largest_courant

LEAST_CELLS_OF_HEIGHT = 4

RULES = Rules()


@RULES.on("numerics.cell", "geometry.slope.height")
def _cells_of_height(cell: float, height: float) -> str | None:
    if cell * LEAST_CELLS_OF_HEIGHT > height:
        return (
            f"a slope of {height:g} m must be at least {LEAST_CELLS_OF_HEIGHT} cells high; "
            f"use at most {height / LEAST_CELLS_OF_HEIGHT:g} m"
        )
    return None


@RULES.on("numerics.cell", "geometry.surface")
def _cells_of_surface(cell: float, surface: Points | None) -> str | None:
    if surface is None:
        return None
    return _cells_of_height(cell, surface_through(surface).height)


@RULES.on("numerics.courant", "numerics.basis", "numerics.stress_update")
def _stable_step(courant: float, basis: Basis, stress_update: StressUpdate) -> str | None:
    largest = largest_courant(basis, stress_update)
    if largest == 0.0:
        return (
            f'the basis "{basis}" with the stress update "{stress_update}" is unstable at every Courant number as '
            'particles cross cells; use the basis "gimp" or the stress update "musl"'
        )
    if courant > largest:
        return (
            f'the basis "{basis}" with the stress update "{stress_update}" creates energy beyond {largest:g}; '
            "use at most that"
        )
    return None


@RULES.on("numerics.locking", "numerics.basis")
def _cell_average_of_wide_basis(locking: str, basis: str) -> str | None:
    if locking == "cell-average" and basis == "bspline":
        return (
            'the domain of a "bspline" particle spans two cells, and averaged over both the ground is too weak; '
            'use the basis "gimp"'
        )
    return None


@RULES.on("numerics.particles_per_cell", "numerics.gravity")
def _ground_that_rests(particles_per_cell: int, gravity: str) -> str | None:
    if particles_per_cell == 1 and gravity == "release":
        return (
            "a single particle in the middle of a cell feels no forces that alternate from node to node, so the ground "
            'never comes to rest under its own weight; use 4, or gravity = "ramp"'
        )
    return None


@RULES.on("numerics.output_interval", "numerics.end_time")
def _output_within_run(interval: float, end_time: float) -> str | None:
    if interval > end_time:
        return f"the run ends at {end_time:g} s; use at most that"
    return None


@RULES.on("numerics.ramp_time", "numerics.end_time", "numerics.gravity")
def _ramp_within_run(ramp_time: float, end_time: float, gravity: str) -> str | None:
    if gravity == "ramp" and ramp_time >= end_time:
        return f"the run ends at {end_time:g} s, before gravity is whole; shorten the ramp or run longer"
    return None
