"""What the runner asks of the thing it runs many times."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol

from numpy.typing import NDArray

from campaign.record import Record
from campaign.scene.scene import Scene


class Setup(Protocol):
    """What all realizations share; it is pickled once, to every rank."""

    @property
    def coordinates(self) -> Mapping[str, NDArray[Any]]:
        """Arrays "time" [s], "x" [m], "particle_x" and "particle_z" [m]."""

    @property
    def n_particles(self) -> int:
        """Number of particles."""

    @property
    def toe_x(self) -> float:
        """Place of the initial toe [m], from which run-out is measured."""


class Model(Protocol):
    """A deterministic function of the scene and the realization's id."""

    @property
    def Interrupted(self) -> type[Exception]:  # noqa: N802 -- a class
        """What `simulate` raises when it is interrupted."""

    def prepare(self, scene: Scene) -> Any:
        """Compute the `Setup`; done on rank 0. Raises `RefusalError` where the scene cannot be run."""

    def build_sampler(self, setup: Any, directory: Path) -> Any:
        """Make ready to draw strengths; done on every rank, on rank 0 first, which may keep files in `directory`."""

    def simulate(self, setup: Any, sampler: Any, realization: int, interrupt: Callable[[], bool]) -> Record:
        """Compute one realization; asks `interrupt` a few times a second and ends with `Interrupted` on True."""


def sizes(setup: Setup) -> dict[str, int]:
    """Return the length of each dimension of a record."""
    coordinates = setup.coordinates
    return {"time": len(coordinates["time"]), "x": len(coordinates["x"]), "particle": setup.n_particles}
