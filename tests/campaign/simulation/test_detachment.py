"""Ground that has come apart from the slide."""

import numpy as np
import pytest
from small_campaign import small_scene

from campaign.simulation.detachment import connected_parts, detached_volume
from campaign.simulation.ground import prepare
from campaign.simulation.solver_model import model_of

CELL = 2.0


@pytest.fixture(scope="module")
def model():
    return model_of(small_scene())


@pytest.fixture(scope="module")
def ground():
    return prepare(small_scene("numerics.gravity=ramp")).in_situ


def pushed(ground, beyond, distance):
    """Return the ground with what lies above the toe and beyond a place pushed ahead (m), and the volume of that."""
    moves = (ground.x > beyond) & (ground.y > 4.0)
    return ground._replace(x=ground.x + distance * moves), ground.volume[moves].sum()


@pytest.mark.parametrize(("gap", "is_detached"), [(0.0, False), (0.9, False), (1.1, True), (2.0, True), (6.0, True)])
def test_a_gap_of_more_than_a_cell_detaches(gap, is_detached, model, ground):
    """Two spacings of particles, here a cell; a node joins those 4 m apart. The plain below does not count."""
    now, volume = pushed(ground, beyond=30.0, distance=(gap - 0.5) * CELL if gap else 0.0)
    found = detached_volume(now, ground, model.surface, model.particle_spacing)
    assert found == (volume if is_detached else 0.0)


def test_what_has_stayed_behind_is_not_ahead(model, ground):
    now, volume = pushed(ground, beyond=10.0, distance=4.0 * CELL)
    assert volume > 0.5 * ground.volume[ground.y > 4.0].sum()
    assert detached_volume(now, ground, model.surface, model.particle_spacing) == 0.0


def test_parts_are_what_touches_drawn_out():
    """Three in a row and one above, then a pair across a corner, then a single one."""
    x = np.array([1.2, 2.0, 2.8, 2.0, 7.1, 8.1, 12.0])
    y = np.array([1.5, 1.5, 1.5, 2.5, 3.1, 4.1, 9.0])
    np.testing.assert_array_equal(connected_parts(x, y, 1.0), [0, 0, 0, 0, 1, 1, 2])
