"""A campaign small enough for a test: the paper's slope in cells of 2 m."""

import numpy as np

from campaign.record import FAILED, QUANTITIES, Record, Status, missing_values
from campaign.results import dataset
from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation import realization
from campaign.simulation.contract import sizes
from campaign.statistics.tally import outcome_of, tally_of
from campaign.storage import manifest
from campaign.storage.provenance import attributes
from campaign.storage.record_store import RecordStore

OVERRIDES = ["numerics.cell=2 m", "numerics.output_interval=0.5 s", "campaign.minimum=10", "campaign.block=1"]


def small_scene(*overrides):
    return load_scene("ma2023", [*OVERRIDES, *overrides])


def run(directory, scene):
    """Run a campaign without MPI."""
    setup = realization.prepare(scene)
    sampler = realization.build_sampler(setup, directory)
    ids = range(BASELINE, scene.campaign.realizations)
    records = [realization.simulate(setup, sampler, k, lambda: False) for k in ids]
    conclude(directory, scene, setup, records)
    return setup, records


def conclude(directory, scene, setup, records):
    """Keep what a campaign keeps; `records` begin with the baseline's."""
    directory.mkdir(exist_ok=True)
    manifest.begin(directory, scene, 1, allow_drift=False)
    store, tally = RecordStore(directory), tally_of(scene)
    store.create()
    for record in records:
        store.write(record)
        tally.add(outcome_of(record))
    history = tally.history()
    about = attributes(scene, manifest.read(directory), history.verdict)
    kept = records[1 : 1 + tally.prefix]
    dataset.write(dataset.build(setup, kept, records[0], history, about), directory / "results.nc")


def made_up(setup, realization, runout, status=Status.slid, reason=""):
    """Return a record that ends with a given run-out (m)."""
    values = missing_values(sizes(setup))
    if status not in FAILED:
        values = {name: np.zeros_like(np.asarray(values[name])) for name in QUANTITIES}
        values["final_runout"] = runout
        values["runout"] = runout * np.linspace(0, 1, len(setup.coordinates["time"]))
        values["settle_time"] = np.nan if status is Status.not_settled else 5.0
        values["deposit_surface"] = np.full(len(setup.coordinates["x"]), 4.0)
    return Record(realization, status, reason, values)
