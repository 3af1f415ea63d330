"""The slide with mean strengths before a campaign, in cells so large that it takes seconds."""

import time
from math import ceil, inf, isfinite
from typing import NamedTuple

from campaign.record import SLID, Record, Status
from campaign.scene import Scene
from campaign.scene.complaints import Complaint, found
from campaign.scene.cost import realization_seconds
from campaign.scene.first_look import LONGEST_SLIDE, TYPICAL_SLIDE, FirstLook
from campaign.scene.foresight import longer_plain
from campaign.scene.rules.numerics import LEAST_CELLS_OF_HEIGHT
from campaign.seeds import BASELINE
from campaign.simulation.contract import Interrupted
from campaign.simulation.flags import with_remedy, without_debris
from campaign.simulation.ground import Ground, prepare
from campaign.terminal import rounded_up

AFFORDABLE = 5.0
"""Seconds that a trial may take by estimate; it is given up after `PATIENCE` times as many."""

PATIENCE = 6.0

SCATTER = 1.5
"""How far single slides come, in run-outs of the one with mean strengths; those of `ma2023` come up to 1.4 times."""


LATER = 1.2
"""How late single slides come to rest, in times of the one with mean strengths."""


class Trial(NamedTuple):
    """A deterministic run that is not part of a campaign.

    Attributes
    ----------
    ground : Ground
        With the cells of the trial.
    record : Record
    """

    ground: Ground
    record: Record

    @property
    def cell(self) -> float:
        """Size of the cells in m."""
        return self.ground.scene.numerics.cell

    @property
    def slides(self) -> bool:
        """Whether it slid, whatever stopped it."""
        return self.record.status in SLID

    @property
    def front(self) -> float:
        """Place in m where the front came to rest; NaN without a slide."""
        return float(self.record.values["front_position"][-1])  # type: ignore[index]

    @property
    def rest(self) -> float:
        """Time in s at which it came to rest; infinite if it did not."""
        time = float(self.record.values["settle_time"])
        return time if isfinite(time) else inf

    @property
    def runout(self) -> float:
        """Distance in m from the toe to the front, zero behind it; NaN without a slide."""
        return max(0.0, self.front - self.ground.toe_x)


def with_affordable_cells(scene: Scene, look: FirstLook) -> Scene | None:
    """Return the scene with the smallest whole multiple of its cell that is affordable; None if the slope is too low.

    The mean strengths need no fine grid of the random field.
    """
    lasts = min(1.0, TYPICAL_SLIDE * look.time_scale / scene.numerics.end_time)
    times = max(1, ceil((lasts * realization_seconds(scene) / AFFORDABLE) ** (1 / 3)))
    cell = times * scene.numerics.cell
    if times > 1 and cell * LEAST_CELLS_OF_HEIGHT > look.height:
        return None
    numerics = scene.numerics.model_copy(update={"cell": cell})
    field = scene.field.model_copy(update={"sampler": "auto", "resolution": max(cell, scene.field.resolution or 0.0)})
    return scene.model_copy(update={"numerics": numerics, "field": field})


def trial(scene: Scene, look: FirstLook) -> Trial | None:
    """Run the slide with mean strengths, after a first look; None where that takes too long.

    Raises
    ------
    RefusalError
        If the ground does not come to rest under its own weight.
    """
    coarse = with_affordable_cells(scene, look)
    if coarse is None:
        return None
    ground = prepare(coarse)
    end = time.monotonic() + PATIENCE * AFFORDABLE
    try:
        return Trial(ground, ground.simulate(BASELINE, interrupt=lambda: time.monotonic() > end))
    except Interrupted:
        return None


def foreseen(scene: Scene, look: FirstLook, made: Trial) -> list[Complaint]:
    """Return what a trial that slid lets expect of realizations."""
    return found((short_ground(scene, made), short_run(scene, made, LONGEST_SLIDE * look.time_scale)))


def short_ground(scene: Scene, made: Trial) -> Complaint | None:
    """Warn of a wall that slides will reach, though the one with mean strengths has not."""
    surface, needed = made.ground.model.surface, SCATTER * made.runout
    if made.record.status is Status.reached_wall or surface.width - surface.toe_x >= needed:
        return None
    text = (
        f"the slide with mean strengths comes {made.runout:.3g} m beyond the toe, others come up to {SCATTER:g} times "
        f"as far, and the wall {surface.width - surface.toe_x:g} m beyond the toe will hold them back"
    )
    return longer_plain(scene, surface, needed, text)


def short_run(scene: Scene, made: Trial, longest: float) -> Complaint | None:
    """Warn of an end at which slides will not be at rest, of which comparable ones take `longest` s at most."""
    rest, end = made.rest, scene.numerics.end_time
    if LATER * rest <= end or (not isfinite(rest) and made.record.status is Status.slid):
        return None
    slide = f"takes {rest:.2g} s to come to rest" if isfinite(rest) else "still moves then"
    longer = rounded_up(2.0 * rest if isfinite(rest) else max(2.0 * end, longest))
    return Complaint(
        "numerics.end_time",
        f"the slide with mean strengths {slide}, and what still moves at the end counts as not settled; use "
        f'"{longer} s", which costs nothing where slides rest earlier',
    )


def remarks(made: Trial) -> str:
    """Return sentences on what was in the way of the slide; "" if nothing was."""
    return with_remedy(without_debris(made.record.reason), made.ground.scene)
