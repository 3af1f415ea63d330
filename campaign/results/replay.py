"""One realization again, with everything its particles go through, for a look in ParaView."""

from pathlib import Path
from typing import Any

import numpy as np

from campaign.errors import DamagedRecordError, RefusalError
from campaign.files import clear_temporaries
from campaign.record import Record
from campaign.scene import kept_scene
from campaign.seeds import BASELINE
from campaign.simulation.ground import Ground, prepare
from campaign.simulation.solver_model import Array
from campaign.statistics.wording import at_least
from campaign.storage import manifest
from campaign.storage.access import check_digest
from campaign.storage.layout import REPLAY, replay_file
from campaign.storage.record_store import RecordStore
from campaign.storage.vtkhdf import ParticleFile
from campaign.terminal import say
from solver.march import March
from solver.materials import mobilised_strength

MACHINE_TIME = ("wall_time",)
"""Quantities of a record that no repetition can reproduce."""


def replay(directory: Path, realization: int) -> Path:
    """Simulate a realization of a campaign again and write its particles at every output time.

    It says whether the result is the recorded one, bit for bit. A realization that crashes leaves the times before.

    Parameters
    ----------
    directory : Path
        Of the campaign.
    realization : int
        Its id; `BASELINE` for mean strengths everywhere.

    Returns
    -------
    Path
        The VTKHDF file, in `directory`/replay.

    Raises
    ------
    RefusalError
        When there is no such realization, or when this version would compute another one.
    """
    ground = prepare_again(directory, realization)
    path = _new_file(directory, realization)
    released = ground.released(realization)
    fixed = {row.identifier: getattr(released, row.particle_array) for row in ground.random_properties}
    if ground.scene.layer:
        fixed["layer"] = released.material
    with ParticleFile(path, fixed) as file:
        record = ground.simulate(realization, observe=lambda march: file.append(march.time, *state(march)))
    say(comparison(record, _recorded(directory, realization)))
    return path


def prepare_again(directory: Path, realization: int) -> Ground:
    """Prepare the scene of a campaign as it was when realization k was computed."""
    if realization < BASELINE:
        raise RefusalError(f"There is no realization {realization}; give 0 or more, or {BASELINE} for mean strengths.")
    about = manifest.read(directory)
    scene = kept_scene(about["scene"], about["overrides"])
    check_digest(scene, about["digest"])
    return prepare(scene, directory)


def state(march: March) -> tuple[Array, dict[str, Array]]:
    """Return the places (n, 3) of the particles in m and, by name, what they carry, in SI units.

    The elevation is the second coordinate, as ParaView looks along the third. Vectors have three components, and the
    symmetric effective stress has six: xx, yy, zz, xy, yz, xz.
    """
    now, start = march.particles, march.reference
    zero = np.zeros_like(now.x)
    points = np.column_stack([now.x, now.y, zero])
    cohesion, friction_angle = mobilised_strength(now, march.model.materials)
    return points, {
        "displacement": points - np.column_stack([start.x, start.y, zero]),
        "velocity": np.column_stack([now.velocity_x, now.velocity_y, zero]),
        "stress": np.column_stack([now.stress_xx, now.stress_yy, now.stress_zz, now.stress_xy, zero, zero]),
        "plastic_strain": now.plastic_strain,
        "cohesion": cohesion,
        "friction_angle": friction_angle,
        "volume": now.volume,
        "pore_pressure": now.pore_pressure + march.model.water.standing_pressure(now.y),
    }


def comparison(record: Record, kept: Record | None) -> str:
    """Say whether a realization is the one that was recorded."""
    name = "The deterministic run" if record.realization == BASELINE else f"Realization {record.realization}"
    runout = float(record.values["final_runout"])
    if kept is None:
        return f"{name} has no record to compare with; its final run-out is {at_least(record)}{runout:.3f} m."
    different = differing(record, kept)
    if not different:
        return f"{name} is the recorded one, bit for bit; its final run-out is {at_least(record)}{runout:.3f} m."
    found = f"its final run-out is {runout!r} m, recorded {float(kept.values['final_runout'])!r} m"
    if "final_runout" not in different:
        found = f"its final run-out is still {runout:.3f} m, bit for bit"
    return (
        f"{name} is NOT the recorded one in {', '.join(different)}; {found}. The solver, a library or the kind of "
        "processor has changed since: compare the versions in manifest.json."
    )


def differing(record: Record, kept: Record) -> list[str]:
    """Name what is not the same, bit for bit, in two records of a realization, as far as the kept one holds it."""
    names = [] if record.status == kept.status else ["status"]
    for name, value in record.values.items():
        if name in kept.values and name not in MACHINE_TIME and not _equal(value, kept.values[name]):
            names.append(name)
    return names


def _equal(one: Any, other: Any) -> bool:
    return np.array_equal(one, other, equal_nan=True)


def _recorded(directory: Path, realization: int) -> Record | None:
    try:
        return RecordStore(directory, manifest.read(directory)["digest"]).read(realization)
    except (KeyError, DamagedRecordError):
        return None


def _new_file(directory: Path, realization: int) -> Path:
    path = directory / REPLAY / replay_file(realization)
    try:
        path.parent.mkdir(exist_ok=True)
        clear_temporaries(path.parent)
    except OSError as error:
        raise RefusalError(f"{path.parent} cannot be written ({error}); copy the campaign to where it can.") from error
    return path
