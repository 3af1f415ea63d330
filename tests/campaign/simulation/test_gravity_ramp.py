"""Gravity that grows settles the ground elastically, which is no slide."""

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.record import Status
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from solver.observables import runout

SOFT = ["numerics.gravity=ramp", "soil.young_modulus=10 MPa"]


def test_soft_ground_that_settles_under_growing_gravity_does_not_slide():
    """At a tenth of the stiffness the crest settles by twice what counts as displaced."""
    ground = prepare(small_scene(*SOFT, "soil.cohesion.mean=60 kPa"))
    settlement = np.hypot(ground.settled.x - ground.lattice.x, ground.settled.y - ground.lattice.y)
    assert settlement.max() > 2.0 * ground.model.criteria.displaced
    record = ground.simulate(BASELINE)
    assert record.status is Status.no_slide
    assert record.values["sliding_volume"] == 0.0
    assert not np.any(record.values["displaced"])
    assert np.isnan(record.values["front_position"]).all()


def test_displacement_counts_from_the_place_under_the_gravity_of_the_time():
    """On the way: a share g(t) / g of the settlement; afterwards all of it."""
    ground = prepare(small_scene(*SOFT, "numerics.end_time=3 s"))
    seen = {}
    ground.simulate(BASELINE, observe=lambda march: seen.setdefault(march.time, march.reference))
    for time, share in ((0.0, 0.0), (1.0, 0.5), (2.0, 1.0), (3.0, 1.0)):
        expected = ground.lattice.y + share * (ground.settled.y - ground.lattice.y)
        np.testing.assert_allclose(seen[time].y, expected, rtol=0.0, atol=1e-12)


def test_released_ground_counts_from_where_it_rests():
    ground = prepare(small_scene("numerics.end_time=0.5 s"))
    assert ground.settled is ground.in_situ
    ground.simulate(BASELINE, observe=lambda march: assert_same_places(march.reference, ground.in_situ))


def assert_same_places(one, other):
    np.testing.assert_array_equal(one.x, other.x)
    np.testing.assert_array_equal(one.y, other.y)


def test_on_stiff_ground_the_front_hardly_knows_the_settlement():
    """It is 0.02 m there, and decides for a few particles alone whether they count as moved."""
    ground = prepare(small_scene("numerics.gravity=ramp"))
    march = []
    record = ground.simulate(BASELINE, observe=lambda now: march.append(now))
    model, end = ground.model, march[-1].particles
    assert record.values["final_runout"] > 5.0
    from_lattice = runout(end, ground.lattice, model.surface, model.criteria)
    assert record.values["final_runout"] == pytest.approx(from_lattice, abs=0.03)
