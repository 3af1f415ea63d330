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

from campaign.record import Quantity, Record, Status, missing_values
from campaign.results.table import Table, gather
from campaign.simulation.contract import COORDINATES, SHARED, TEXT, PreparedGround, sizes
from campaign.statistics.convergence import ConvergenceHistory
from campaign.statistics.discretisation import METHOD, Discretisation
from campaign.storage.columns import Columns
from campaign.storage.files import publish, temporary_name

CHUNK = 64
"""Realizations in a chunk; the library's own choice for an unlimited dimension is 1, thirty times slower to read."""

Variables = dict[str, xr.Variable]


def build(
    ground: PreparedGround,
    blocks: Iterable[Columns],
    baseline: Record,
    history: ConvergenceHistory,
    about: Mapping[str, Any],
    discretisation: Discretisation | None = None,
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
    """
    quantities = ground.quantities
    table = gather(blocks, int(history.realizations[-1]), quantities, sizes(ground))
    variables = _per_realization(table, quantities) | _averages(table, quantities)
    variables |= _deterministic(baseline, ground) | _convergence(history) | _given(ground, SHARED)
    if discretisation is not None:
        variables |= _discretisation(discretisation)
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
        "realization": _variable("realization", range(table.n), "1", "realization", "i4"),
        "checkpoint": _variable("checkpoint", history.realizations, "1", "realizations looked at", "i4"),
    }


def _given(ground: PreparedGround, rows: Mapping[str, Quantity]) -> Variables:
    """Return what all realizations share, as far as the ground has it; CF tells the bounds of a place by its name."""
    given, variables = ground.coordinates, {}
    for name, row in rows.items():
        if name not in given:
            continue
        bounds = f"{name}_bounds"
        variables[name] = _variable(row.dims, given[name], row.units, row.long_name, row.dtype)
        if row.dtype == TEXT:
            del variables[name].attrs["units"]
        if bounds in given:
            variables[name].attrs["bounds"] = bounds
    return variables


def _per_realization(table: Table, quantities: Mapping[str, Quantity]) -> Variables:
    variables = {name: _of_all(quantities[name], values) for name, values in table.values.items()}
    variables["status"] = _status(table.statuses)
    reason = {"long_name": "why a realization failed or is flagged"}
    variables["reason"] = xr.Variable("realization", table.reasons, reason)
    return variables


def _of_all(quantity: Quantity, values: NDArray[Any]) -> xr.Variable:
    variable = _variable(("realization", *quantity.dims), values, quantity.units, quantity.long_name, quantity.dtype)
    variable.attrs["ancillary_variables"] = "status"
    return variable


def _status(statuses: NDArray[np.int8] | np.int8) -> xr.Variable:
    flags = {
        "long_name": "how the realization ended",
        "standard_name": "status_flag",
        "flag_values": np.array([int(status) for status in Status], dtype="i1"),
        "flag_meanings": " ".join(status.name for status in Status),
    }
    return xr.Variable("realization" if np.ndim(statuses) else (), statuses, flags)


def _averages(table: Table, quantities: Mapping[str, Quantity]) -> Variables:
    variables = {}
    for name, quantity in quantities.items():
        if quantity.average is not None:
            total, n = table.totals[name]
            mean = total / n if n else np.full(total.shape, np.nan)
            shown, long_name = quantity.average
            variables[shown] = _variable(quantity.dims, mean, quantity.units, long_name)
    return variables


def _deterministic(baseline: Record, ground: PreparedGround) -> Variables:
    values = missing_values(ground.quantities, sizes(ground)) | dict(baseline.values)
    runout, final = ground.quantities["runout"], ground.quantities["final_runout"]
    with_mean = "of the deterministic run with mean strengths"
    return {
        "deterministic_runout": _variable("time", values["runout"], "m", f"{runout.long_name}, {with_mean}"),
        "deterministic_final_runout": _variable((), values["final_runout"], "m", f"{final.long_name}, {with_mean}"),
        "deterministic_status": _status(np.int8(baseline.status)),
    }


def _convergence(history: ConvergenceHistory) -> Variables:
    bounds = ("checkpoint", "bound")
    return {
        "n": _variable("checkpoint", history.n, "1", "usable realizations behind the estimates", "i4"),
        "mean": _variable("checkpoint", history.mean, "m", "mean of final_runout given sliding"),
        "mean_ci": _variable(bounds, history.mean_ci, "m", "confidence interval of mean (Student t)"),
        "variance": _variable("checkpoint", history.variance, "m2", "variance of final_runout given sliding"),
        "variance_ci": _variable(bounds, history.variance_ci, "m2", "confidence interval of variance (Bonett)"),
        "exceedance": _variable("checkpoint", history.exceedance, "1", "share beyond the deterministic final run-out"),
        "exceedance_ci": _variable(bounds, history.exceedance_ci, "1", "confidence interval of exceedance (Wilson)"),
        "predicted_n": _variable("checkpoint", history.predicted_n, "1", "realizations expected to satisfy the rule"),
    }


def _discretisation(found: Discretisation) -> Variables:
    change = "final_runout with half the cell minus that with the cell"
    error = _variable((), found.error, "m", "estimated size of the discretisation error of mean")
    error.attrs |= {"cell": found.cell, "half_cell": found.cell / 2, "pairs": found.interval.n, "comment": METHOD}
    return {
        "pair": _variable("pair", range(len(found.differences)), "1", "realization repeated with half the cell", "i4"),
        "discretisation_error": error,
        "discretisation_change": _variable((), found.interval.estimate, "m", f"mean over pairs of {change}"),
        "discretisation_change_ci": _variable(
            "bound", found.interval[1:3], "m", "confidence interval of discretisation_change (Student t)"
        ),
        "paired_difference": _variable("pair", found.differences, "m", change),
        "deterministic_paired_difference": _variable((), found.deterministic, "m", f"{change}, with mean strengths"),
    }


def _variable(
    dims: str | tuple[str, ...],
    values: Any,
    units: str,
    long_name: str,
    dtype: str = "f8",
) -> xr.Variable:
    return xr.Variable(dims, np.asarray(values, dtype=dtype), {"units": units, "long_name": long_name})


def _encoding(dataset: xr.Dataset) -> dict[str, dict[str, Any]]:
    encoding: dict[str, dict[str, Any]] = {name: {"_FillValue": None} for name in map(str, dataset.coords)}
    for name, variable in dataset.data_vars.items():
        if variable.dims and variable.dtype.kind in "fiu":
            chunks = [min(CHUNK, size) if dim == "realization" else size for dim, size in variable.sizes.items()]
            encoding[str(name)] = {"zlib": True, "complevel": 4, "shuffle": True, "chunksizes": chunks}
    return encoding
