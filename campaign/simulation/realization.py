"""One realization: from a scene and an id to a record, without MPI and without files but those of the field sampler."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from campaign.errors import RefusalError
from campaign.fields.strengths import StrengthSampler, strength_sampler
from campaign.record import Record, Status, Value
from campaign.scene.scene import Scene
from campaign.scene.sections import Geometry
from campaign.simulation.detachment import CAME_APART, detached_volume
from solver import observables
from solver.basis import half_length_in_cells
from solver.constants import STANDARD_GRAVITY
from solver.filling import fill_ground
from solver.grid import whole_cells
from solver.in_situ import NotSettledError, in_situ_state
from solver.internal_length import coarse_rate_factor
from solver.march import History, March, Outcome, run
from solver.model import Model, make_soil
from solver.particles import Particles, copy_particles
from solver.slide import Slide
from solver.step import LOCKING, STRESS_UPDATES, Scheme
from solver.surface import Surface, slope_surface

Array = NDArray[np.float64]


class Interrupted(Exception):  # noqa: N818  -- not an error: the caller asked for it
    """The simulation was left at the caller's request."""


@dataclass(frozen=True)
class Setup:
    """What all realizations of a scene share.

    Parameters
    ----------
    scene : Scene
    model : solver.model.Model
    ground : Particles
        The particles on their lattice, where they read the random field.
    start : Particles
        The same particles when strength is released: at rest under gravity, or unloaded for a gravity ramp.
    coordinates : dict
        "time" (s), "x" (m, centres of the columns of the deposit surface), "particle_x" and "particle_z" (m).
    """

    scene: Scene
    model: Model
    ground: Particles
    start: Particles
    coordinates: dict[str, Array]

    @property
    def n_particles(self) -> int:
        """Number of particles."""
        return self.ground.x.size

    @property
    def toe_x(self) -> float:
        """Place of the initial toe in m."""
        return self.model.surface.toe[0]


def surface_of(geometry: Geometry) -> Surface:
    """Return the ground surface of a scene."""
    if geometry.slope is not None:
        slope = geometry.slope
        return slope_surface(slope.height, slope.angle, slope.crest, slope.plain, slope.foundation)
    points = np.array(geometry.surface, dtype=float)
    return Surface(points[:, 0].copy(), points[:, 1].copy())


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


def prepare(scene: Scene) -> Setup:
    """Compute what all realizations share, the in-situ state above all.

    Raises
    ------
    RefusalError
        If the ground does not come to rest under its own weight.
    """
    model = model_of(scene)
    ground = fill_ground(model.surface, model.cell_size, model.particles_per_cell, model.density)
    start = _loaded(model) if scene.numerics.gravity == "release" else copy_particles(ground)
    edges = column_edges(model)
    coordinates = {
        "time": output_times(scene.numerics.end_time, scene.numerics.output_interval),
        "x": 0.5 * (edges[1:] + edges[:-1]),
        "particle_x": ground.x,
        "particle_z": ground.y,
    }
    return Setup(scene, model, ground, start, coordinates)


def _loaded(model: Model) -> Particles:
    try:
        return in_situ_state(model)
    except NotSettledError as error:
        raise RefusalError(str(error)) from error


def output_times(end_time: float, interval: float) -> Array:
    """Return the times 0, `interval`, ... and `end_time`, in s."""
    times = interval * np.arange(np.ceil(end_time / interval - 1e-9))
    return np.append(times, end_time)


def column_edges(model: Model) -> Array:
    """Return the edges in m of the columns, one cell wide, of the deposit surface."""
    return model.cell_size * np.arange(whole_cells(model.surface.width, model.cell_size) + 1.0)


def build_sampler(setup: Setup, directory: Path) -> StrengthSampler:
    """Return the sampler of the scene's strengths; it may keep files in `directory`."""
    scene, surface = setup.scene, setup.model.surface
    return strength_sampler(
        scene.field,
        scene.soil.cohesion,
        scene.soil.friction_angle,
        surface.width,
        surface.top,
        directory,
        soil=lambda x, y: y < surface.height_at(x),
    )


