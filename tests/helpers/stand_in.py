"""A ground in the place of the solver's: instant, deterministic in (seed, realization, cell), and faulty on demand.

Run under mpirun as a campaign: `python stand_in.py DIR REALIZATIONS`, with STAND_IN_* variables for faults, and one for
a file that holds what takes each start long to find out: the table of quantities, for whose sake each rank would load
the solver, and the hashes of the sources.
"""

import ctypes
import errno
import math
import os
import pickle
import resource
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from campaign.record import Quantity, Record, Status, units_of, with_dims
from campaign.scene import Scene, load_scene
from campaign.seeds import BASELINE, Stream, generator
from campaign.simulation.contract import Interrupted
from campaign.storage import manifest

if kept := os.environ.get("STAND_IN_KEPT"):
    QUANTITIES: dict[str, Quantity]
    QUANTITIES, hashes = pickle.loads(Path(kept).read_bytes())
    manifest.source_hashes = lambda: hashes
else:
    from campaign.simulation.quantities import QUANTITIES

SIZES = {"time": 11, "x": 7, "particle": 13}
RATE = 0.189
MEASURED = with_dims(QUANTITIES, SIZES)
UNITS = units_of(QUANTITIES)


@dataclass
class StandIn:
    """In the place of `campaign.simulation.ground.Ground`."""

    scene: Scene
    is_beside: bool = False  # the campaign's own realizations
    n_particles: int = SIZES["particle"]
    toe_x: float = 35.0
    coordinates: dict[str, np.ndarray] = field(
        default_factory=lambda: {
            "time": np.linspace(0, 10, SIZES["time"]),
            "x": np.arange(SIZES["x"]) + 0.5,
            "particle_x": np.arange(SIZES["particle"]) * 0.5,
            "particle_y": np.ones(SIZES["particle"]),
            "initial_surface": np.full(SIZES["x"], 4.0),
        }
    )

    @property
    def quantities(self) -> dict[str, Quantity]:
        return MEASURED

    def simulate(self, realization: int, interrupt: Callable[[], bool]) -> Record:
        begin, own = time.monotonic(), os.environ.get("STAND_IN_SECONDS", "0")
        length = float(os.environ.get("STAND_IN_SECONDS_BESIDE", own) if self.is_beside else own)
        while time.monotonic() - begin < length:
            if interrupt():
                raise Interrupted
            time.sleep(0.005)
        misbehave(realization)
        return record(self.scene, realization)


def prepare(scene: Scene, directory: Path) -> StandIn:
    if "STAND_IN_RAISE_IN_PREPARE" in os.environ:
        raise RuntimeError("the runner itself is broken")
    if "STAND_IN_NO_MEMORY_TO_PREPARE" in os.environ:
        raise MemoryError("64 GiB are wanted")
    if seconds := os.environ.get("STAND_IN_PREPARE_SECONDS"):
        (directory / ".preparing").touch()
        time.sleep(float(seconds))
    prepared.append(scene)
    return StandIn(scene, len(prepared) > 1)


prepared: list[Scene] = []
"""The first one is the campaign's own."""


def misbehave(realization: int) -> None:
    rank = os.environ.get("PMI_RANK", os.environ.get("OMPI_COMM_WORLD_RANK", "0"))
    if rank == os.environ.get("STAND_IN_SICK"):
        raise OSError(errno.ENOSPC, "No space left on device")
    if str(realization) == os.environ.get("STAND_IN_MEMORY"):
        raise MemoryError("64 GiB are wanted")
    if str(realization) == os.environ.get("STAND_IN_VANISH"):
        os._exit(0)
    if str(realization) == os.environ.get("STAND_IN_HANG"):
        time.sleep(1000)
    if str(realization) == os.environ.get("STAND_IN_HANG_ALONE"):
        ctypes.PyDLL(None).sleep(1000)  # no other thread of Python runs meanwhile
    if str(realization) == os.environ.get("STAND_IN_RAISE"):
        raise ZeroDivisionError("a particle has no mass")
    if str(realization) == os.environ.get("STAND_IN_CRASH"):
        os.kill(os.getpid(), signal.SIGSEGV)
    if str(realization) == os.environ.get("STAND_IN_FULL_DISK"):
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))


def record(scene: Scene, realization: int) -> Record:
    seed, cell, ramped = scene.campaign.seed, scene.numerics.cell, scene.numerics.gravity == "ramp"
    rng = np.random.default_rng(0) if realization == BASELINE else generator(seed, Stream.FIELD, realization)
    values = {
        name: rng.normal(10, 0.5, [SIZES[dim] for dim in quantity.dims]).astype(quantity.dtype)
        for name, quantity in MEASURED.items()
    }
    values["final_runout"] = values["final_runout"] + 2.0 * (1.0 - cell) * (1 + 0.1 * realization) + 0.6 * ramped
    values["final_runout"] += 10.0 * (scene.soil.softening.rate - RATE)
    values["final_runout_mass"] = values["final_runout"]
    values["displaced"] = rng.integers(0, 2, SIZES["particle"], "u1")
    values["wall_time"] = time.process_time()
    status = Status.no_slide if "STAND_IN_STABLE" in os.environ else Status.slid
    return Record(realization, status, "", values, UNITS)


if __name__ == "__main__":
    from campaign.record import Status
    from campaign.running import watch
    from campaign.running.campaign_directory import Earlier
    from campaign.running.mpi import on_ranks, run_on_ranks

    watch.GRACE = float(os.environ.get("STAND_IN_GRACE", "300"))
    retry = frozenset(Status[name] for name in os.environ.get("STAND_IN_RETRY", "").split())
    directory, count, *overrides = sys.argv[1:]
    alone = ["campaign.discretisation_pairs=0", "campaign.sensitivity_pairs=0"]
    wanted = [f"campaign.realizations={count}", *alone, *overrides]
    scene = partial(load_scene, "ma2023", wanted)
    if "STAND_IN_TRADEOFF" in os.environ:
        from campaign.tradeoff.compare import lead  # which loads the solver

        sys.exit(on_ranks(scene, lambda _: Path(directory), lead(math.inf, prepare)))
    sys.exit(run_on_ranks(scene, Path(directory), prepare, None, Earlier(False, retry)))
