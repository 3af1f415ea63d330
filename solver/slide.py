"""What counts as a slide, and by the similarity of Froude when one is over.

Two slides in similar ground whose lengths are as 1 to L have times and speeds as 1 to sqrt(L). So the criteria of rest
go with the root of a displacement, and a column of 0.1 m is judged like a slope of 15 m once it is given at its scale.
"""

from math import sqrt
from typing import Literal, NamedTuple, TypeAlias

Front: TypeAlias = Literal["mass", "tip"]
"""The front of a slide: that of its mass, ahead of which `front_area` lies, or its front-most particle."""


class SlideCriteria(NamedTuple):
    """Displacements since release from which on ground belongs to a slide and is one, and the size of its front."""

    displaced: float  # m: a particle displaced farther belongs to the sliding mass
    failed: float  # m: a slope of which a particle is displaced farther has failed; arms the end criterion
    front_area: float  # m2: the mass front leaves this much of the sliding mass ahead of it
    front: Front = "mass"  # the front whose place is followed

    @property
    def rest_speed(self) -> float:
        """Speed in m/s of the farthest particle, below which it travels on by a small share of ``failed``."""
        return 0.05 * sqrt(self.failed)

    @property
    def rest_time(self) -> float:
        """Time in s for which a slide must have been quiet to be over."""
        return 0.2 * sqrt(self.failed)

    @property
    def front_time(self) -> float:
        """Time in s over which the speed of a front is seen."""
        return sqrt(self.failed)


PAPER = SlideCriteria(displaced=0.1, failed=1.0, front_area=0.25, front="tip")
"""The displacements and the front of Ma, Rezania and Mousavi Nezhad, section 3.2."""
