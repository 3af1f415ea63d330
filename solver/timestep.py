"""The Courant limit."""

import math

from solver.method import Basis, StressUpdate

# Up to these an elastic body that crosses cells gains less than a tenth of its vibration energy, and one that trembles
# in place is stable wherever its particles lie, 4, 9 or 16 of them in a cell: the stability atlas, tests/stability.
LARGEST_COURANT: dict[tuple[Basis, StressUpdate], float] = {
    ("gimp", "musl"): 0.9,
    ("gimp", "usf"): 1.1,
    ("gimp", "usl"): 0.4,
    ("bspline", "musl"): 1.1,
    ("bspline", "usf"): 1.5,
    ("bspline", "usl"): 0.6,
    ("linear", "musl"): 0.2,
    ("linear", "usf"): 0.1,
    ("linear", "usl"): 0.0,
}


def largest_courant(basis: Basis, stress_update: StressUpdate) -> float:
    """Return the Courant number up to which a step is stable; 0 where none is."""
    return LARGEST_COURANT[basis, stress_update]


def stable_step(courant: float, cell_size: float, wave_speed: float, fastest: float) -> float:
    """Return ``dt = C h / (c_p + max |v|)`` in s, from the Courant number, m and m/s."""
    return courant * cell_size / (wave_speed + fastest)


def even_steps(duration: float, largest_step: float) -> int:
    """Return into how many equal steps of at most ``largest_step`` a ``duration`` (s) is cut."""
    return max(1, math.ceil(duration / largest_step - 1e-9))
