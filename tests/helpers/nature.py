"""Models in the place of simulations: run-outs of known means on each mesh, and noise that a coarser mesh adds."""

import numpy as np
from scipy.special import ndtri

from campaign.accuracy.mesh_limit import Runs
from campaign.accuracy.pursuit import Model

QUARTER, HALF, OWN, SOFTER, DOUBLE = (
    Model("quarter-cell", 58.0),
    Model("half-cell", 8.0),
    Model("own", 1.0),
    Model("softer", 0.36),
    Model("double-cell-softer", 0.05),
)
LADDERS = ((HALF, OWN, SOFTER, DOUBLE), (QUARTER, HALF, OWN, SOFTER, DOUBLE))
CELL = {QUARTER: 0.25, HALF: 0.5, OWN: 1.0, SOFTER: 1.0, DOUBLE: 2.0}
NOISE = {QUARTER: 0.0, HALF: 0.26, OWN: 0.35, SOFTER: 0.25, DOUBLE: 0.9}
"""Standard deviation in m of what each adds to the one before."""

MEAN, SCATTER, PLACES = 10.0, 1.25, 6


class Nature:
    """Run-outs whose mean with cells of size h is MEAN + slope h^order; half of their variance is the field's."""

    def __init__(self, seed, slope=0.4, order=1.0, chance=1.0, most=1000):
        rng = np.random.default_rng(seed)
        self.slope, self.order, self.asked = slope, order, []
        self.field = rng.normal(size=(most, PLACES))
        base = SCATTER * (self.field.sum(axis=1) / np.sqrt(2 * PLACES) + np.sqrt(0.5) * rng.normal(size=most))
        noise = np.cumsum([NOISE[model] * rng.normal(size=most) for model in LADDERS[-1]], axis=0)
        lot = rng.normal(size=most)
        self.runout = {model: self.mean(model) + base + each for model, each in zip(LADDERS[-1], noise, strict=True)}
        self.slid = {
            model: lot + 0.3 * each > ndtri(1 - chance) for model, each in zip(LADDERS[-1], noise, strict=True)
        }

    def mean(self, model):
        return MEAN + self.slope * CELL[model] ** self.order

    def runs(self, model, count):
        slid = self.slid[model][:count].astype(float)
        return Runs(self.runout[model][:count] * slid, slid, self.field[:count])

    def compute(self, counts):
        self.asked.append(dict(counts))
        return {model: self.runs(model, count) for model, count in counts.items()}
