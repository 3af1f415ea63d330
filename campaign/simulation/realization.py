"""One realization: from the ground with its strengths to a record, without MPI and without files."""

import time
from collections.abc import Callable

from campaign.record import Record, Status
from campaign.simulation.contract import Interrupted
from campaign.simulation.ending import Ending
from campaign.simulation.flags import flags
from campaign.simulation.quantities import UNITS, measure
from campaign.simulation.receptors import NO_RECEPTORS, ReceptorLog
from campaign.simulation.solver_model import Array
from solver.history import MarchEnd
from solver.march import March, march_to_rest
from solver.model import Model
from solver.particles import Particles

NOTICEABLE = 0.02
"""Share of a run-out below which more of it is of no use to an engineer."""


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
    receptors: Array = NO_RECEPTORS,
    field_map: Array | None = None,
    settled: Particles | None = None,
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
    receptors : ndarray (r, 2)
        Near and far end in m of each place at which to look at the slide.
    field_map : ndarray, optional
        What `campaign.simulation.field_summary.BoxMap` makes of the random field, for the record.
    settled : Particles, optional
        The same ground at rest under gravity, where `start` is not: displacement counts from there.

    Raises
    ------
    Interrupted
        If `interrupt` says so.
    """
    begin = time.perf_counter()
    log = ReceptorLog(receptors, model, times) if len(receptors) else None

    def watch(march: March) -> None:
        if interrupt():
            raise Interrupted
        observe(march)
        if log is not None:
            log.observe(march)

    history = march_to_rest(model, start, times, watch, settled)
    ending = Ending(model, history.reference, history, begin, log, field_map)
    values = measure(ending)
    reason = history.reason if history.has_failed else flags(model, history.walls, values)
    return Record(realization, status_of(ending), reason, values, {name: UNITS[name] for name in values})


def status_of(ending: Ending) -> Status:
    """Return how a march ended in the terms of the dataset.

    A front that cannot come farther by as much as matters has come to its end, though the ground behind it may still
    move, as it does for long where a brittle slope retrogresses. The wall behind the crest bounds no run-out, so a
    slide that has reached it ends as any other.
    """
    history, criteria = ending.history, ending.model.criteria
    if history.end is MarchEnd.DIVERGED:
        return Status.diverged
    if history.end is MarchEnd.LEFT_DOMAIN:
        return Status.left_domain
    if history.max_displacement[-1] <= criteria.failed:
        return Status.no_slide
    if history.walls.right:
        return Status.reached_wall
    matters = max(criteria.displaced, NOTICEABLE * float(history.runout_mass[-1]))
    return Status.slid if ending.farther_advance <= matters else Status.not_settled
