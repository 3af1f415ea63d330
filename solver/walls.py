"""Whether the walls of the model, which no slope has, hinder a slide."""

from typing import NamedTuple

from solver import observables
from solver.particles import Particles
from solver.slide import SlideCriteria

NEAR = 1.0  # cells: the nodes of a wall hold the ground of its cells


class Walls(NamedTuple):
    """Which walls a slide has reached.

    The one ahead stops it. That behind the crest holds ground back that would follow, which changes the run-out in
    either direction: a slide of 15.9 m ran 15.5 m with more ground behind the crest, another one of 11.5 m 18.3 m.
    """

    left: bool = False  # behind the crest
    right: bool = False  # ahead of the slide

    def __or__(self, other: "Walls") -> "Walls":
        """Return the walls that either slide has reached."""
        return Walls(self.left or other.left, self.right or other.right)


def reached_walls(
    particles: Particles, reference: Particles, width: float, cell_size: float, criteria: SlideCriteria
) -> Walls:
    """Return the walls near which ground moves as far as a slope that has failed.

    Near the wall ahead is what is there now, near that behind the crest also what was there before it left.
    Less is the fringe of a slide: on a slope of 15 m, walls next to which the ground moves up to 0.7 m change the
    run-out by 0.5 % at most, a wall next to which it moves 2 m by 1.2 %.

    Parameters
    ----------
    particles, reference : Particles
        The ground now, and where its displacement counts from.
    width, cell_size : float
        Distance of the walls and of the nodes in m.
    criteria : SlideCriteria
    """
    moved = observables.displacement(particles, reference) > criteria.failed
    near = NEAR * cell_size
    left = (particles.x < near) | (reference.x < near)
    right = particles.x > width - near
    return Walls(bool((moved & left).any()), bool((moved & right).any()))
