"""A campaign small enough for a test: the paper's slope in cells of 2 m."""

import numpy as np

from campaign.record import FAILED, Record, Status, missing_values, summarize
from campaign.results import dataset
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.contract import sizes
from campaign.simulation.ground import prepare
from campaign.simulation.quantities import UNITS
from campaign.statistics.tally import tally_of
from campaign.storage import manifest
from campaign.storage.columns import columns_of
from campaign.storage.provenance import attributes
from campaign.storage.record_store import RecordStore

OVERRIDES = ["numerics.cell=2 m", "numerics.output_interval=0.5 s", "campaign.minimum=10", "campaign.block=1"]


def small_scene(*overrides):
    return load_scene("ma2023", [*OVERRIDES, *overrides])


def run(directory, scene):
    """Run a campaign without MPI."""
    ground = prepare(scene)
    ids = range(BASELINE, scene.campaign.realizations)
    records = [ground.simulate(k) for k in ids]
    conclude(directory, scene, ground, records)
    return ground, records


def conclude(directory, scene, ground, records):
    """Keep what a campaign keeps; `records` begin with the baseline's."""
    directory.mkdir(exist_ok=True)
    manifest.begin(directory, scene, 1, allow_drift=False)
    store, tally = RecordStore(directory), tally_of(scene)
    store.create()
    for record in records:
        store.write(record)
        tally.add(summarize(record))
    history = tally.history()
    about = attributes(scene, manifest.read(directory), history.verdict)
    kept = records[1 : 1 + tally.prefix]
    dataset.write(dataset.build(ground, [columns_of(kept)], records[0], history, about), directory / "results.nc")


def made_up(ground, realization, runout, status=Status.slid, reason=""):
    """Return a record that ends with a given run-out (m)."""
    values = missing_values(ground.quantities, sizes(ground))
    if status not in FAILED:
        values = {name: np.zeros_like(np.asarray(values[name])) for name in ground.quantities}
        values["final_runout"] = values["final_runout_mass"] = runout
        values["runout"] = runout * np.linspace(0, 1, len(ground.coordinates["time"]))
        values["settle_time"] = np.nan if status is Status.not_settled else 5.0
        values["deposit_surface"] = np.full(len(ground.coordinates["x"]), 4.0)
    return Record(realization, status, reason, values, UNITS)
