"""Results whose run-outs are a known function of the soil that the scene really draws."""

import numpy as np
from small_campaign import OVERRIDES, made_up

from campaign.record import Status, summarize
from campaign.results import dataset
from campaign.results.results import Results
from campaign.results.sensitivity import with_sensitivity
from campaign.scene import load_scene
from campaign.scene.inputs import inputs_of
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from campaign.statistics.changed_inputs import InputEffects
from campaign.statistics.tally import tally_of
from campaign.storage.columns import columns_of

FOOT = (slice(2, 5), slice(6, 9))
"""Rows and columns of the boxes in which stronger soil shortens the slide, by 2 m for a unit of its logarithm each."""

SLOPE = -2.0


def soil_campaign(n, standing=lambda _runout: False, source="ma2023"):
    """Return the results of n realizations and four repeated slides; `standing` picks run-outs (m) without a slide."""
    count = f"campaign.realizations={n}", f"campaign.minimum={n + 1}"
    scene = load_scene(source, [*OVERRIDES, *count])
    ground, rng, tally = prepare(scene), np.random.default_rng(7), tally_of(scene)
    records = [made_up(ground, BASELINE, 10.0)]
    for k in range(n):
        field_map = ground.boxes.means(ground.draw(k))
        typical = np.log([row.mean(scene) for row in ground.random_properties[:1]])[0]
        runout = 10.0 + SLOPE * np.sum(field_map[0][FOOT] - typical) + 0.2 * rng.normal()
        stands = standing(runout)
        record = made_up(ground, k, 0.0 if stands else runout, Status.no_slide if stands else Status.slid)
        moves = (ground.lattice.x < 42.0) & (ground.lattice.y > 2.0)
        record.values.update(field_map=field_map.astype("f4"), displaced=moves.astype("u1"))
        records.append(record)
    for record in records:
        tally.add(summarize(record))
    built = dataset.build(ground, [columns_of(records[1:])], records[0], tally.history(), {"verdict": "made up"})
    keys = tuple(row.key for row in inputs_of(scene))
    rows = np.linspace(-1.0, 0.8, len(keys))[:, None] + 0.1 * rng.normal(size=(len(keys), 4))
    return Results(with_sensitivity(Results(built, scene), InputEffects(keys, (0, 1, 2, 3), rows, 0.95)), scene)
