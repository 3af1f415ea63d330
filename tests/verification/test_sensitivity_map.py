"""The sensitivity map foretells what stronger ground does: regions of the slope are strengthened and slides run again.

Neither regression nor map takes part in the second run, so that its paired differences are an oracle of their own.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.fields.strengths import Strengths, StrengthSampler
from campaign.simulation.ground import Ground, prepare
from campaign.statistics.sensitivity_map import sensitivity_map

CAMPAIGN, PAIRS = 150, 24

REGIONS = {
    "friction below the foot": ("friction_angle", np.s_[0:2, 5:10]),
    "cohesion at the foot": ("cohesion", np.s_[2:5, 5:11]),
}
"""A property, and rows and columns of boxes."""


@dataclass(frozen=True)
class Strengthened:
    """A sampler of the same fields, with 10 % more of a property in some boxes."""

    sampler: StrengthSampler
    name: str
    inside: np.ndarray

    @property
    def grid(self):
        return self.sampler.grid

    def draw(self, seed: int, realization: int) -> Strengths:
        drawn = self.sampler.draw(seed, realization)
        values = drawn.values.copy()
        values[drawn.names.index(self.name)][self.inside] *= 1.1
        return replace(drawn, values=values)


def strengthened(ground: Ground, name: str, boxes: tuple[slice, slice]) -> Ground:
    """Return the ground with 10 % more of a property in boxes."""
    grid, (rows, columns) = ground.sampler.grid, boxes
    inside = [
        np.abs(places[:, None] - middles[which]).min(axis=1) < (middles[1] - middles[0]) / 2
        for places, middles, which in ((grid.y, ground.boxes.y, rows), (grid.x, ground.boxes.x, columns))
    ]
    return replace(ground, sampler=Strengthened(ground.sampler, name, np.logical_and.outer(*inside)))


@pytest.mark.slow
def test_stronger_ground_does_what_the_map_says():
    """Sign and size, within a factor of two and a half, of effects that are far beyond the noise of the pairs.

    The penalty draws coefficients towards zero: 0.6 to 1.1 times the effect was seen in five regions.
    """
    ground = prepare(small_scene())
    records = [ground.simulate(k) for k in range(CAMPAIGN)]
    runouts = np.array([record.values["final_runout_mass"] for record in records])
    maps = np.array([record.values["field_map"] for record in records], dtype=float)
    found = sensitivity_map(maps, runouts, 0.95)
    assert 0.5 < found.explained < 0.9
    for name, (soil, boxes) in REGIONS.items():
        foretold = np.nansum(found.change[["cohesion", "friction_angle"].index(soil)][boxes])
        other = strengthened(ground, soil, boxes)
        again = [other.simulate(k).values["final_runout_mass"] for k in range(PAIRS)]
        change = np.array(again) - runouts[:PAIRS]
        assert abs(change.mean()) > 4 * change.std(ddof=1) / np.sqrt(PAIRS), name
        assert 0.4 < foretold / change.mean() < 1.6, name
