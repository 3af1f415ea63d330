"""Pictures of a slide on its way, for the figures; taken while the realization is simulated again."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaign.record import Front, Record
from campaign.simulation.ground import Ground
from campaign.simulation.realization import never
from campaign.simulation.solver_model import Array
from solver.march import March
from solver.observables import displacement, runout, runout_mass

Single = NDArray[Any]  # of np.float32

TIMES = (3.0, 5.0)
"""Seconds after release at which the paper shows the deterministic slide, besides its end."""

FRAMES = 21
"""Of a film; there are two in a second where a run ends after 10 s."""


class Snapshot(NamedTuple):
    """The particles at one time, in single precision."""

    time: float  # s since release
    x: Single  # (n,) m
    y: Single  # (n,) m
    displacement: Single  # (n,) m from the ground at rest
    plastic_strain: Single  # (n,)
    volume: Single  # (n,) m2
    runout: float  # m


@dataclass(frozen=True)
class ReplayedSlide:
    """One realization, simulated again.

    Parameters
    ----------
    record : Record
    soil : mapping
        The random properties of the particles by name, each (n,) in SI.
    raised_shares : mapping
        Share of the particles at which a drawn peak strength was below the residual one and was raised to it, by name.
    snapshots : sequence of Snapshot
        At the output times nearest to `TIMES` and `frame_times` that came before the end, and at the end.
    """

    record: Record
    soil: Mapping[str, Array]
    raised_shares: Mapping[str, float]
    snapshots: Sequence[Snapshot]

    @property
    def realization(self) -> int:
        """Its id."""
        return self.record.realization

    @property
    def end(self) -> Snapshot:
        """The last snapshot."""
        return self.snapshots[-1]

    def at(self, time: float) -> Snapshot:
        """Return the last snapshot not later than a time (s), or the first one."""
        return next((shot for shot in reversed(self.snapshots) if shot.time <= time + 1e-9), self.snapshots[0])


def frame_times(end_time: float) -> Array:
    """Return the times (s) of the frames of a film."""
    return np.linspace(0.0, end_time, FRAMES)


def replay(ground: Ground, realization: int, interrupt: Callable[[], bool] = never) -> ReplayedSlide:
    """Simulate a realization again and take the snapshots that figures and films show.

    Parameters
    ----------
    ground, realization
        Whose.
    interrupt
        See `Ground.simulate`, and for what it raises.
    """
    outputs, times = ground.coordinates["time"], [*TIMES, *frame_times(ground.scene.numerics.end_time)]
    wanted = {float(outputs[np.argmin(np.abs(outputs - time))]) for time in times}
    snapshots: list[Snapshot] = []
    front = ground.scene.slide.front

    def observe(march: March) -> None:
        if snapshots and snapshots[-1].time not in wanted:
            snapshots.pop()
        snapshots.append(snapshot(march, front))

    return slide_of(ground, ground.simulate(realization, interrupt, observe), snapshots)


def slide_of(ground: Ground, record: Record, snapshots: Sequence[Snapshot]) -> ReplayedSlide:
    """Return a slide from what is known of its way, with the soil it slid in."""
    released = ground.released(record.realization)
    soil = {row.name: getattr(released, row.particle_array) for row in ground.random_properties}
    return ReplayedSlide(record, soil, ground.raised_shares(record.realization), snapshots)


def snapshot(march: March, front: Front) -> Snapshot:
    """Return what a figure shows of a march, with the run-out of a front."""
    now, reference = march.particles, march.reference
    moved = displacement(now, reference)
    measure = runout_mass if front == "mass" else runout
    ran = measure(now, reference, march.model.surface, march.model.criteria)
    x, y, moved, strain, volume = (
        values.astype(np.float32) for values in (now.x, now.y, moved, now.plastic_strain, now.volume)
    )
    return Snapshot(march.time, x, y, moved, strain, volume, ran)
