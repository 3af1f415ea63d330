"""Which front is followed: one of a few particles is the tip, and one of much of the slide is no front."""

from campaign.scene import Scene
from campaign.scene.complaints import Complaint
from campaign.scene.first_look import FirstLook
from campaign.scene.softening import is_brittle
from campaign.terminal import rounded_up

FEWEST_PARTICLES = 4
"""Ahead of the front of soil that softens quickly and breaks up: their cell is the smallest piece that is thrown ahead.
In a benched cut of 18 m (slip to residual strength 0.4 m, cells of 1.5 m) the mean run-out is 41 m with half a particle
ahead, where half the cell changes it by -10 m, and 28 m with seven, where it changes it by -1 m."""

LARGEST_SHARE = 0.1
"""Of the ground above the critical slip circle."""


def front_of_particles(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a front that one particle decides, or a few that may be thrown ahead."""
    numerics = scene.numerics
    particle = numerics.cell**2 / numerics.particles_per_cell
    fewest = FEWEST_PARTICLES if is_brittle(scene, look.height) else 1
    if scene.front_area >= (1.0 - 1e-9) * fewest * particle:
        return None
    return Complaint(
        "slide.front_area",
        f"the front then leaves {scene.front_area:.2g} m2 ahead of it, {scene.front_area / particle:.2g} particles of "
        f'{particle:.2g} m2, and single ones decide the run-out; use "{rounded_up(fewest * particle)} m^2" or more, '
        "or smaller cells",
    )


def front_of_the_slide(scene: Scene, look: FirstLook) -> Complaint | None:
    """Warn of a front behind which a good part of the slide lies."""
    if look.peak is None:
        return None
    slide = look.peak.area(look.surface)
    if scene.front_area <= LARGEST_SHARE * slide:
        return None
    return Complaint(
        "slide.front_area",
        f"the ground above the critical slip circle is {slide:.2g} m2, and the front is to leave "
        f'{scene.front_area:.2g} m2 of it ahead; use "{0.2 * LARGEST_SHARE * slide:.2g} m^2"',
    )
