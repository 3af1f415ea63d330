"""The slides that the report draws, kept with the campaign: each is simulated again once, whoever does it."""

import contextlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from campaign.kept_arrays import keep, kept
from campaign.record import Quantity, Record, Status
from campaign.report.snapshots import ReplayedSlide, Snapshot, replay, slide_of
from campaign.simulation.ground import Ground
from campaign.storage.layout import SNAPSHOTS, snapshots_file

LAYOUT = 1
"""Of the arrays; another number makes files of this one unknown."""

OF_PARTICLES = ("x", "y", "displacement", "plastic_strain", "volume")


@dataclass(frozen=True)
class FilmedGround:
    """A ground whose realizations leave what they looked like in the directory of the campaign, `home`."""

    ground: Ground
    home: Path

    @property
    def coordinates(self) -> Mapping[str, NDArray[Any]]:
        """Those of the ground."""
        return self.ground.coordinates

    @property
    def quantities(self) -> Mapping[str, Quantity]:
        """Those of the ground."""
        return self.ground.quantities

    @property
    def n_particles(self) -> int:
        """That of the ground."""
        return self.ground.n_particles

    @property
    def toe_x(self) -> float:
        """That of the ground in m."""
        return self.ground.toe_x

    def simulate(self, realization: int, interrupt: Callable[[], bool]) -> Record:
        """Simulate a realization and keep its snapshots; raises OSError where these cannot be written."""
        slide = replay(self.ground, realization, interrupt)
        keep_slide(slide, self.ground, self.home)
        return slide.record


def keep_slide(slide: ReplayedSlide, ground: Ground, home: Path) -> None:
    """Keep the snapshots of a slide in the directory of its campaign; raises OSError where that cannot be done."""
    record, shots = slide.record, slide.snapshots
    arrays: dict[str, NDArray[Any]] = {name: np.array([getattr(shot, name) for shot in shots]) for name in OF_PARTICLES}
    arrays |= {name: np.array([getattr(shot, name) for shot in shots]) for name in ("time", "runout")}
    arrays |= {"status": np.array(int(record.status)), "reason": np.array(record.reason)}
    arrays |= {"final_runout": np.array(record.values["final_runout"])}
    keep(_path(home, slide.realization), _key(ground, slide.realization), arrays)


def kept_slide(ground: Ground, home: Path, realization: int) -> ReplayedSlide | None:
    """Return a slide that was kept; None if it was not, or its file is damaged."""
    arrays = kept(_path(home, realization), _key(ground, realization))
    if arrays is None:
        return None
    record = Record(
        realization,
        Status(int(arrays["status"])),
        str(arrays["reason"]),
        {"final_runout": float(arrays["final_runout"])},
        {},
    )
    shots = [
        Snapshot(*(arrays[name][k] for name in Snapshot._fields))._replace(
            time=float(arrays["time"][k]), runout=float(arrays["runout"][k])
        )
        for k in range(arrays["time"].size)
    ]
    return slide_of(ground, record, shots)


def slide_again(ground: Ground, home: Path, realization: int) -> ReplayedSlide:
    """Return a slide that was kept, or else simulate and keep it, if there is room."""
    if found := kept_slide(ground, home, realization):
        return found
    slide = replay(ground, realization)
    with contextlib.suppress(OSError):
        keep_slide(slide, ground, home)
    return slide


def _path(home: Path, realization: int) -> Path:
    return home / SNAPSHOTS / snapshots_file(realization)


def _key(ground: Ground, realization: int) -> str:
    return f"snapshots {LAYOUT} of realization {realization} of scene {ground.scene.digest()}"
