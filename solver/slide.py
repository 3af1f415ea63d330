"""What counts as a slide: two displacements, and by the similarity of Froude what follows from them.

Two slides in similar ground whose lengths are as 1 to L have times and speeds as 1 to sqrt(L). So areas go with the
square of a displacement and the criteria of rest with the root of it, and a column of 0.1 m is judged like a slope of
15 m once both displacements are given at its scale.
"""

from math import sqrt
from typing import NamedTuple


class Slide(NamedTuple):
    """Displacements since release, in m, from which on ground belongs to a slide and is one."""

    displaced: float  # a particle displaced farther belongs to the sliding mass
    failed: float  # a slope of which a particle is displaced farther has failed; arms the end criterion

    @property
    def front_area(self) -> float:
        """Area in m2 of sliding mass that the mass front leaves ahead of it: a square of side ``5 displaced``."""
        return (5.0 * self.displaced) ** 2

    @property
    def rest_speed(self) -> float:
        """Speed in m/s of the farthest particle, below which it travels on by a small share of ``failed``."""
        return 0.05 * sqrt(self.failed)

    @property
    def rest_time(self) -> float:
        """Time in s for which a slide must have been quiet to be over."""
        return 0.2 * sqrt(self.failed)


PAPER = Slide(displaced=0.1, failed=1.0)
"""The displacements of Ma, Rezania and Mousavi Nezhad, section 3.2."""