def strengthen(setup: Setup, cohesion: Array, friction_angle: Array) -> Particles:
    """Return the start state with peak strengths (n,) in Pa and rad; nowhere is peak below residual."""
    soil = setup.model.soil
    return setup.start._replace(
        cohesion=np.maximum(cohesion, soil.cohesion_residual),
        friction_angle=np.maximum(friction_angle, soil.friction_residual),
    )


def draw_strengths(setup: Setup, sampler: StrengthSampler, realization: int) -> tuple[Array, Array]:
    """Return peak cohesion (Pa) and friction angle (rad) at the particles, each (n,)."""
    strengths = sampler.draw(setup.scene.campaign.seed, realization)
    within = np.minimum(setup.ground.x, setup.model.surface.width)  # a wall may stand beyond it by part of a cell
    return strengths.at(within, setup.ground.y)


def simulate(
    setup: Setup,
    sampler: StrengthSampler,
    realization: int,
    interrupt: Callable[[], bool],
    observe: Callable[[March], None] = lambda march: None,
) -> Record:
    """Simulate one realization.

    Parameters
    ----------
    setup : Setup
    sampler : StrengthSampler
    realization : int
        Its id; `BASELINE` for mean strengths everywhere.
    interrupt : callable
        Asked at every output time whether to leave.
    observe : callable
        Sees the march at every output time.

    Raises
    ------
    Interrupted
        If `interrupt` says so.
    """
    begin = time.perf_counter()
    start = strengthen(setup, *draw_strengths(setup, sampler, realization))

    def watch(march: March) -> None:
        if interrupt():
            raise Interrupted
        observe(march)

    history = run(setup.model, start, setup.coordinates["time"], watch)
    values = _series(history) | _final_values(setup, start, history)
    values["wall_time"] = time.perf_counter() - begin
    reason = CAME_APART if values["detached_volume"] > 0.0 else history.reason
    return Record(realization, status_of(history, setup.model.slide), reason, values)


def status_of(history: History, slide: Slide) -> Status:
    """Return how a march ended in the terms of the dataset."""
    if history.outcome is Outcome.DIVERGED:
        return Status.diverged
    if history.outcome is Outcome.LEFT_DOMAIN:
        return Status.left_domain
    if history.max_displacement[-1] <= slide.failed:
        return Status.no_slide
    return Status.slid if history.outcome is Outcome.AT_REST else Status.not_settled


def _series(history: History) -> dict[str, Value]:
    return {
        "runout": history.runout,
        "max_displacement": history.max_displacement,
        "kinetic_energy": history.kinetic_energy,
    }


def _final_values(setup: Setup, start: Particles, history: History) -> dict[str, Value]:
    particles, model = history.particles, setup.model
    shared: dict[str, Value] = {"steps": history.steps, "settle_time": history.settle_time}
    if history.has_failed:
        nothing: dict[str, Any] = dict.fromkeys(
            ("final_runout", "final_runout_mass", "sliding_volume", "detached_volume", "energy_error"), np.nan
        )
        no_surface = np.full(setup.coordinates["x"].size, np.nan)
        return shared | nothing | {"deposit_surface": no_surface, "displaced": np.zeros(setup.n_particles, np.uint8)}
    settled = particles._replace(volume=start.volume)  # grains that part gain volume, a deposit does not
    half_spacing = 0.5 * model.cell_size / np.sqrt(model.particles_per_cell)
    return shared | {
        "final_runout": history.runout[-1],
        "final_runout_mass": observables.runout_mass(particles, start, model.surface, model.slide),
        "sliding_volume": observables.sliding_volume(particles, start, model.slide),
        "detached_volume": detached_volume(particles, start, model.surface, model.allocate_grid()),
        "energy_error": history.energy_error,
        "deposit_surface": observables.deposit_surface(settled, half_spacing, column_edges(model)),
        "displaced": observables.is_displaced(particles, start, model.slide).astype(np.uint8),
    }
