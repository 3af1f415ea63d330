"""The method as kernels take it: numbers for names."""

from typing import NamedTuple

from solver.method import Method

STRESS_UPDATES = {"musl": 0, "usl": 1, "usf": 2}
MUSL, USL, USF = (STRESS_UPDATES[name] for name in ("musl", "usl", "usf"))


class Scheme(NamedTuple):
    """How a step is taken."""

    stress_update: int  # of STRESS_UPDATES
    flip_fraction: float = 1.0  # 1 FLIP, 0 PIC
    damping: float = 0.0  # local damping: this share of the unbalanced force opposes the motion (in-situ stage only)


class CellScheme(NamedTuple):
    """How a step is taken where particles read means over cells; a type of its own, so that others pay nothing."""

    stress_update: int
    flip_fraction: float = 1.0
    damping: float = 0.0
    averages_dilation: bool = True  # against locking (``mean_dilation``)
    averages_plastic_strain: bool = False  # over the internal length (``nonlocal_softening``)


AnyScheme = Scheme | CellScheme


def scheme_of(method: Method, damping: float = 0.0, averages_plastic_strain: bool = False) -> AnyScheme:
    """Return a method as kernels take it; ``damping`` is a share of the unbalanced force."""
    update, averages_dilation = STRESS_UPDATES[method.stress_update], method.locking == "cell-average"
    if averages_dilation or averages_plastic_strain:
        return CellScheme(update, method.flip_fraction, damping, averages_dilation, averages_plastic_strain)
    return Scheme(update, method.flip_fraction, damping)
