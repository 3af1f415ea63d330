"""What realizations of a wet slope share."""

import numpy as np

from campaign.scene import load_scene
from campaign.simulation.ground import prepare


def test_a_ramp_begins_without_the_pressure_of_the_water():
    """Pore pressure grows with gravity, or it would burst the ground at once."""
    scene = load_scene("ma2023", ["numerics.gravity=ramp", "water.r_u=0.4", "numerics.cell=2 m"])
    ground = prepare(scene)
    assert ground.in_situ.pore_pressure.max() == 0.0
    assert ground.settled.pore_pressure.max() > 1e5
    ratios = (each.pore_area / each.volume for each in (ground.in_situ, ground.settled))
    np.testing.assert_allclose(*ratios, rtol=1e-12)
