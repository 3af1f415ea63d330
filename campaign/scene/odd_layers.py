"""Layers that can be computed but hardly be meant, or of which the first look knows little."""

from collections.abc import Iterator
from math import tan

import numpy as np

from campaign.scene.complaints import Complaint
from campaign.scene.first_look import FirstLook, mean_peak
from campaign.scene.layer_table import thicknesses
from campaign.scene.layers import interfaces_of, layer_scenes
from campaign.scene.scene import Scene
from campaign.terminal import rounded_down
from solver.surface import Surface

THIN = 0.2
"""Thickness in heights of the slope below which a slip surface along a weak layer is no circle."""

FEWEST_CELLS = 2.0
"""Of thickness, below which a slip surface in a layer reaches into those beside it."""


def odd_layers(scene: Scene, look: FirstLook) -> Iterator[Complaint]:
    """Yield what is odd about the layers of a scene."""
    counts = _particle_counts(scene, look.surface)
    for number, thickness in enumerate(thicknesses(scene)[1:], start=1):
        layer = scene.layer[number - 1]
        key, most = f"layer.{number - 1}.{'top' if layer.depth is None else 'depth'}", float(thickness.max())
        if not most:
            between = "between the tops of the layers above and below it, which cut it"
            yield Complaint(key, f"nothing is left of {layer.name} {between}; move it, or leave it out")
            continue
        if not counts[number]:
            yield Complaint(
                key, f"no particle lies in {layer.name}, which is at most {most:.2g} m thick; move it, or leave it out"
            )
            continue
        if most < FEWEST_CELLS * scene.numerics.cell:
            yield Complaint(
                key,
                f"{layer.name} is at most {most:.2g} m thick, less than {FEWEST_CELLS:g} cells, and a slip surface in "
                f'it takes in ground beside it; use numerics.cell = "{rounded_down(most / FEWEST_CELLS)} m" or less',
            )
        if most < THIN * look.height and _is_weak(scene, number, look.height):
            yield Complaint(
                key,
                f"{layer.name} is at most {most:.2g} m thick, less than a fifth of the slope, and weaker than the "
                "ground beside it: what slides along it is no circle, and the factor of safety may be lower than told; "
                "the slide with mean strengths tells more",
            )


def _is_weak(scene: Scene, number: int, height: float) -> bool:
    """Whether a layer is weaker in its middle than those above and below, under half the height of the slope."""
    strengths = []
    middles = [0.5 * float(each.max()) for each in thicknesses(scene)]
    for each, depth in [*zip(layer_scenes(scene), middles, strict=True)][max(0, number - 1) : number + 2]:
        cohesion, angle = mean_peak(each).at(depth)
        strengths.append(cohesion + 0.5 * height * scene.soil.unit_weight * tan(angle))
    return min(range(len(strengths)), key=strengths.__getitem__) == 1


def _particle_counts(scene: Scene, surface: Surface) -> list[int]:
    """Return how many places of the lattice of particles lie in each layer."""
    spacing = scene.numerics.cell / scene.numerics.particles_per_cell**0.5
    x = (np.arange(int(surface.width / spacing)) + 0.5) * spacing
    tops = (each.height_at(x) for each in (surface, *interfaces_of(scene)))
    below = [int(np.sum(np.ceil(np.maximum(top / spacing - 0.5, 0.0)))) for top in tops]
    return [upper - lower for upper, lower in zip(below, [*below[1:], 0], strict=True)]
