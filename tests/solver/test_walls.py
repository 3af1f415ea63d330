"""The walls of the model, which no slope has."""

import numpy as np
import pytest

from solver.observables import base_contact
from solver.particles import allocate_particles
from solver.slide import PAPER
from solver.walls import Walls, reached_walls


def reached(x, shift, width=20.0):
    """Return the walls that ground at ``x`` (m) has reached after a ``shift`` (m), on cells of 1 m."""
    before = allocate_particles(np.array([x, 10.0]), np.array([2.0, 2.0]), 0.25, 2000.0)
    return reached_walls(before._replace(x=before.x + np.array([shift, 0.0])), before, width, 1.0, PAPER)


@pytest.mark.parametrize(
    ("x", "shift", "expected"),
    [
        (15.0, 3.9, Walls()),  # stops before the last cell
        (15.0, 4.1, Walls(right=True)),
        (18.9, 0.9, Walls()),  # pushed less than a slope that has failed
        (18.9, 1.05, Walls(right=True)),
        (1.1, 5.0, Walls()),
        (0.9, 5.0, Walls(left=True)),  # it left the wall behind the crest
        (3.0, -2.5, Walls(left=True)),
        (0.9, 18.9, Walls(left=True, right=True)),
    ],
)
def test_ground_that_moves_in_the_cells_next_to_a_wall_has_reached_it(x, shift, expected):
    assert reached(x, shift) == expected


def test_walls_once_reached_stay_so():
    assert Walls(left=True) | Walls(right=True) == Walls(True, True)
    assert Walls() | Walls() == Walls()


def test_base_contact_counts_the_columns_that_slip_in_the_lowest_row():
    """Six columns slide, three of them down to the base."""
    x, y = np.meshgrid(np.arange(8) + 0.5, np.arange(3) + 0.5)
    before = allocate_particles(x.ravel(), y.ravel(), 1.0, 2000.0)
    slides, slips = (before.x < 6.0) & (before.y > 1.0), (before.x < 3.0) & (before.y < 1.0)
    dragged = (before.x > 3.0) & (before.x < 6.0) & (before.y < 1.0)  # by a slip surface above it
    now = before._replace(x=before.x + 1.2 * (slides | slips) + 0.2 * dragged)
    assert base_contact(now, before, 1.0, PAPER) == 0.5
    assert base_contact(before, before, 1.0, PAPER) == 0.0
