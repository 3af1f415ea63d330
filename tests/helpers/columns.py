"""Columns of grains that collapse on a rough floor: the built-in scene `bui2008` in other shapes."""

from typing import NamedTuple

import numpy as np

from campaign.scene import load_scene
from campaign.seeds import BASELINE
from campaign.simulation.ground import prepare
from solver import observables
from solver.march import march_to_rest

COLUMN = 0.01  # m, width of the columns whose mean height is compared
FRONT_HEIGHT = 1.5e-3  # m: of the last measured point, at the front


class Collapse(NamedTuple):
    """A column at rest; lengths in m."""

    model: object
    start: object
    history: object
    slide: object
    column: np.ndarray  # (k,) centres
    height: np.ndarray  # (k,)

    @property
    def front(self):
        """Place where the connected deposit is lower than the last measured point of the front."""
        k = int(np.argmax(self.height < FRONT_HEIGHT))
        return np.interp(-FRONT_HEIGHT, -self.height[k - 1 : k + 1], self.column[k - 1 : k + 1])


def collapse(*overrides):
    """Run the built-in scene with its mean strengths everywhere."""
    scene = load_scene("bui2008", overrides)
    ground = prepare(scene)
    start = ground.released(BASELINE)
    history = march_to_rest(ground.model, start, ground.coordinates["time"])
    edges = np.arange(0.0, ground.model.surface.width + 0.5 * COLUMN, COLUMN)
    half_spacing = 0.5 * ground.model.particle_spacing
    # Separated bars have been given the volume of the gaps between them; their mass knows better.
    debris = history.particles._replace(volume=history.particles.mass / ground.model.materials[0].density)
    height = observables.deposit_surface(debris, half_spacing, edges)
    return Collapse(ground.model, start, history, ground.model.criteria, 0.5 * (edges[1:] + edges[:-1]), height)


def column(width, height, base, cell):
    """Return the overrides for a column on a floor of about ``base``, all in mm."""
    end = cell * round(base / cell)
    points = ((0, height), (width, height), (width, 0), (end, 0))
    surface = ", ".join(f'["{x:.6g} mm", "{y:.6g} mm"]' for x, y in points)
    return f"geometry.surface=[{surface}]", f'numerics.cell="{cell:.6g} mm"'
