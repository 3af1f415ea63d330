"""Made-up records for tests."""

from types import SimpleNamespace

import numpy as np

from campaign.record import Record, Status
from campaign.simulation.quantities import QUANTITIES, UNITS

SIZES = {"time": 5, "x": 3, "particle": 4, "receptor": 2, "bound": 2, "property": 2, "box_y": 3, "box_x": 4}

GROUND = SimpleNamespace(
    quantities=QUANTITIES,
    n_particles=SIZES["particle"],
    toe_x=35.0,
    coordinates={
        "time": np.linspace(0, 1, SIZES["time"]),
        "x": np.arange(float(SIZES["x"])),
        "particle_x": np.arange(float(SIZES["particle"])),
        "particle_y": np.ones(SIZES["particle"]),
        "initial_surface": np.full(SIZES["x"], 4.0),
        "property": np.array(["cohesion", "friction_angle"], dtype=object),
        "box_x": np.arange(float(SIZES["box_x"])),
        "box_y": np.arange(float(SIZES["box_y"])),
        "receptor": np.array(["road", "Straße"], dtype=object),
        "receptor_x": np.array([42.0, 46.0]),
        "receptor_x_bounds": np.array([[42.0, 42.0], [45.0, 47.0]]),
    },
)
"""What a dataset needs of the ground whose records these are."""


def make_record(realization: int, status: Status = Status.slid, reason: str = "") -> Record:
    rng = np.random.default_rng(realization + 10)
    values = {}
    for name, quantity in QUANTITIES.items():
        array = rng.integers(0, 2, [SIZES[dim] for dim in quantity.dims]).astype(quantity.dtype)
        values[name] = array if array.ndim else array.item()
    values["final_runout"] = float(rng.normal(10, 0.5))
    values["final_runout_mass"] = values["final_runout"] - 0.25
    values["reached_wall_behind"] = 0
    return Record(realization, status, reason, values, UNITS)


def assert_same(one: Record, other: Record) -> None:
    assert (one.realization, one.status, one.reason) == (other.realization, other.status, other.reason)
    assert one.units == other.units
    assert one.values.keys() == other.values.keys()
    for name in one.values:
        np.testing.assert_array_equal(one.values[name], other.values[name], err_msg=name, strict=True)
