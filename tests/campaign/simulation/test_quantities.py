"""A quantity is a row of one table: record, dataset and documentation follow from it."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
from records import GROUND, SIZES, make_record
from small_campaign import small_scene
from tallies import prefixes_of

from campaign.record import Average, Record, Status, summarize
from campaign.results import dataset
from campaign.seeds import BASELINE
from campaign.simulation import quantities, realization, receptors
from campaign.simulation.contract import sizes
from campaign.simulation.ending import Measured
from campaign.simulation.ground import prepare
from campaign.simulation.quantities import QUANTITIES, UNITS, markdown
from campaign.statistics.convergence import convergence_history
from campaign.statistics.stopping import StoppingRule
from campaign.storage.columns import columns_of
from campaign.storage.record_store import RecordStore
from solver.observables import fastest

ROAD = 'receptor=[{name = "road", x = "42 m"}]'
SPEED = Measured((), "m/s", "largest speed at the end", compute=lambda end: fastest(end.particles))
LEFT = Measured(
    ("particle",),
    "1",
    "1 where a particle has left",
    "u1",
    Average("leaving_probability", "share of the realizations in which the particle leaves"),
    compute=lambda end: np.zeros(end.start.x.size),
)


def estimates_of(records):
    """Return the convergence history of records, of which a dataset needs some."""
    return convergence_history(prefixes_of([*map(summarize, records)]), StoppingRule(0.1, 0.1, 0.95, 10, 5, 0.1), 1.0)


def test_a_new_row_is_measured_kept_and_shown(tmp_path, monkeypatch):
    monkeypatch.setitem(quantities.QUANTITIES, "final_speed", SPEED)
    monkeypatch.setitem(realization.UNITS, "final_speed", SPEED.units)
    ground = prepare(small_scene("numerics.end_time=0.5 s"))
    records = [ground.simulate(k) for k in (BASELINE, 0, 1)]
    store = RecordStore(tmp_path)
    store.create()
    for record in records:
        store.write(record)
    kept = RecordStore(tmp_path).read(1)
    assert kept.values["final_speed"] == records[2].values["final_speed"] > 0
    assert kept.units["final_speed"] == "m/s"
    estimates = estimates_of(records[1:])
    built = dataset.build(ground, RecordStore(tmp_path).columns(2), records[0], estimates, {})
    np.testing.assert_array_equal(built.final_speed, [record.values["final_speed"] for record in records[1:]])
    assert built.final_speed.attrs["units"] == "m/s"
    assert "| `final_speed` | realization | m/s | largest speed at the end |" in markdown()


def test_what_is_too_large_for_each_realization_enters_as_its_average():
    rng = np.random.default_rng(3)
    left = rng.integers(0, 2, (6, SIZES["particle"]), "u1")
    statuses = [Status.slid] * 5 + [Status.crashed]
    records = [
        Record(k, status, "", make_record(k).values | {"left": left[k]}, UNITS | {"left": "1"})
        for k, status in enumerate(statuses)
    ]
    ground = SimpleNamespace(**vars(GROUND) | {"quantities": QUANTITIES | {"left": LEFT}})
    estimates = estimates_of(records)
    blocks = [columns_of(records[:2]), columns_of(records[2:])]
    built = dataset.build(ground, blocks, make_record(BASELINE), estimates, {})
    np.testing.assert_array_equal(built.leaving_probability, left[:5].mean(axis=0))
    assert "left" not in built


def test_values_have_their_declared_types():
    record = prepare(small_scene("numerics.end_time=0.5 s", ROAD)).simulate(0)
    assert record.values.keys() == QUANTITIES.keys() == record.units.keys()
    for name, quantity in QUANTITIES.items():
        assert np.asarray(record.values[name]).dtype == quantity.dtype, name
        assert np.ndim(record.values[name]) == len(quantity.dims), name


def test_a_failed_march_lacks_what_has_no_meaning_then(monkeypatch):
    """Its series, time of rest, steps and clock are those up to the failure."""
    ground = prepare(small_scene("numerics.end_time=0.5 s", ROAD))
    march_to_rest = realization.march_to_rest

    def failing(*arguments):
        ended = march_to_rest(*arguments)
        monkeypatch.setattr(type(ended), "has_failed", True)
        return ended

    monkeypatch.setattr(realization, "march_to_rest", failing)
    record = ground.simulate(0)
    lengths = sizes(ground)
    for name, quantity in QUANTITIES.items():
        values = np.asarray(record.values[name])
        assert values.shape == tuple(lengths[dim] for dim in quantity.dims)
        assert quantity.after_failure or not np.nan_to_num(values).any(), name
    assert np.isnan(record.values["final_runout"])
    assert record.values["steps"] > 0


def test_what_the_scene_does_not_ask_for_is_not_there():
    ground = prepare(small_scene("numerics.end_time=0.5 s"))
    record = ground.simulate(0)
    assert record.values.keys() == ground.quantities.keys() == record.units.keys()
    assert QUANTITIES.keys() - record.values.keys() == receptors.QUANTITIES.keys()


def test_readme_lists_the_quantities_of_the_table():
    readme = Path(__file__).parents[3] / "README.md"
    text = readme.read_text()
    begin, end = "<!-- quantities: from the table -->\n", "\n<!-- quantities end -->"
    assert text[text.index(begin) + len(begin) : text.index(end)] == markdown()
