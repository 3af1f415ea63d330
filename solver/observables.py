"""What is read off the particles: run-out, displacement, volume, energy, and the surface of the deposit."""

import numpy as np

from solver.grid import SMALLEST_MASS, Grid
from solver.particles import Particles
from solver.slide import SlideCriteria
from solver.surface import Surface


def displacement(particles: Particles, start: Particles) -> np.ndarray:
    """Return ``|x - x_start|`` in m, shape (n,)."""
    distance: np.ndarray = np.hypot(particles.x - start.x, particles.y - start.y)
    return distance


def is_displaced(particles: Particles, start: Particles, criteria: SlideCriteria) -> np.ndarray:
    """Return the mask (n,) of the particles that belong to the sliding mass."""
    moved: np.ndarray = displacement(particles, start) > criteria.displaced
    return moved


def slope_body(start: Particles, surface: Surface) -> np.ndarray:
    """Return the mask (n,) of the particles that lie upslope of the toe before the slide, however deep."""
    upslope: np.ndarray = start.x < surface.toe_x
    return upslope


def front(particles: Particles, start: Particles, surface: Surface, criteria: SlideCriteria) -> float:
    """Return the x in m of the front-most slid particle of the slope body, NaN if none has slid.

    Ground in front of the toe that is pushed or heaved does not count, only the material that comes over it.
    """
    slid = is_displaced(particles, start, criteria) & slope_body(start, surface)
    return float(particles.x[slid].max()) if slid.any() else np.nan


def mass_front(particles: Particles, start: Particles, surface: Surface, criteria: SlideCriteria) -> float:
    """Return the x in m of the place beyond which ``front_area`` of the slid slope body lies, NaN if less has slid.

    Areas are those before the slide, because grains that part gain volume. Between particles the area ahead is
    interpolated, so the measure changes continuously with the state.
    """
    slid = is_displaced(particles, start, criteria) & slope_body(start, surface)
    order = np.argsort(-particles.x[slid], kind="stable")
    x = particles.x[slid][order]
    area = start.volume[slid][order]
    ahead = np.cumsum(area) - 0.5 * area
    if x.size == 0 or ahead[-1] < criteria.front_area:
        return np.nan
    return float(np.interp(criteria.front_area, ahead, x))


def advance(place: float, toe_x: float) -> float:
    """Return how far in m a front at ``place`` has come beyond the initial toe: 0 behind it and where nothing slid."""
    return max(0.0, place - toe_x) if np.isfinite(place) else 0.0


def runout(particles: Particles, start: Particles, surface: Surface, criteria: SlideCriteria) -> float:
    """Return the advance in m of the front-most slid particle of the slope body beyond the initial toe (0 if none)."""
    return advance(front(particles, start, surface, criteria), surface.toe_x)


def runout_mass(particles: Particles, start: Particles, surface: Surface, criteria: SlideCriteria) -> float:
    """Return the advance in m of the mass front beyond the initial toe (0 if none)."""
    return advance(mass_front(particles, start, surface, criteria), surface.toe_x)


def base_contact(particles: Particles, start: Particles, cell_size: float, criteria: SlideCriteria) -> float:
    """Return the share of the sliding ground, by columns one cell wide, that slips along the fixed base (0 if none).

    The velocity is zero on the base, so ground of the lowest row of cells moves as far as a slope that has failed only
    where a slip surface lies in that row.
    """
    far = displacement(particles, start)
    column = np.floor(start.x / cell_size).astype(int)
    on_base = np.unique(column[(far > criteria.failed) & (start.y < cell_size)])
    sliding = np.unique(column[far > criteria.displaced])
    return on_base.size / sliding.size if sliding.size else 0.0


def sliding_volume(particles: Particles, start: Particles, criteria: SlideCriteria) -> float:
    """Return the area in m2 (m3 per metre run) that the displaced particles had before the slide."""
    return float(start.volume[is_displaced(particles, start, criteria)].sum())


def is_at_surface(start: Particles, spacing: float) -> np.ndarray:
    """Return the mask (n,) of the particles that are the highest of their column of the lattice, ``spacing`` m wide."""
    column = (start.x / spacing).astype(int)
    top = np.full(column.max() + 1, -np.inf)
    np.maximum.at(top, column, start.y)
    highest: np.ndarray = start.y == top[column]
    return highest


def moved_behind_crest(
    particles: Particles, start: Particles, surface: Surface, farther_than: float, spacing: float
) -> float:
    """Return how far behind the crest the ground surface has moved, in m (0 if nowhere).

    Parameters
    ----------
    particles, start : Particles
        Now and before the slide.
    surface : Surface
        Before the slide.
    farther_than : float
        Displacement in m from which on it counts.
    spacing : float
        Distance of particles on their lattice in m.
    """
    moved = (displacement(particles, start) > farther_than) & is_at_surface(start, spacing)
    return max(0.0, surface.crest_x - float(start.x[moved].min() - 0.5 * spacing)) if moved.any() else 0.0


def kinetic_energy(particles: Particles) -> float:
    """Return ``1/2 m v^2`` summed over the particles, in J/m."""
    return float(0.5 * np.sum(particles.mass * (particles.velocity_x**2 + particles.velocity_y**2)))


def resolved_kinetic_energy(grid: Grid) -> float:
    """Return the kinetic energy in J/m of the motion that the grid sees.

    FLIP particles also carry velocity differences inside a cell that no node sees. They move nothing and never die
    (the null space of the transfer; Gritton and Berzins 2017), so neither rest nor the energy of the slide is judged
    by them.
    """
    has_mass = grid.mass > SMALLEST_MASS
    squares = grid.free_x * grid.momentum[:, 0] ** 2 + grid.free_y * grid.momentum[:, 1] ** 2
    return float(0.5 * np.sum(squares[has_mass] / grid.mass[has_mass]))


def fastest(particles: Particles) -> float:
    """Return the largest speed in m/s."""
    return float(np.sqrt(np.max(particles.velocity_x**2 + particles.velocity_y**2)))


def deposit_surface(particles: Particles, half_length: float, edges: np.ndarray) -> np.ndarray:
    """Return the elevation in m of the ground above each column between ``edges`` (m): its area over its width.

    The area of a particle is spread over ``x_p +- half_length`` (m), so the surface conserves volume and does not jump
    as a particle crosses an edge. Material is assumed to rest on material: overhangs and voids are levelled.
    """
    left = particles.x - half_length
    order = np.argsort(left)
    left = left[order]
    volume = particles.volume[order]
    before = np.concatenate([[0.0], np.cumsum(volume)])
    moment = np.concatenate([[0.0], np.cumsum(volume * left)])
    passed = np.searchsorted(left + 2.0 * half_length, edges)
    begun = np.searchsorted(left, edges)
    partly = (edges * (before[begun] - before[passed]) - (moment[begun] - moment[passed])) / (2.0 * half_length)
    area: np.ndarray = np.diff(before[passed] + partly)
    return area / np.diff(edges)
