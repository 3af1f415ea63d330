"""From records to `results.nc`: an xarray dataset after CF-1.11, indexed by realization and time.

Whatever depends on ranks, hosts or clocks has "wall", "rank" or "host" in its name or is an attribute: everything else
is the same, bit for bit, however the campaign was computed.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from campaign.files import publish, temporary_name
from campaign.record import FINAL_RUNOUT, SLID, USABLE, Quantity, Record, Status, missing_values
from campaign.results.estimates import of_discretisation, of_history, of_release, of_total
from campaign.results.table import Table, gather
from campaign.results.variables import Variables, mask, status_flags, variable
from campaign.simulation.contract import COORDINATES, SHARED, TEXT, PreparedGround, sizes
from campaign.statistics.convergence import ConvergenceHistory
from campaign.statistics.discretisation import Discretisation
from campaign.statistics.release import ReleaseComparison
from campaign.storage.columns import Columns

CHUNK = 64
"""Realizations in a chunk; the library's own choice for an unlimited dimension is 1, thirty times slower to read."""


def build(
    ground: PreparedGround,
    blocks: Iterable[Columns],
    baseline: Record,
    history: ConvergenceHistory,
    about: Mapping[str, Any],
    discretisation: Discretisation | None = None,
    release: ReleaseComparison | None = None,
) -> xr.Dataset:
    """Assemble the dataset.

    Parameters
    ----------
    ground
        What the realizations share.
    blocks
        Records of realizations 0, 1, 2, ..., each once, in any order.
    baseline
        The deterministic run.
    history
        The estimates at the checkpoints of these realizations; the last one looks at all of them.
    about
        Global attributes.
    discretisation
        What half the cell changes, where that is known.
    release
        What the other release protocol changes, where that is known.
    """
    quantities = ground.quantities
    table = gather(blocks, int(history.realizations[-1]), quantities, sizes(ground))
    variables = _per_realization(table, quantities) | _averages(table, quantities)
    variables |= _deterministic(baseline, ground) | of_history(history) | of_total(history, discretisation)
    variables |= _given(ground, SHARED)
    if discretisation is not None:
        variables |= of_discretisation(discretisation)
    if release is not None:
        variables |= of_release(release)
    attributes = {"Conventions": "CF-1.11", "n_particles": ground.n_particles, "toe_x": ground.toe_x}
    return xr.Dataset(variables, _coordinates(ground, table, history), attributes | dict(about))


def write(dataset: xr.Dataset, path: Path) -> None:
    """Write the dataset so that a reader finds the old file or the whole new one.

    Raises
    ------
    OSError
        When the directory cannot be written or the disk is full.
    """
    temporary = temporary_name(path)
    try:
        dataset.to_netcdf(
            temporary, engine="netcdf4", format="NETCDF4", unlimited_dims=["realization"], encoding=_encoding(dataset)
        )
        publish(temporary, path)
    except RuntimeError as error:  # what netCDF4 makes of a full disk
        raise OSError(str(error)) from error
    finally:
        temporary.unlink(missing_ok=True)


def _coordinates(ground: PreparedGround, table: Table, history: ConvergenceHistory) -> Variables:
    return _given(ground, COORDINATES) | {
        "realization": variable("realization", range(table.n), "1", "realization", "i4"),
        "checkpoint": variable("checkpoint", history.realizations, "1", "realizations looked at", "i4"),
    }


def _given(ground: PreparedGround, rows: Mapping[str, Quantity]) -> Variables:
    """Return what all realizations share, as far as the ground has it; CF tells the bounds of a place by its name."""
    given, variables = ground.coordinates, {}
    for name, row in rows.items():
        if name not in given:
            continue
        bounds = f"{name}_bounds"
        variables[name] = variable(row.dims, given[name], row.units, row.long_name, row.dtype)
        if row.dtype == TEXT:
            del variables[name].attrs["units"]
        if bounds in given:
            variables[name].attrs["bounds"] = bounds
        if name.endswith("_bounds"):  # whose meaning is that of their place, and none is missing
            variables[name] = xr.Variable(row.dims, given[name], encoding={"_FillValue": None})
    return variables


def _per_realization(table: Table, quantities: Mapping[str, Quantity]) -> Variables:
    variables = {name: _of_all(quantities[name], values) for name, values in table.values.items()}
    variables["status"] = status_flags(table.statuses)
    variables["usable"] = mask(_ended(table, USABLE), "statistics count it: it has a result, of a slide or not")
    variables["slid"] = mask(_ended(table, SLID), "it slid; statistics given sliding count it")
    reason = {"long_name": "why a realization failed or is flagged"}
    variables["reason"] = xr.Variable("realization", table.reasons, reason)
    return variables


def _ended(table: Table, ways: Iterable[Status]) -> NDArray[np.bool_]:
    return np.isin(table.statuses, list(ways))


def _of_all(quantity: Quantity, values: NDArray[Any]) -> xr.Variable:
    filled = variable(("realization", *quantity.dims), values, quantity.units, quantity.long_name, quantity.dtype)
    filled.attrs["ancillary_variables"] = "status"
    return filled


def _averages(table: Table, quantities: Mapping[str, Quantity]) -> Variables:
    variables = {}
    for name, quantity in quantities.items():
        if quantity.average is not None:
            total, n = table.totals[name]
            mean = total / n if n else np.full(total.shape, np.nan)
            shown, long_name = quantity.average
            variables[shown] = variable(quantity.dims, mean, quantity.units, long_name)
    return variables


def _deterministic(baseline: Record, ground: PreparedGround) -> Variables:
    values = missing_values(ground.quantities, sizes(ground)) | dict(baseline.values)
    variables = {"deterministic_status": status_flags(np.int8(baseline.status))}
    for name in ("runout", *FINAL_RUNOUT.values()):
        quantity = ground.quantities[name]
        long_name = f"{quantity.long_name}, of the deterministic run with mean strengths"
        variables[f"deterministic_{name}"] = variable(quantity.dims, values[name], quantity.units, long_name)
    return variables


def _encoding(dataset: xr.Dataset) -> dict[str, dict[str, Any]]:
    encoding: dict[str, dict[str, Any]] = {name: {"_FillValue": None} for name in map(str, dataset.coords)}
    for name, stored in dataset.data_vars.items():
        if stored.dims and stored.dtype.kind in "fiu":
            chunks = [min(CHUNK, size) if dim == "realization" else size for dim, size in stored.sizes.items()]
            encoding[str(name)] = {
                "zlib": True,
                "complevel": 4,
                "shuffle": True,
                "chunksizes": chunks,
            } | stored.encoding
    return encoding
