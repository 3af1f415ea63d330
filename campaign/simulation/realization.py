"""One realization: from the ground with its strengths to a record, without MPI and without files."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from campaign.record import Record, Status, Value
from campaign.simulation.contract import Interrupted
from campaign.simulation.detachment import CAME_APART, detached_volume
from campaign.simulation.solver_model import Array, column_edges
from solver import observables
from solver.march import History, March, Outcome, run
from solver.model import Model
from solver.particles import Particles
from solver.slide import Slide


def never() -> bool:
    """Interrupt nothing."""
    return False


def nothing(_march: March) -> None:
    """Observe nothing."""


def simulate(
    model: Model,
    start: Particles,
    times: Array,
    realization: int,
    interrupt: Callable[[], bool] = never,
    observe: Callable[[March], None] = nothing,
) -> Record:
    """Simulate one realization.

    Parameters
    ----------
    model : solver.model.Model
    start : Particles
        The in-situ state with the peak strengths of the realization; not modified.
    times : ndarray (t,)
        Output times in s, increasing from 0.
    realization : int
        Its id, for the record.
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

    def watch(march: March) -> None:
        if interrupt():
            raise Interrupted
        observe(march)

    history = run(model, start, times, watch)
    values = _series(history) | _final_values(model, start, history)
    values["wall_time"] = time.perf_counter() - begin
    reason = CAME_APART if values["detached_volume"] > 0.0 else history.reason
    return Record(realization, status_of(history, model.slide), reason, values)


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


def _final_values(model: Model, start: Particles, history: History) -> dict[str, Value]:
    particles, edges = history.particles, column_edges(model)
    shared: dict[str, Value] = {"steps": history.steps, "settle_time": history.settle_time}
    if history.has_failed:
        nothing: dict[str, Any] = dict.fromkeys(
            ("final_runout", "final_runout_mass", "sliding_volume", "detached_volume", "energy_error"), np.nan
        )
        no_surface = np.full(edges.size - 1, np.nan)
        return shared | nothing | {"deposit_surface": no_surface, "displaced": np.zeros(start.x.size, np.uint8)}
    settled = particles._replace(volume=start.volume)  # grains that part gain volume, a deposit does not
    half_spacing = 0.5 * model.cell_size / np.sqrt(model.particles_per_cell)
    return shared | {
        "final_runout": history.runout[-1],
        "final_runout_mass": observables.runout_mass(particles, start, model.surface, model.slide),
        "sliding_volume": observables.sliding_volume(particles, start, model.slide),
        "detached_volume": detached_volume(particles, start, model.surface, model.allocate_grid()),
        "energy_error": history.energy_error,
        "deposit_surface": observables.deposit_surface(settled, half_spacing, edges),
        "displaced": observables.is_displaced(particles, start, model.slide).astype(np.uint8),
    }
