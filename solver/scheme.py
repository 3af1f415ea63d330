"""The method as kernels take it: numbers for names."""

from typing import NamedTuple

from solver.method import Method

STRESS_UPDATES = {"musl": 0, "usl": 1, "usf": 2}
MUSL, USL, USF = (STRESS_UPDATES[name] for name in ("musl", "usl", "usf"))

LOCKING = {"none": 0, "cell-average": 1}
CELL_AVERAGE = LOCKING["cell-average"]


class Scheme(NamedTuple):
    """How a step is taken."""

    stress_update: int  # of STRESS_UPDATES
    flip_fraction: float  # 1 FLIP, 0 PIC
    damping: float  # local damping: this share of the unbalanced force opposes the motion (in-situ stage only)
    locking: int = LOCKING["none"]  # of LOCKING
    averages_plastic_strain: bool = False  # over the internal length (``nonlocal_softening``)


def scheme_of(method: Method, damping: float = 0.0, averages_plastic_strain: bool = False) -> Scheme:
    """Return a method as kernels take it; ``damping`` is a share of the unbalanced force."""
    numbers = STRESS_UPDATES[method.stress_update], LOCKING[method.locking]
    return Scheme(numbers[0], method.flip_fraction, damping, numbers[1], averages_plastic_strain)
