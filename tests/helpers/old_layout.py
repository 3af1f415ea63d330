"""A results directory as version 0.1.0 left it: no format number anywhere, a pack holds a group a realization."""

import hashlib
import json
from dataclasses import replace

import h5py
import numpy as np

from campaign.simulation.quantities import QUANTITIES
from campaign.storage import manifest
from campaign.storage.layout import MANIFEST, PACKS, RECORDS, realization_name

ORDER = (
    *("runout", "max_displacement", "kinetic_energy", "final_runout", "final_runout_mass", "sliding_volume"),
    *("detached_volume", "settle_time", "energy_error", "wall_time", "steps", "deposit_surface", "displaced"),
)


def kept(record):
    """Return a record with no more than what version 0.1.0 kept of it."""
    values = {name: value for name, value in record.values.items() if name in ORDER}
    return replace(record, values=values, units={name: record.units[name] for name in values})


def write_manifest(directory, scene):
    """Note a start in a new directory; what later versions add is taken out again."""
    manifest.begin(directory, scene, 1, allow_drift=False)
    path = directory / MANIFEST
    kept = json.loads(path.read_text())
    path.write_text(json.dumps({name: value for name, value in kept.items() if name not in ("format", "reader")}))


def write_records(directory, loose=(), packed=(), without=()):
    """Write records, those of `packed` into pack 0; quantities named in `without` are left out."""
    for room in (RECORDS, PACKS):
        (directory / room).mkdir(exist_ok=True)
    for record in loose:
        with h5py.File(directory / RECORDS / f"{realization_name(record.realization)}.h5", "w") as file:
            _write_group(file, record, without)
    if packed:
        with h5py.File(directory / PACKS / "p00000.h5", "w") as file:
            for record in packed:
                _write_group(file.create_group(realization_name(record.realization)), record, without)


def _write_group(group, record, without):
    arrays = {
        name: np.asarray(record.values[name], dtype=QUANTITIES[name].dtype) for name in ORDER if name not in without
    }
    for name, array in arrays.items():
        group[name] = array
        group[name].attrs["units"] = QUANTITIES[name].units
    group.attrs["realization"] = record.realization
    group.attrs["status"] = int(record.status)
    group.attrs["reason"] = record.reason
    digest = hashlib.sha256(f"{record.realization} {int(record.status)} {record.reason}".encode())
    for name, array in arrays.items():
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    group.attrs["checksum"] = digest.hexdigest()
