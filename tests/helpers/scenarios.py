"""Made-up campaigns beside each other: the results alone, without simulation and records."""

import json

import numpy as np
from records import GROUND, make_record
from small_campaign import small_scene

from campaign.record import FAILED, Record, Status, missing_values, summarize
from campaign.results import dataset
from campaign.seeds import BASELINE
from campaign.simulation.contract import sizes
from campaign.statistics.tally import tally_of
from campaign.storage.columns import columns_of
from campaign.storage.formats import FORMAT
from campaign.storage.layout import MANIFEST, RESULTS

RECEPTORS = 'receptor=[{name="road", x="42 m"}, {name="Straße", x=["45 m", "47 m"]}]'


def keep(directory, runouts, *overrides, statuses=None, reaches=None):
    """Keep a campaign in `directory`: its final run-outs (m), how they ended, and whether they reach both receptors."""
    n = len(runouts)
    scene = small_scene(RECEPTORS, f"campaign.realizations={n}", *overrides)
    statuses = statuses or [Status.slid] * n
    reaches = np.zeros(n) if reaches is None else np.asarray(reaches, dtype=float)
    records = [record(k, *each) for k, each in enumerate(zip(runouts, statuses, reaches, strict=True))]
    tally = tally_of(scene)
    for each in (make_record(BASELINE), *records):
        tally.add(summarize(each))
    about = {
        "format": FORMAT,
        "scene": scene.text,
        "scene_overrides": "\n".join(scene.overrides),
        "realization_sha256": "f" * 64,
        "solver_drift": "false",
    }
    kept = [columns_of(records[: tally.prefix])]
    directory.mkdir()
    (directory / MANIFEST).write_text(json.dumps({"format": FORMAT}))
    dataset.write(dataset.build(GROUND, kept, make_record(BASELINE), tally.history(), about), directory / RESULTS)
    return directory


def record(realization, runout, status, reaches):
    """Return a record that ends so; its sliding volume is ten times the run-out."""
    made = make_record(realization, status)
    if status in FAILED:
        return Record(realization, status, "", missing_values(GROUND.quantities, sizes(GROUND)), made.units)
    values = dict(made.values)
    values |= {"final_runout_mass": float(runout), "final_runout": runout + 1.0, "sliding_volume": 10.0 * runout}
    values |= {name: np.full(2, reaches) for name in ("front_reaches", "moved_ground_reaches")}
    return Record(realization, status, "", values, made.units)
