"""The choices of numerical method, by name; they become numbers only where a kernel is called."""

from typing import Literal, NamedTuple

Basis = Literal["gimp", "linear", "bspline"]
StressUpdate = Literal["musl", "usl", "usf"]
Filling = Literal["lattice", "cut"]  # of the ground with particles, see ``filling``
Locking = Literal["none", "cell-average"]  # the cure, not the disease: "none" locks


class Method(NamedTuple):
    """How particles and nodes exchange their state."""

    basis: Basis = "gimp"
    stress_update: StressUpdate = "musl"
    locking: Locking = "none"
    flip_fraction: float = 1.0  # 1 FLIP, 0 PIC
